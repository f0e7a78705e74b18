#pragma once

#include <vector>

#include "kernels/monitor/stiffness_growth.hpp"
#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/nodal_state.hpp"

namespace railwave {

struct Model;
struct OwnItems;

/// How the stable step follows elements that change their shape. Masses stay, so elements that have become stiffer by a
/// factor g (stiffness_growth()) raise the square of the scene's highest frequency by g at most, and an element that
/// bears the step by itself does not count, whatever its neighbours are (Irons' theorem). So with the undeformed
/// scene's step s and each element's own step s_e as it is now, the scene may take
///   min over elements of max(s / sqrt(g_e), s_e);
/// s / sqrt(g_e) of elements under springs, beams and connectors; s_e over 2^level of elements of coarse levels.

/// @param own elements that this process measures; null: all
DeformedElements deformed_elements(const Model& model, const OwnItems* own);

/// What a check of all elements finds.
struct DeformedNow {
  double first = 0, second = 0;  ///< s, the step that is allowed by the first and the second limit
  double speed = 0;              ///< m/s, of the fastest element
  double approach = 0;           ///< m/s, see fastest_approach()
};
/// @param approaching contacts that are asked for their approach with it, so that the device is waited for once
DeformedNow measure_now(const DeformedElements& elements, const NodalState& nodal, double first_limit,
                        double second_limit, const std::vector<ContactPair>& approaching = {});

struct DeformedAhead {
  double allowed = 0;  ///< s, the step that is allowed now
  double steps = 0;    ///< until an element may be in the way, moving on as now
  double loss = 0;     ///< largest relative loss of allowed step in a step
};
/// @param limit s, of the undeformed scene
/// @param step s, the present one
/// @param least s, the allowed step that would be in the way
DeformedAhead measure_ahead(const DeformedElements& elements, const NodalState& nodal, double limit, double step,
                            double least);

/// Puts the worse of two findings into the first.
void join(DeformedNow& own, const DeformedNow& other);
void join(DeformedAhead& own, const DeformedAhead& other);

/// The largest speed of a slave node in a contact's window against the segment that it is tracked over, m/s: none of
/// those that can touch before the window is built again closes in faster, as they move now.
double fastest_approach(const NodalState& nodal, const std::vector<ContactPair>& contacts);

/// Steps until slave nodes touch that close in on their master faster than `fast`, m/s; infinite: none does. It knows
/// nodes that the last check of the contact has found near, which holds for 64 steps.
double steps_to_strike(const NodalState& nodal, const std::vector<ContactPair>& contacts, double fast, double step);

/// A blow of that speed, m/s, can make elements shorter within a few steps: by Johnson's damage number (see
/// automatic_step.hpp), or a hundredth of a wave's speed.
double striking_speed(const AssembledScene& assembled);

}  // namespace railwave
