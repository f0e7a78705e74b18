#pragma once

#include <string>

#include "case/scene.hpp"
#include "kernels/contact_law.hpp"

namespace railwave {

/// The law that a case asks for, for so many slave nodes; not active where the plain law does.
ContactLawArrays make_contact_law(const scene::Contact& contact, int slaves);

/// Nothing dissipated yet; the static coefficient everywhere.
void reset_contact_law(const ContactLawArrays& law, double static_friction);

/// The largest tangent stiffness of a pair's springs over that of its segments, in any direction and at any
/// penetration.
double largest_growth(const scene::Contact& contact);

/// A contact by its name; with those of its masters where there are several.
std::string describe_contact(const scene::Contact& contact);

/// Of a stage: ", friction that falls with speed, damping".
std::string describe_contact_law(const scene::Contact& contact);

}  // namespace railwave
