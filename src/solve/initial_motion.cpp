#include <fmt/format.h>

#include <cmath>

#include "case/error.hpp"
#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/contact/rolling.hpp"
#include "model/host_copy.hpp"
#include "solve/statics/settle.hpp"
#include "solve/tasks/beam_forces.hpp"

namespace railwave {
namespace {

/// Nodes inside beams move and turn as their ends do.
void move_beams_along(const Assembly& assembly, const BeamModel& beams, const Array<double* [3]>::HostMirror& velocity,
                      std::vector<Vec3>& spin) {
  std::vector<Vec3> moved(spin.size());
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] = {velocity(n, 0), velocity(n, 1), velocity(n, 2)};
  interpolate_inside_beams(assembly, [&](int n) -> Vec3& { return moved[n]; });
  interpolate_inside_beams(assembly, [&](int n) -> Vec3& { return spin[n]; });
  for (const auto& [first, count] : assembly.beam_nodes)
    for (int n = first; n < first + count; ++n)
      for (int i = 0; i < 3; ++i) velocity(n, i) = moved[n][i];
  const auto of_beams = Kokkos::create_mirror_view(beams.arrays.spin);
  for (std::size_t n = 0; n < spin.size(); ++n)
    if (const int b = beams.number[n]; b >= 0)
      for (int i = 0; i < 3; ++i) of_beams(b, i) = spin[n][i];
  Kokkos::deep_copy(beams.arrays.spin, of_beams);
}

}  // namespace

Vec3 rotation_centre(const AssembledScene& assembled, const scene::InitialMotion& motion, const std::string& part,
                     const Array<double* [3]>& position) {
  if (motion.centre) return *motion.centre;
  if (const auto axis = carried_axis(assembled, motion)) {
    const Vec3 mean = centre_of_mass(assembled, *axis->nodes, to_host(position));
    return {mean[0] + axis->from_mean[0], mean[1] + axis->from_mean[1], mean[2] + axis->from_mean[2]};
  }
  const auto& nodes = motion.around.empty()
                          ? assembled.assembly.node_sets.at(part)
                          : find_node_set(assembled.scene, assembled.assembly, motion, "around", motion.around);
  return centre_of_mass(assembled, nodes, to_host(position));
}

void refuse_moving_held_nodes(const AssembledScene& assembled, const Array<double* [3]>& reference) {
  if (assembled.scene.initial_motions.empty()) return;
  std::vector<Vec3> velocity(assembled.assembly.nodes.size(), Vec3{0, 0, 0});
  double fastest = 0;
  for (const scene::InitialMotion& motion : assembled.scene.initial_motions)
    for (const std::string& name : motion.parts) {
      const Vec3 centre = rotation_centre(assembled, motion, name, reference);
      const auto& nodes = assembled.assembly.node_sets.at(name);
      const Vec3 w =
          nodes.size() > 1 ? turned_with_part_of(assembled.scene, name, motion.angular_velocity) : Vec3{0, 0, 0};
      for (int n : nodes) {
        const Vec3 turning = cross(w, difference(assembled.assembly.nodes[n], centre));
        for (int i = 0; i < 3; ++i) velocity[n][i] += motion.velocity[i] + turning[i];
        fastest = std::fmax(fastest, length(velocity[n]));
      }
    }
  for (const scene::Constraint& constraint : assembled.scene.constraints)
    for (int n : find_node_set(assembled.scene, assembled.assembly, constraint, "target", constraint.target))
      for (int a = 0; a < 3; ++a) {
        const double along = dot(constraint.axes[a], velocity[n]);
        if (!constraint.fixed[a] || std::fabs(along) <= 1e-6 * fastest) continue;
        throw InputError(
            fmt::format("{}:{}: [constraints.{}] holds the node at {} along ({:.4g}, {:.4g}, {:.4g}), in which an "
                        "initial motion gives it {:.4g} m/s; give {} a [prescribed_motion] in place of the constraint "
                        "(without velocity: at rest), or take the direction out of one of both",
                        assembled.scene.path, constraint.line, constraint.name, place_text(assembled.assembly.nodes[n]),
                        constraint.axes[a][0], constraint.axes[a][1], constraint.axes[a][2], along, constraint.target));
      }
}

void set_initial_motion(const AssembledScene& assembled, const NodeArrays& arrays,
                        const std::shared_ptr<BeamModel>& beams) {
  if (assembled.scene.initial_motions.empty()) return;
  const auto position = to_host(arrays.position);
  const auto velocity = to_host(arrays.velocity);
  std::vector<Vec3> spin(beams ? assembled.assembly.nodes.size() : 0, Vec3{0, 0, 0});
  for (const scene::InitialMotion& motion : assembled.scene.initial_motions)
    for (const std::string& name : motion.parts) {
      const Vec3 centre = rotation_centre(assembled, motion, name, arrays.position);
      // A point mass is moved along, not turned, unless beams end on it.
      const auto& nodes = assembled.assembly.node_sets.at(name);
      const bool turns = nodes.size() > 1 || beam_node_of(beams, nodes) >= 0;
      const Vec3 w = turns ? turned_with_part_of(assembled.scene, name, motion.angular_velocity) : Vec3{0, 0, 0};
      for (int n : nodes) {
        if (beams && beams->number[n] >= 0)
          for (int i = 0; i < 3; ++i) spin[n][i] += w[i];
        const double r[3] = {position(n, 0) - centre[0], position(n, 1) - centre[1], position(n, 2) - centre[2]};
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          velocity(n, i) += motion.velocity[i] + w[j] * r[k] - w[k] * r[j];
        }
      }
    }
  if (beams) move_beams_along(assembled.assembly, *beams, velocity, spin);
  Kokkos::deep_copy(arrays.velocity, velocity);
}

}  // namespace railwave
