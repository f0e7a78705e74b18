#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  Model& model;
  std::vector<std::vector<int>> sets;
  std::vector<std::vector<double>> set_weights;
  std::vector<std::string> set_names;  ///< empty: weights of its own, which nobody else can mean
  std::vector<int> contribution_node;
  std::vector<Vec3> torque_axis;
  std::vector<int> torque_set;

  std::vector<double> weights(const std::vector<int>& nodes) const {
    double total = 0;
    for (int n : nodes) total += model.mass[n];
    std::vector<double> weight;
    for (int n : nodes) weight.push_back(model.mass[n] / total);
    return weight;
  }

  int set(const scene::Place& entry, const std::string& key, const std::string& name) {
    if (name == "ground") return -1;
    const auto known = std::find(set_names.begin(), set_names.end(), name);
    if (known != set_names.end()) return static_cast<int>(known - set_names.begin());
    const auto& nodes = find_node_set(model.scene, model.assembly, entry, key, name);
    return add({nodes, weights(nodes), name});
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
  const Model& model = collector.model;
  std::vector<Vec3> amplitude;
  if (load.type == scene::LoadType::nodal_force) {
    const auto& nodes = find_node_set(model.scene, model.assembly, load, "target", load.target);
    const auto weight = collector.weights(nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      collector.contribution_node.push_back(nodes[k]);
      amplitude.push_back(scaled(weight[k], load.force));
    }
  } else {
    for (const Face& face : find_surface(model.scene, model.assembly, load, "target", load.target)) {
      const auto corner = model.assembly.face_nodes(face);
      const auto& x = model.assembly.nodes;
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
  return find_node_set(collector.model.scene, collector.model.assembly, load, "target", load.target).size() == 1;
}

void build_load(Collector& collector, const scene::Load& load) {
  Model& model = collector.model;
  LoadArrays arrays;
  arrays.load = &load;
  arrays.curve = curve_of(model.scene, load.curve);
  arrays.first = collector.contributions();
  if (load.type == scene::LoadType::torque && is_one_node(collector, load)) {
    arrays.beam_node = beam_node_of(model, find_node_set(model.scene, model.assembly, load, "target", load.target));
    if (arrays.beam_node < 0)
      throw InputError(fmt::format(
          "{}:{}: [loads.{}] target: '{}' is one node, which has a rotation only where beams end; add a section "
          "[beams.NAME] from there, or name a set of several nodes",
          model.scene.path, load.line, load.name, load.target));
  } else if (load.type == scene::LoadType::torque) {
    arrays.set = collector.set(load, "target", load.target);
    arrays.torque = static_cast<int>(collector.torque_set.size());
    const Vec3 a = turned_with_part_of(model.scene, load.target, load.axis);
    collector.torque_axis.push_back(scaled(1 / std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), a));
    collector.torque_set.push_back(arrays.set);
    if (collector.torque_set.size() > TorqueArrays::most)
      throw InputError(fmt::format("{}:{}: [loads.{}] is one torque too many; a scene can have {}", model.scene.path,
                                   load.line, load.name, TorqueArrays::most));
    for (int n : collector.sets[arrays.set]) collector.contribution_node.push_back(n);
    arrays.count = static_cast<int>(collector.sets[arrays.set].size());
  } else if (load.type == scene::LoadType::pressure) {
    std::vector<std::array<int, 4>> facets;
    for (const Face& face : find_surface(model.scene, model.assembly, load, "target", load.target)) {
      facets.push_back(model.assembly.face_nodes(face));
      for (int n : facets.back()) collector.contribution_node.push_back(n);
    }
    arrays.count = static_cast<int>(facets.size());
    arrays.facets = to_device("pressure facets", facets);
  } else {
    const auto amplitude = dead_load(collector, load);
    arrays.count = static_cast<int>(amplitude.size());
    arrays.amplitude = to_device("load amplitude", amplitude);
  }
  model.loads.push_back(arrays);
}

void build_connectors(Collector& collector) {
  Model& model = collector.model;
  const auto& nodes = model.assembly.nodes;
  ConnectorModel& built = model.connectors;
  built.cells = connector_cells(model.scene, model.assembly, model.mass);
  const int count = static_cast<int>(built.cells.size());
  std::vector<std::array<int, 2>> ends;
  std::vector<Vec3> rest, stiffness, damping, preload;
  built.first = collector.contributions();
  for (int c = 0; c < count; ++c) {
    const ConnectorCell& cell = built.cells[c];
    const scene::Connector& connector = model.scene.connectors[cell.connector];
    ends.push_back({collector.set(cell.from), collector.set(cell.to)});
    const Vec3 a = mean_place(cell.from, nodes), b = mean_place(cell.to, nodes);
    rest.push_back({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
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
      for (int i = 0; i < 3; ++i) axes(c, a, i) = model.scene.connectors[built.cells[c].connector].axes[a][i];
  Kokkos::deep_copy(arrays.axes, axes);
  arrays.force = Array<double* [3]>("connector force", count);
  arrays.energy = Array<double* [2]>("connector energy", count);
}

/// Both ends of each beam's elements, and moments on them.
void build_beam_forces(Collector& collector) {
  Model& model = collector.model;
  if (!model.beams) return;
  BeamArrays& beams = model.beams->arrays;
  beams.first = collector.contributions();
  const auto end = to_host(beams.end);
  const auto node = to_host(beams.node);
  for (int e = 0; e < beams.count; ++e)
    for (int side : {0, 1}) collector.contribution_node.push_back(node(end(e, side)));
  add_moments(model);
}

/// @param moving sets that connectors and torques need; histories need the rest
void build_sets(const Collector& collector, int moving) {
  std::vector<int> first{0}, first_chunk{0}, nodes;
  std::vector<SetChunk> chunks;
  std::vector<double> weight;
  for (std::size_t s = 0; s < collector.sets.size(); ++s) {
    const auto& own = collector.set_weights[s];
    const int begin = first.back(), end = begin + static_cast<int>(own.size());
    nodes.insert(nodes.end(), collector.sets[s].begin(), collector.sets[s].end());
    weight.insert(weight.end(), own.begin(), own.end());
    first.push_back(end);
    if (static_cast<int>(s) >= moving) continue;
    for (int k = begin; k < end; k += SetChunk::size)
      chunks.push_back({static_cast<int>(s), k, std::min(k + SetChunk::size, end), 0});
    first_chunk.push_back(static_cast<int>(chunks.size()));
  }
  NodeSets& sets = collector.model.sets;
  sets.count = static_cast<int>(collector.sets.size());
  sets.moving = moving;
  sets.first = to_device("first of set", first);
  collector.model.first_of_set = first;
  sets.nodes = to_device("nodes of set", nodes);
  sets.weight = to_device("weight in set", weight);
  sets.first_chunk = to_device("first chunk of set", first_chunk);
  sets.chunks = to_device("chunks of sets", chunks);
  sets.partial = Array<double * [NodeSets::values]>("sums of chunks", chunks.size());
  sets.sums = Array<double * [NodeSets::values]>("sums of sets", moving);
}

void build_torques(const Collector& collector) {
  TorqueArrays& torques = collector.model.torques;
  torques.count = static_cast<int>(collector.torque_set.size());
  torques.set = to_device("torque set", collector.torque_set);
  torques.axis = to_device("torque axis", collector.torque_axis);
  torques.now = Array<double* [4]>("torque now", torques.count);
}

/// What each contribution is worth at each step.
std::vector<RowShare> contribution_shares(const Collector& collector) {
  const Model& model = collector.model;
  std::vector<RowShare> shares(collector.contribution_node.size());
  for (std::size_t c = 0; c < shares.size(); ++c) shares[c] = {static_cast<int>(c), RowShare::given, 1};
  for (std::size_t i = 0; i < model.connectors.cell.size(); ++i) {
    shares[model.connectors.first + i].law = model.connectors.cell[i];
    shares[model.connectors.first + i].weight = model.connectors.share[i];
  }
  for (const LoadArrays& load : model.loads) {
    if (load.torque < 0) continue;
    const auto& weight = collector.set_weights[load.set];
    for (int k = 0; k < load.count; ++k) {
      shares[load.first + k].law = model.connectors.arrays.count + load.torque;
      shares[load.first + k].weight = weight[k];
    }
  }
  return shares;
}

/// A power of two: the force of the stiffest contact spring pushed in by a tenth of its segment's diagonal (some 17 GPa
/// on the segment, whatever the penalty's scale) is the largest that the sum of contact forces must hold.
double contact_quantum(const Model& model) {
  double largest = 1e-30;
  for (const ContactPair& pair : model.contacts)
    for (double stiffness : pair.segment_stiffness)
      largest = std::max(
          largest, 0.1 * pair.segment_size * pair.growth * stiffness / std::min(1.0, pair.contact->penalty_scale));
  return std::exp2(std::ceil(std::log2(largest / ExtraForceSum::largest)));
}

/// Numbers the nodes that can feel extra forces, and lists each one's contributions.
void build_extra(const Collector& collector) {
  Model& model = collector.model;
  std::vector<int> concerned = collector.contribution_node;
  for (const ContactPair& pair : model.contacts) {
    concerned.insert(concerned.end(), pair.slave_nodes.begin(), pair.slave_nodes.end());
    concerned.insert(concerned.end(), pair.master_nodes.begin(), pair.master_nodes.end());
  }
  // What ties and non-reflecting ends do to nodes is added to their loads, so these have a sum of loads, if of none.
  std::vector<char> added(model.assembly.nodes.size(), 0);
  for (const auto* nodes : {&model.ties.masters, &model.ends.nodes})
    for (int n : *nodes) added[n] = 1;
  for (const auto* nodes : {&model.ties.masters, &model.ends.nodes})
    concerned.insert(concerned.end(), nodes->begin(), nodes->end());
  std::sort(concerned.begin(), concerned.end());
  concerned.erase(std::unique(concerned.begin(), concerned.end()), concerned.end());
  const int rows = static_cast<int>(concerned.size());
  std::vector<int> row_of_node(model.assembly.nodes.size(), -1);
  for (int r = 0; r < rows; ++r) row_of_node[concerned[r]] = r;

  std::vector<int> first(rows + 1, 0);
  for (int n : collector.contribution_node) ++first[row_of_node[n] + 1];
  for (int r = 0; r < rows; ++r) first[r + 1] += first[r];
  for (ContactPair& pair : model.contacts)
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes)
        pair.loaded = pair.loaded || added[n] != 0 || first[row_of_node[n]] < first[row_of_node[n] + 1];
  std::vector<int> filled(first.begin(), first.end() - 1);
  std::vector<RowShare> sorted(collector.contribution_node.size());
  for (const RowShare& share : contribution_shares(collector))
    sorted[filled[row_of_node[collector.contribution_node[share.contribution]]]++] = share;
  std::vector<LoadedRow> loaded;
  for (int r = 0; r < rows; ++r)
    if (first[r + 1] > first[r] || added[concerned[r]] != 0)
      loaded.push_back({r, concerned[r], first[r], first[r + 1]});

  ExtraForces& extra = model.extra;
  extra.row_count = rows;
  extra.contribution_count = collector.contributions();
  extra.sum.load = Array<double* [3]>("load on row", rows);
  extra.sum.contact = Array<std::uint64_t* [3]>("contact force on row", rows);
  extra.sum.quantum = contact_quantum(model);
  extra.loaded_count = static_cast<int>(loaded.size());
  extra.loaded = to_device("loaded rows", loaded);
  std::vector<int> loaded_of_row(extra.row_count, -1);
  for (std::size_t k = 0; k < loaded.size(); ++k) loaded_of_row[loaded[k].row] = static_cast<int>(k);
  extra.loaded_of_row = to_device("loaded of row", loaded_of_row);
  extra.shares = to_device("shares of rows", sorted);
  extra.contribution = Array<double* [3]>("contribution", extra.contribution_count);
  extra.contribution_node = to_device("node of contribution", collector.contribution_node);
  extra.work = Array<double*>("work of contribution", extra.contribution_count);
  model.nodes.extra = to_device("extra row", row_of_node);

  std::vector<int> master_rows;
  for (int n : model.ties.masters) master_rows.push_back(row_of_node[n]);
  model.ties.arrays.master_rows = to_device("rows of ties", master_rows);
  if (model.ends.nodes.empty()) return;
  model.ends.alone.assign(model.assembly.nodes.size(), 0);
  for (int n : model.ends.nodes) model.ends.alone[n] = first[row_of_node[n]] == first[row_of_node[n] + 1] ? 1 : 0;
  for (const ContactPair& pair : model.contacts)
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes) model.ends.alone[n] = 0;
  for (int n : model.ties.masters) model.ends.alone[n] = 0;
}

}  // namespace

void build_loads(Model& model) {
  Collector collector{model, {}, {}, {}, {}, {}, {}};
  for (const scene::Load& load : model.scene.loads) build_load(collector, load);
  build_connectors(collector);
  build_beam_forces(collector);
  const int moving = static_cast<int>(collector.sets.size());
  for (const HistorySet& set : resolve_history_sets(model.scene, model.assembly))
    if (set.motion()) model.history_sets.push_back(collector.set({"history_sets", 0}, "output", set.name));
  build_sets(collector, moving);
  build_torques(collector);
  build_extra(collector);
}

}  // namespace railwave
