#include "model/centre_of_mass.hpp"
#include "model/host_copy.hpp"
#include "solve/settle.hpp"

namespace railwave {

Vec3 rotation_centre(const Model& model, const scene::InitialMotion& motion, const std::string& part,
                     const Array<double* [3]>& position) {
  if (motion.centre) return *motion.centre;
  const auto& nodes = motion.around.empty()
                          ? model.assembly.node_sets.at(part)
                          : find_node_set(model.scene, model.assembly, motion, "around", motion.around);
  return centre_of_mass(model, nodes, to_host(position));
}

void set_initial_motion(Model& model) {
  if (model.scene.initial_motions.empty()) return;
  const auto position = to_host(model.nodes.position);
  const auto velocity = to_host(model.nodes.velocity);
  for (const scene::InitialMotion& motion : model.scene.initial_motions)
    for (const std::string& name : motion.parts) {
      const Vec3 centre = rotation_centre(model, motion, name, model.nodes.position);
      // A point mass is moved along, not turned.
      const bool turns = model.assembly.node_sets.at(name).size() > 1;
      const Vec3 w = turns ? motion.angular_velocity : Vec3{0, 0, 0};
      for (int n : model.assembly.node_sets.at(name)) {
        const double r[3] = {position(n, 0) - centre[0], position(n, 1) - centre[1], position(n, 2) - centre[2]};
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          velocity(n, i) += motion.velocity[i] + w[j] * r[k] - w[k] * r[j];
        }
      }
    }
  Kokkos::deep_copy(model.nodes.velocity, velocity);
}

}  // namespace railwave
