#pragma once

#include <optional>
#include <string>

#include "mesh/vectors.hpp"
#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"

namespace railwave {

/// How fast a prescribed motion moves a node, m/s, and how far its displacement does, m, in what it leaves free
/// nothing.
struct Prescribed {
  Vec3 velocity, displacement;
};

inline Prescribed prescribed_at(const scene::PrescribedMotion& motion, const Vec3& centre, const Vec3& x) {
  const Vec3 turning = cross(motion.angular_velocity, difference(x, centre));
  const Vec3 velocity = {motion.velocity[0] + turning[0], motion.velocity[1] + turning[1],
                         motion.velocity[2] + turning[2]};
  Prescribed result{{0, 0, 0}, {0, 0, 0}};
  for (int a = 0; a < 3; ++a)
    for (int i = 0; motion.directions[a] && i < 3; ++i) {
      result.velocity[i] += dot(velocity, motion.axes[a]) * motion.axes[a][i];
      result.displacement[i] += dot(motion.displacement, motion.axes[a]) * motion.axes[a][i];
    }
  return result;
}

/// Where a pair's surfaces may come together and no force moves either, for constraints or prescribed motions hold both
/// along their normals: "[constraints.a] (line 3) holds or drives 'up.z_min' along its normal at (...) and ...". Empty
/// where there is no such place.
std::optional<std::string> stiff_meeting(const AssembledScene& assembled, const ContactPair& pair);

}  // namespace railwave
