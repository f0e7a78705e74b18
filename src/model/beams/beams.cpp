#include "model/beams/beams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "case/error.hpp"
#include "mesh/vectors.hpp"
#include "model/beams/beam_section.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// A unit of pseudo-time is worth the share 1/sqrt(relaxation_share) of half an element's stable step: as for springs.
constexpr double relaxation_share = 0.5 / (0.65 * 0.65);

const scene::Material& material_of(const scene::Scene& scene, const scene::Beam& beam) {
  return *find_entry(scene.materials, beam.material);
}

/// Everything on the host, element by element and beam node by beam node.
struct Lists {
  std::vector<std::array<int, 2>> end;
  std::vector<std::array<Vec3, 3>> axes;
  std::vector<double> length, pretension;
  std::vector<Vec3> stiffness, bending;
  std::vector<int> tightened;
  std::vector<int> node;
  std::vector<double> inertia, relaxation_inertia, arm, elements;
};

int number_of(BeamModel& built, Lists& lists, int node) {
  int& number = built.number[node];
  if (number >= 0) return number;
  number = static_cast<int>(lists.node.size());
  lists.node.push_back(node);
  for (auto* values : {&lists.inertia, &lists.relaxation_inertia, &lists.arm, &lists.elements}) values->push_back(0);
  return number;
}

void add_chain(AssembledScene& assembled, BeamModel& built, Lists& lists, const Assembly::BeamChain& chain) {
  const scene::Beam& beam = assembled.scene.beams[chain.beam];
  const scene::Material& material = material_of(assembled.scene, beam);
  const auto& x = assembled.assembly.nodes;
  const auto axes = beam_axes(assembled.scene, beam, x[chain.nodes.front()], x[chain.nodes.back()]);
  double whole = 0;
  for (int i = 0; i < 3; ++i) whole += axes[0][i] * (x[chain.nodes.back()][i] - x[chain.nodes.front()][i]);
  const double length = whole / beam.divisions;
  const BeamElementValues values = element_values(section_values(beam, material), material, length);
  built.step = std::min(built.step, values.step);
  built.inertia_scale = std::max(built.inertia_scale, values.inertia_scale);
  if (values.inertia_scale > 1.001) built.scaled += beam.divisions;
  const double pseudo = relaxation_share * values.stiffness[0] / (length * values.end_mass);
  for (int k = 0; k < beam.divisions; ++k) {
    std::array<int, 2> end{};
    for (int side : {0, 1}) {
      const int n = chain.nodes[k + side], b = end[side] = number_of(built, lists, n);
      assembled.mass[n] += values.end_mass;
      built.relaxation_mass[n] += pseudo * values.end_mass;
      lists.inertia[b] += values.end_inertia;
      lists.relaxation_inertia[b] += pseudo * values.end_inertia;
      lists.arm[b] += length;
      lists.elements[b] += 1;
    }
    lists.end.push_back(end);
    lists.axes.push_back(axes);
    lists.length.push_back(length);
    lists.stiffness.push_back(values.stiffness);
    lists.bending.push_back(values.bending);
    const double pretension = beam.pretension.value_or(0);
    lists.pretension.push_back(pretension);
    // Only the middle element keeps that force constant while the scene settles: nodes between two such elements would
    // be free to move along the bolt.
    lists.tightened.push_back(!beam.pretension          ? 0
                              : k == beam.divisions / 2 ? BeamArrays::holding
                                                        : BeamArrays::beginning);
  }
}

/// For each beam node the moments on it, in fixed order.
void build_gather(BeamArrays& arrays, const std::vector<int>& loaded) {
  std::vector<std::vector<int>> rows(arrays.node_count);
  const auto end = to_host(arrays.end);
  for (int e = 0; e < arrays.count; ++e)
    for (int side : {0, 1}) rows[end(e, side)].push_back(2 * e + side);
  for (std::size_t l = 0; l < loaded.size(); ++l) rows[loaded[l]].push_back(2 * arrays.count + static_cast<int>(l));
  std::vector<int> first{0}, all;
  for (const auto& of_node : rows) {
    all.insert(all.end(), of_node.begin(), of_node.end());
    first.push_back(static_cast<int>(all.size()));
  }
  arrays.first_moment = to_device("first moment of beam node", first);
  arrays.moment_of_node = to_device("moments of beam nodes", all);
  arrays.moment = Array<double* [3]>("moments on beams", 2 * arrays.count + loaded.size());
}

void hold_rotations(const AssembledScene& assembled, const std::shared_ptr<BeamModel>& beams) {
  std::map<int, HeldDirections> held;
  for (const scene::Constraint& constraint : assembled.scene.constraints) {
    if (constraint.fixed_rotation == std::array<bool, 3>{false, false, false}) continue;
    bool any = false;
    for (int n : find_node_set(assembled.scene, assembled.assembly, constraint, "target", constraint.target)) {
      const int b = beams ? beams->number[n] : -1;
      if (b < 0) continue;
      any = true;
      for (int a = 0; a < 3; ++a)
        if (constraint.fixed_rotation[a]) add_direction(held[b], constraint.axes[a]);
    }
    if (!any)
      throw InputError(fmt::format(
          "{}:{}: [constraints.{}] fixed_rotation: no beam ends at '{}', and only there nodes have rotations; "
          "leave it out, or hold displacements of more nodes",
          assembled.scene.path, constraint.line, constraint.name, constraint.target));
  }
  if (!beams) return;
  BeamArrays& arrays = beams->arrays;
  std::vector<int> row(arrays.node_count, -1);
  arrays.projections = projections(held, row);
  arrays.constraint = to_device("constraint of beam node", row);
}

void refuse_points_without_mass(const AssembledScene& assembled) {
  for (std::size_t i = 0; i < assembled.scene.points.size(); ++i) {
    const scene::PointMass& point = assembled.scene.points[i];
    if (!(assembled.mass[assembled.assembly.point_nodes[i]] > 0))
      throw InputError(
          fmt::format("{}:{}: [points.{}] mass: is 0, and no beam ends there to give it one; give it a mass",
                      assembled.scene.path, point.line, point.name));
  }
}

}  // namespace

void build_beams(AssembledScene& assembled, std::shared_ptr<BeamModel>& beams) {
  if (!assembled.assembly.beam_chains.empty()) {
    beams = std::make_shared<BeamModel>();
    BeamModel& built = *beams;
    const std::size_t nodes = assembled.assembly.nodes.size();
    built.step = std::numeric_limits<double>::infinity();
    built.number.assign(nodes, -1);
    built.relaxation_mass.assign(nodes, 0);
    Lists lists;
    built.first_of_beam.assign(assembled.scene.beams.size() + 1, 0);
    for (const Assembly::BeamChain& chain : assembled.assembly.beam_chains) {
      add_chain(assembled, built, lists, chain);
      built.first_of_beam[chain.beam + 1] = static_cast<int>(lists.end.size());
    }
    BeamArrays& arrays = built.arrays;
    arrays.count = static_cast<int>(lists.end.size());
    arrays.node_count = static_cast<int>(lists.node.size());
    arrays.end = to_device("beam ends", lists.end);
    arrays.axes = unset_array<double* [3][3]>("beam axes", arrays.count);
    const auto axes = Kokkos::create_mirror_view(arrays.axes);
    for (int e = 0; e < arrays.count; ++e)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) axes(e, i, k) = lists.axes[e][i][k];
    Kokkos::deep_copy(arrays.axes, axes);
    arrays.length = to_device("beam length", lists.length);
    arrays.stiffness = to_device("beam stiffness", lists.stiffness);
    arrays.bending = to_device("beam bending stiffness", lists.bending);
    arrays.stretch = Array<double*>("beam stretch without force", arrays.count);
    arrays.pretension = to_device("beam pretension", lists.pretension);
    arrays.tightened = to_device("beam tightened", lists.tightened);
    arrays.node = to_device("beam nodes", lists.node);
    arrays.rotation = Array<double* [4]>("beam rotation", arrays.node_count);
    arrays.spin = Array<double* [3]>("beam spin", arrays.node_count);
    arrays.inertia = to_device("beam inertia", lists.inertia);
    built.relaxation_inertia = to_device("beam relaxation inertia", lists.relaxation_inertia);
    for (std::size_t b = 0; b < lists.arm.size(); ++b) lists.arm[b] /= lists.elements[b];
    built.arm = to_device("beam arm", lists.arm);
  }
  hold_rotations(assembled, beams);
  refuse_points_without_mass(assembled);
}

int beam_node_of(const std::shared_ptr<BeamModel>& beams, const std::vector<int>& nodes) {
  return beams && nodes.size() == 1 ? beams->number[nodes.front()] : -1;
}

void add_moments(const scene::Scene& scene, const std::vector<LoadArrays>& loads, BeamModel& built) {
  std::vector<int> loaded;
  std::vector<Vec3> axis;
  for (const LoadArrays& load : loads) {
    if (load.beam_node < 0) continue;
    const Vec3& a = load.load->axis;
    const double size = length(a);
    built.moments.push_back(&load);
    loaded.push_back(load.beam_node);
    axis.push_back({a[0] / size, a[1] / size, a[2] / size});
  }
  if (loaded.size() > BeamArrays::most_moments)
    throw InputError(fmt::format("{}: [loads] {} torques on points are too many; a scene can have {}", scene.path,
                                 loaded.size(), BeamArrays::most_moments));
  BeamArrays& arrays = built.arrays;
  arrays.moment_count = static_cast<int>(loaded.size());
  arrays.loaded = to_device("beam node of moment", loaded);
  arrays.moment_axis = to_device("axis of moment", axis);
  arrays.work = Array<double*>("work of moments", loaded.size());
  build_gather(arrays, loaded);
}

void reset_beams(const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes) {
  if (!beams) return;
  const BeamArrays& arrays = beams->arrays;
  const auto rotation = Kokkos::create_mirror_view(arrays.rotation);
  for (int b = 0; b < arrays.node_count; ++b)
    for (int k = 0; k < 4; ++k) rotation(b, k) = k == 0 ? 1 : 0;
  Kokkos::deep_copy(arrays.rotation, rotation);
  tighten_beams(beams, nodes, true);
}

void tighten_beams(const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes, bool all) {
  if (!beams) return;
  const BeamArrays& arrays = beams->arrays;
  Kokkos::parallel_for("tighten_beams", Range(0, arrays.count), TightenBeams{arrays, nodes.position, all});
}

std::string describe_beam_inertia(const std::shared_ptr<BeamModel>& beams) {
  if (!beams || beams->scaled == 0) return {};
  return fmt::format(
      "rotary inertia of {} of {} beam elements is up to {:.3g} times their section's, so that it does not shorten the "
      "step",
      beams->scaled, beams->arrays.count, beams->inertia_scale);
}

}  // namespace railwave
