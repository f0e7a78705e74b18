#pragma once

#include <string>

#include "case/scene.hpp"
#include "kernels/contact/law_at_nodes.hpp"
#include "kernels/contact/laws/linear_penalty.hpp"
#include "kernels/support/type_list.hpp"

namespace railwave {

/// The laws that a case chooses from: a pair has the first that is for it. A new law has its file in
/// kernels/contact/laws/, its place and its trait here, and its keys in the case (src/case/scene.hpp,
/// src/case/keys_contacts.cpp).
using ContactLaws = TypeList<LinearPenalty, GrowingPenalty>;

/// Of a contact whose friction falls; of others the coefficient at rest.
inline FallingFriction falling_friction(const scene::Contact& contact) {
  return {contact.friction, contact.dynamic_friction.value_or(contact.friction), contact.friction_decay,
          contact.friction_memory};
}

/// What a law is to the host.
template <class Law>
struct ContactLawTrait;

template <>
struct ContactLawTrait<LinearPenalty> {
  static constexpr bool with_smooth_normals = false;  ///< its kernel is compiled for them too
  static constexpr int friction_now = -1;             ///< of the state's values: the coefficient that acts; -1: none
  static bool is_of(const scene::Contact& contact) {
    return !contact.falling_friction() && contact.penalty_growth.empty() && !(contact.damping > 0) &&
           (contact.normals == scene::ContactNormals::facet || contact.algorithm != scene::ContactAlgorithm::penalty);
  }
  static LinearPenalty law(const scene::Contact& contact, const ContactLawArrays& /*arrays*/, bool /*settling*/) {
    return {contact.friction};
  }
};

template <>
struct ContactLawTrait<GrowingPenalty> {
  static constexpr bool with_smooth_normals = true;
  static constexpr int friction_now = GrowingPenalty::friction_state + FallingFriction::now;
  static bool is_of(const scene::Contact& /*contact*/) { return true; }
  /// Nothing is damped while a scene settles: it has no time.
  static GrowingPenalty law(const scene::Contact& contact, const ContactLawArrays& arrays, bool settling) {
    return {{arrays.growth.data(), static_cast<int>(arrays.growth.extent(0))},
            falling_friction(contact),
            contact.falling_friction(),
            settling ? 0 : contact.damping};
  }
};

/// Whether that is the linear penalty, by which contact can be in one launch with the elements.
inline bool is_linear(const ContactLawArrays& arrays) { return arrays.number == 0; }

/// Calls `work(law)` with a pair's law.
template <class Work>
void with_contact_law(const scene::Contact& contact, const ContactLawArrays& arrays, bool settling, const Work& work) {
  with_type(ContactLaws{}, arrays.number,
            [&](auto type) { work(ContactLawTrait<typename decltype(type)::type>::law(contact, arrays, settling)); });
}

/// The law that a case asks for, for so many slave nodes.
ContactLawArrays make_contact_law(const scene::Contact& contact, int slaves);

/// The coefficient of friction that acts at each slave node. Empty where it is constant.
std::vector<double> friction_now(const scene::Contact& contact, const ContactLawArrays& law);

/// Nothing dissipated yet; the static coefficient everywhere.
void reset_contact_law(const scene::Contact& contact, const ContactLawArrays& law);

/// The largest tangent stiffness of a pair's springs over that of its segments, in any direction and at any
/// penetration.
double largest_growth(const scene::Contact& contact);

/// A contact by its name; with those of its masters where there are several.
std::string describe_contact(const scene::Contact& contact);

/// "multipliers", "penalty springs", and why where the scene chose.
std::string describe_algorithm(const scene::Contact& contact);

/// Of keys of kept states: the algorithms that automatic ones became, which the case's text does not have.
std::string chosen_algorithms(const scene::Scene& scene);

/// Of a task: ", friction that falls with speed, damping".
std::string describe_contact_law(const scene::Contact& contact);

}  // namespace railwave
