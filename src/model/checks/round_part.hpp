#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/assembled_scene.hpp"

namespace railwave {

/// A part whose mesh is a body of revolution: wheel, wheelset, roller or cylinder.
struct RoundPart {
  const scene::Part* part = nullptr;
  Vec3 origin{0, 0, 0};       ///< m, a point of its axis
  Vec3 own_axis{0, 1, 0};     ///< unit, as the mesh has it
  Vec3 axis{0, 1, 0};         ///< unit, turned by the part's angle of attack
  double nominal_radius = 0;  ///< m, as the mesh's key `radius` says
};

/// Nothing where the name is a point's, or of a part with another mesh.
std::optional<RoundPart> round_part(const AssembledScene& assembled, const std::string& name);

/// Whether an angular velocity turns about an axis of that direction.
bool turns_about(const Vec3& angular_velocity, const Vec3& axis);

/// Centre of the rotation of a prescribed motion when the run begins, m: of a round part that turns about its axis a
/// point of that axis, which the nodes of a bore, by their masses, only nearly have for their centre.
Vec3 centre_of_rotation(const AssembledScene& assembled, const scene::PrescribedMotion& motion,
                        const std::vector<int>& nodes);

/// Where a round part is nearest to the other surface of a contact.
struct Touch {
  const scene::Contact* contact = nullptr;
  std::string other;    ///< the other part
  Vec3 place{0, 0, 0};  ///< m, on the other surface
  Vec3 along{0, 0, 0};  ///< unit, in which that place of the round part goes per positive turn about the axis
  double radius = 0;    ///< m, of the part from its axis, there
  double gap = 0;       ///< m
};

/// The nearest place of each contact of the part, undeformed, after close_gap: between the other surface's faces, as
/// they are curved, and the profile that the part's own nodes make about its axis. Contacts farther away than the
/// radius are left out.
std::vector<Touch> touches(const AssembledScene& assembled, const RoundPart& round);

}  // namespace railwave
