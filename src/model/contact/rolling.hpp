#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/assembled_scene.hpp"

namespace railwave {

// resolve_rolling (model/build_steps.hpp) fills in the angular velocity of each initial motion with rolling = true:
// about the axis of its round part, such that the part's surface has there, where it is nearest to the other surface of
// its contact, no velocity against that along its way, omega = (U - V) . t / r. r is the part's radius at that place,
// undeformed, after close_gap: of a wheel at the place of its profile that meets the rail, which may be some tenths of
// a millimetre off the nominal radius; of several places (a wheelset's two wheels) the mean; `rolling_radius` instead,
// if given. What lies across the way, as an angle of attack makes it, slides.

/// What a motion turns about that rolls, or has its `around` on a round part: the axis of that part, which nodes of a
/// bore, by their masses, only nearly have for their centre. In a mesh that is finer below they have it by millimetres
/// too low: turned about it a wheelset of a ton, in balance about its axle, pulled by kilonewtons.
struct CarriedAxis {
  Vec3 point{0, 0, 0};  ///< m, undeformed
  const std::vector<int>* nodes =
      nullptr;              ///< with whose centre of mass it goes while the scene settles: of `around`, or of the part
  Vec3 from_mean{0, 0, 0};  ///< m, from there to the point
};

/// Nothing for motions that have a `centre` or no round part, and for those that do not roll and whose angular velocity
/// is not along the axis of the part that `around` names.
std::optional<CarriedAxis> carried_axis(const AssembledScene& assembled, const scene::InitialMotion& motion);

/// The velocity that the initial motions give a part at a place, m/s; those that roll count once they are resolved.
Vec3 initial_velocity(const AssembledScene& assembled, const std::string& part, const Vec3& place);

/// Round parts in frictional contact whose initial velocities slide by more than a twentieth of their rolling velocity:
/// one line each, with the angular velocity that rolls and how to get it.
std::vector<std::string> rolling_doubts(const AssembledScene& assembled);

}  // namespace railwave
