#include <fmt/format.h>

#include <algorithm>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/beams/beams.hpp"
#include "model/build_steps.hpp"
#include "model/elements/history_sets.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Collects sets and contributions on the host before they go to the device.
struct Collector {
  const AssembledScene& assembled;
  std::vector<std::vector<int>> sets;
  std::vector<std::vector<double>> set_weights;
  std::vector<std::string> set_names;  ///< empty: weights of its own, so that no other entry can share the set
  std::vector<int> contribution_node;
  std::vector<Vec3> torque_axis;
  std::vector<int> torque_set;

  int set(const scene::Place& entry, const std::string& key, const std::string& name) {
    const auto known = std::find(set_names.begin(), set_names.end(), name);
    if (known != set_names.end()) return static_cast<int>(known - set_names.begin());
    const auto& nodes = find_node_set(assembled.scene, assembled.assembly, entry, key, name);
    return add({nodes, shares_by_mass(nodes, assembled.mass), name});
  }

  /// An end of a connector; -1: the ground.
  int set(const WeightedNodes& end) {
    if (end.ground()) return -1;
    const auto known = std::find(set_names.begin(), set_names.end(), end.set);
    return !end.set.empty() && known != set_names.end() ? static_cast<int>(known - set_names.begin()) : add(end);
  }

  int add(const WeightedNodes& end) {
    sets.push_back(end.nodes);
    set_weights.push_back(end.weight);
    set_names.push_back(end.set);
    return static_cast<int>(sets.size()) - 1;
  }

  int contributions() const { return static_cast<int>(contribution_node.size()); }
};

/// Amplitudes of a load whose direction never turns.
std::vector<Vec3> dead_load(Collector& collector, const scene::Load& load) {
  const scene::Scene& scene = collector.assembled.scene;
  const Assembly& assembly = collector.assembled.assembly;
  std::vector<Vec3> amplitude;
  if (load.type == scene::LoadType::nodal_force) {
    const auto& nodes = find_node_set(scene, assembly, load, "target", load.target);
    const auto weight = shares_by_mass(nodes, collector.assembled.mass);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      collector.contribution_node.push_back(nodes[k]);
      amplitude.push_back(scaled(weight[k], load.force));
    }
  } else {
    for (const Face& face : find_surface(scene, assembly, load, "target", load.target)) {
      const auto corner = assembly.face_nodes(face);
      const auto& x = assembly.nodes;
      const double area = facet_area(x[corner[0]], x[corner[1]], x[corner[2]], x[corner[3]]);
      for (int n : corner) {
        collector.contribution_node.push_back(n);
        amplitude.push_back(scaled(0.25 * area, load.traction));
      }
    }
  }
  return amplitude;
}

bool is_one_node(const Collector& collector, const scene::Load& load) {
  return find_node_set(collector.assembled.scene, collector.assembled.assembly, load, "target", load.target).size() ==
         1;
}

void build_load(Collector& collector, const scene::Load& load, const std::shared_ptr<BeamModel>& beams,
                std::vector<LoadArrays>& loads) {
  const scene::Scene& scene = collector.assembled.scene;
  const Assembly& assembly = collector.assembled.assembly;
  LoadArrays arrays;
  arrays.number = static_cast<int>(loads.size());
  arrays.load = &load;
  arrays.curve = curve_of(scene, load.curve);
  arrays.first = collector.contributions();
  if (load.type == scene::LoadType::torque && is_one_node(collector, load)) {
    arrays.beam_node = beam_node_of(beams, find_node_set(scene, assembly, load, "target", load.target));
    if (arrays.beam_node < 0)
      throw InputError(fmt::format(
          "{}:{}: [loads.{}] target: '{}' is one node, which has a rotation only where beams end; add a section "
          "[beams.NAME] from there, or name a set of several nodes",
          scene.path, load.line, load.name, load.target));
  } else if (load.type == scene::LoadType::torque) {
    arrays.set = collector.set(load, "target", load.target);
    arrays.torque = static_cast<int>(collector.torque_set.size());
    const Vec3 a = turned_with_part_of(scene, load.target, load.axis);
    collector.torque_axis.push_back(scaled(1 / length(a), a));
    collector.torque_set.push_back(arrays.set);
    if (collector.torque_set.size() > TorqueArrays::most)
      throw InputError(fmt::format("{}:{}: [loads.{}] is one torque too many; a scene can have {}", scene.path,
                                   load.line, load.name, TorqueArrays::most));
    for (int n : collector.sets[arrays.set]) collector.contribution_node.push_back(n);
    arrays.count = static_cast<int>(collector.sets[arrays.set].size());
  } else if (load.type == scene::LoadType::pressure) {
    std::vector<std::array<int, 4>> facets;
    for (const Face& face : find_surface(scene, assembly, load, "target", load.target)) {
      facets.push_back(assembly.face_nodes(face));
      for (int n : facets.back()) collector.contribution_node.push_back(n);
    }
    arrays.count = static_cast<int>(facets.size());
    arrays.facets = to_device("pressure facets", facets);
  } else {
    const auto amplitude = dead_load(collector, load);
    arrays.count = static_cast<int>(amplitude.size());
    arrays.amplitude = to_device("load amplitude", amplitude);
  }
  loads.push_back(arrays);
}

void build_connectors(Collector& collector, ConnectorModel& built) {
  const scene::Scene& scene = collector.assembled.scene;
  const auto& nodes = collector.assembled.assembly.nodes;
  built.cells = connector_cells(scene, collector.assembled.assembly, collector.assembled.mass);
  const int count = static_cast<int>(built.cells.size());
  std::vector<std::array<int, 2>> ends;
  std::vector<Vec3> rest, stiffness, damping, preload;
  built.first = collector.contributions();
  for (int c = 0; c < count; ++c) {
    const ConnectorCell& cell = built.cells[c];
    const scene::Connector& connector = scene.connectors[cell.connector];
    ends.push_back({collector.set(cell.from), collector.set(cell.to)});
    const Vec3 a = mean_place(cell.from, nodes), b = mean_place(cell.to, nodes);
    rest.push_back(difference(b, a));
    stiffness.push_back(scaled(cell.share, connector.stiffness));
    damping.push_back(scaled(cell.share, connector.damping));
    preload.push_back(scaled(cell.share, connector.preload));
    for (const auto& [end, sign] : {std::pair{&cell.from, -1.0}, std::pair{&cell.to, 1.0}})
      for (std::size_t k = 0; k < end->nodes.size(); ++k) {
        collector.contribution_node.push_back(end->nodes[k]);
        built.cell.push_back(c);
        built.share.push_back(sign * end->weight[k]);
      }
  }
  ConnectorArrays& arrays = built.arrays;
  arrays.count = count;
  arrays.set = to_device("connector ends", ends);
  arrays.rest = to_device("connector rest", rest);
  arrays.stiffness = to_device("connector stiffness", stiffness);
  arrays.damping = to_device("connector damping", damping);
  arrays.preload = to_device("connector preload", preload);
  arrays.axes = unset_array<double* [3][3]>("connector axes", count);
  const auto axes = Kokkos::create_mirror_view(arrays.axes);
  for (int c = 0; c < count; ++c)
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) axes(c, a, i) = scene.connectors[built.cells[c].connector].axes[a][i];
  Kokkos::deep_copy(arrays.axes, axes);
  arrays.force = Array<double* [3]>("connector force", count);
  arrays.energy = Array<double* [2]>("connector energy", count);
}

/// Both ends of each beam's elements, and moments on them.
void build_beam_forces(Collector& collector, const std::vector<LoadArrays>& loads,
                       const std::shared_ptr<BeamModel>& beams) {
  if (!beams) return;
  BeamArrays& arrays = beams->arrays;
  arrays.first = collector.contributions();
  const auto end = to_host(arrays.end);
  const auto node = to_host(arrays.node);
  for (int e = 0; e < arrays.count; ++e)
    for (int side : {0, 1}) collector.contribution_node.push_back(node(end(e, side)));
  add_moments(collector.assembled.scene, loads, *beams);
}

/// @param moving sets that connectors and torques need; histories need the rest
void build_sets(const Collector& collector, int moving, LoadModel& loads) {
  std::vector<int> first{0}, nodes;
  std::vector<double> weight;
  for (std::size_t s = 0; s < collector.sets.size(); ++s) {
    const auto& own = collector.set_weights[s];
    nodes.insert(nodes.end(), collector.sets[s].begin(), collector.sets[s].end());
    weight.insert(weight.end(), own.begin(), own.end());
    first.push_back(first.back() + static_cast<int>(own.size()));
  }
  NodeSets& sets = loads.sets;
  std::vector<int> origin;
  for (int s = 0; s < moving; ++s) origin.push_back(collector.sets[s].front());
  sets.moving = moving;
  loads.first_of_set = first;
  sets.nodes = to_device("nodes of set", nodes);
  sets.origin = to_device("origins of sets", origin);
  sets.weight = to_device("weight in set", weight);
  sets.sums = Array<double * [NodeSets::values]>("sums of sets", moving);
}

void build_torques(const Collector& collector, TorqueArrays& torques) {
  torques.count = static_cast<int>(collector.torque_set.size());
  torques.set = to_device("torque set", collector.torque_set);
  torques.axis = to_device("torque axis", collector.torque_axis);
  torques.now = Array<double* [4]>("torque now", torques.count);
}

/// From what each contribution gets its force at a step: its load's own kernel, a connector or a torque.
std::vector<RowShare> contribution_shares(const Collector& collector, const LoadModel& loads) {
  std::vector<RowShare> shares(collector.contribution_node.size());
  for (std::size_t c = 0; c < shares.size(); ++c) shares[c] = {static_cast<int>(c), RowShare::given, 1};
  for (std::size_t i = 0; i < loads.connectors.cell.size(); ++i) {
    shares[loads.connectors.first + i].law = loads.connectors.cell[i];
    shares[loads.connectors.first + i].weight = loads.connectors.share[i];
  }
  for (const LoadArrays& load : loads.loads) {
    if (load.torque < 0) continue;
    const auto& weight = collector.set_weights[load.set];
    for (int k = 0; k < load.count; ++k) {
      shares[load.first + k].law = loads.connectors.arrays.count + load.torque;
      shares[load.first + k].weight = weight[k];
    }
  }
  return shares;
}

}  // namespace

std::vector<int> nodes_of_moving_sets(const LoadModel& loads) {
  std::vector<int> nodes = to_vector(loads.sets.nodes);
  nodes.resize(loads.sets.moving > 0 ? loads.first_of_set[loads.sets.moving] : 0);
  return nodes;
}

Contributions build_loads(const AssembledScene& assembled, const std::shared_ptr<BeamModel>& beams, LoadModel& loads) {
  Collector collector{assembled, {}, {}, {}, {}, {}, {}};
  for (const scene::Load& load : assembled.scene.loads) build_load(collector, load, beams, loads.loads);
  build_connectors(collector, loads.connectors);
  build_beam_forces(collector, loads.loads, beams);
  const int moving = static_cast<int>(collector.sets.size());
  for (const HistorySet& set : resolve_history_sets(assembled.scene, assembled.assembly))
    if (set.motion()) loads.history_sets.push_back(collector.set({"history_sets", 0}, "output", set.name));
  build_sets(collector, moving, loads);
  build_torques(collector, loads.torques);
  return {collector.contribution_node, contribution_shares(collector, loads)};
}

}  // namespace railwave
