#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/plausible.hpp"
#include "case/usual_sizes.hpp"

namespace railwave::case_file {
namespace {

bool is_wheel(const scene::Scene& scene, const std::string& part_name) {
  const scene::Part* part = find_entry(scene.parts, part_name);
  const scene::MeshSource* mesh = part ? find_entry(scene.meshes, part->mesh) : nullptr;
  return mesh && (mesh->type == scene::MeshType::wheel || mesh->type == scene::MeshType::wheelset);
}

}  // namespace

void remark_on_scene(const scene::Scene& scene, Complaints& remarks) {
  for (const scene::InitialMotion& motion : scene.initial_motions) {
    const auto& v = motion.velocity;
    const double speed = std::hypot(v[0], v[1], v[2]);
    if (speed <= fastest_train) continue;
    const bool wheel = std::any_of(motion.parts.begin(), motion.parts.end(),
                                   [&](const std::string& part) { return is_wheel(scene, part); });
    if (wheel)
      remarks.add({motion.line, false},
                  fmt::format("[initial_motion.{}] velocity: is {:.4g} m/s, {:.4g} km/h, which is unusual for a wheel; "
                              "m/s are expected: {:.4g}, if it is in km/h",
                              motion.name, speed, 3.6 * speed, speed / 3.6));
  }
}

}  // namespace railwave::case_file
