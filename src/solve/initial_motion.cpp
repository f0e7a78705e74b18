#include "model/host_copy.hpp"
#include "solve/settle.hpp"

namespace railwave {

void set_initial_motion(Model& model) {
  const auto position = to_host(model.nodes.position);
  const auto velocity = to_host(model.nodes.velocity);
  for (const scene::InitialMotion& motion : model.scene.initial_motions)
    for (const std::string& name : motion.parts) {
      const auto& nodes = model.assembly.node_sets.at(name);
      Vec3 centre{};
      double mass = 0;
      for (int n : nodes) {
        mass += model.mass[n];
        for (int i = 0; i < 3; ++i) centre[i] += model.mass[n] * position(n, i);
      }
      for (int i = 0; i < 3; ++i) centre[i] = motion.centre ? (*motion.centre)[i] : centre[i] / mass;
      const Vec3& w = motion.angular_velocity;
      for (int n : nodes) {
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
