#pragma once

#include "model/model.hpp"

/// [solver] step_estimate = "automatic": the whole scene's step (global_step.hpp) where that pays, else the elements'.
///
/// What pays is counted in evaluations of the scene's forces and never timed, so that a run repeats itself. The whole
/// scene's step holds with the contact springs that were counted in it. Each check of a contact finds, up to its next
/// check, the nodes that can touch (near_nodes.hpp): where one of them was not counted the step is found anew before it
/// can press, and if that happens more often than the longer steps pay for, the elements' step, which holds with
/// whatever touches, is taken to the end of the run.
namespace railwave {

/// What one application of the assembled tangent costs, in evaluations of the forces of all elements.
inline constexpr double evaluations_of_application = 2;

/// Johnson's damage number, density times speed squared over yield stress, at which plastic deformation is moderate; it
/// begins at 0.001 (Johnson, Impact strength of materials, 1972).
inline constexpr double moderate_damage = 0.1;

/// By how many times the whole scene's step must be longer to pay in a run of so many of the elements' steps; infinite:
/// it never does.
/// @param springs contact springs make it necessary to find the step more than once
double least_gain(double steps, bool springs);

/// The longer one of the elements' steps that hold wherever bodies touch, s.
double elements_limit(const StableStep& stable);

/// Takes the elements' step to the end of the run.
void leave_whole_scene(StepChoice::Reason reason, StepSizes& sizes);

/// Chooses at the beginning. The estimates by elements are known, and their step is the limit.
void choose_step(Model& model);

/// Whether another search is worth what it costs, by what the longer steps have saved so far.
bool may_search_again(const scene::Scene& scene, const StepSizes& sizes, double time, long step);

/// The whole scene's step for the present instant, after contact has changed or `renew_steps` are over; or the
/// elements', to the end of the run, where the other no longer pays.
void renew_automatic_step(const scene::Scene& scene, const std::vector<ContactPair>& contacts, double time, long step,
                          StepSizes& sizes);

bool has_contact_springs(const std::vector<ContactPair>& contacts);

/// Whether the whole scene's step can change: by contact springs, or by elements that flow.
bool can_change(const scene::Scene& scene, const std::vector<ContactPair>& contacts);

/// Whether a contact is checked in the step before this one, which may be one to come.
bool contact_checked_before(const ContactPair& pair, long step);

/// Whether the host asks at a step, which may be one to come, for nodes that may touch and were not counted.
bool contact_answers(const std::vector<ContactPair>& contacts, long step);
/// Whether it need not wait for the device then; of the present step.
bool contact_has_answered(const std::vector<ContactPair>& contacts, long step);

/// Whether there are any; of the present step.
bool may_touch_uncounted(const std::vector<ContactPair>& contacts, long step);

/// For a state that was taken up: what that state's run had chosen, whatever this one would.
void keep_choice(Model& model);

/// "2.3 times the elements' step, ...": for the summary; empty where the case names an estimate.
std::string describe_choice(const StepChoice& choice);

}  // namespace railwave
