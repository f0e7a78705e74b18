#include "model/time_step/automatic_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/host_copy.hpp"
#include "model/time_step/global_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

using Reason = StepChoice::Reason;

/// The share of the elements' steps that must be saved at least.
constexpr double least_saving = 0.05;
/// The share of them that may be spent in vain.
constexpr double spent_in_vain = 0.01;
/// Applications until a step that is longer is found, mostly, and until one that is not is given up, mostly.
constexpr double applications_of_search = 70, applications_of_first_sight = 10;
/// Searches that may be made whatever they have saved: as placed, as settled, and when the bodies have met.
constexpr double free_searches = 3;
/// Below this gain a step that was taken is given back.
constexpr double still_a_gain = 1.02;
/// Share of the local element size within which a slave node counts: about what the checks of contact have for nodes
/// that may come near within a check's 64 steps (contact_window.cpp), so that most are counted before they come near.
constexpr double counted_share = 0.5;

double evaluations_of(const GlobalStep& found) { return evaluations_of_application * found.applications; }

double steps_by_elements(const scene::Scene& scene, const StableStep& stable) {
  StableStep by_elements;
  by_elements.limit = elements_limit(stable);
  return scene.time.end / largest_step(scene.time, by_elements);
}

/// Whether bodies are so fast that they change their shape when they are stopped. The whole scene's step, which would
/// shrink at once, is not worth finding for them.
bool flows(const Model& model) {
  const double speed = largest_initial_speed(model.scene);
  const auto& parts = model.assembly.parts;
  return std::any_of(parts.begin(), parts.end(), [&](const Assembly::PartRange& part) {
    const scene::Material& material = model.scene.materials[part.material];
    return material.yield_stress && material.density * speed * speed > moderate_damage * *material.yield_stress;
  });
}

/// By how many times the whole scene's step must be longer for the step that the case gives; 0: it gives none.
double asked_gain(const scene::Scene& scene, const StableStep& stable) {
  return scene.time.step / elements_limit(stable);
}

/// Why a scene's step is the elements' without any search; `pays` where nothing speaks against one.
Reason obstacle(const Model& model) {
  const scene::Scene& scene = model.scene;
  if (scene.time.step > 0 && scene.time.step <= model.stable_step.by_elements) return Reason::step_given;
  const auto& levels = model.order.level;
  if (std::any_of(levels.begin(), levels.end(), [](int level) { return level > 0; })) return Reason::subcycled;
  if (!std::isfinite(model.stable_step.by_elements) || model.nodes.count == 0 || model.assembly.elements.empty())
    return Reason::no_elements;
  if (flows(model)) return Reason::flows;
  // What a blow gains or loses in steps that open and close a spring goes with the square of the step.
  if (strikes_undamped(scene, model.contacts)) return Reason::strikes;
  for (const ContactPair& pair : model.contacts)
    if (pair.has_springs() && pair.arrays.mouth_corners.extent(0) != 0) return Reason::crack_mouths;
  return Reason::pays;
}

void count_in(const std::vector<ContactPair>& contacts, const std::vector<std::vector<double>>& counted) {
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    if (contacts[p].counts_springs()) bring(counted[p], contacts[p].counted);
  }
}

/// Looks for a step of at least `least` times the elements' and takes it. @return whether there is one
bool take_if(double least, const scene::Scene& scene, const std::vector<ContactPair>& contacts, double time,
             StepSizes& sizes) {
  StableStep& stable = sizes.stable_step;
  const int renew_steps = scene.solver.renew_steps;
  const double left = scene.time.end - time;
  ContactReach within;
  within.horizon = renew_steps > 0 ? std::fmin(left, renew_steps * elements_limit(stable)) : left;
  within.share = counted_share;
  within.near = true;
  GlobalStep found = sizes.global_estimate->at_least(within, least * elements_limit(stable));
  stable.choice.evaluations += evaluations_of(found);
  // It knows beams by their mass only.
  if (stable.beam > 0) found.step = 2 / std::hypot(2 / found.step, 2 / stable.beam);
  stable.choice.gain = found.step / elements_limit(stable);
  if (stable.choice.gain < least) return false;
  stable.global = stable.limit = found.step;
  stable.springs = found.springs;
  stable.seen = std::move(found.seen);
  count_in(contacts, found.counted);
  return true;
}

}  // namespace

void leave_whole_scene(StepChoice::Reason reason, StepSizes& sizes) {
  StableStep& stable = sizes.stable_step;
  stable.choice.reason = reason;
  stable.global = 0;
  stable.springs = 0;
  stable.limit = elements_limit(stable);
  sizes.global_estimate.reset();
}

double elements_limit(const StableStep& stable) { return std::fmax(stable.by_elements, stable.by_eigenvalues); }

double least_gain(double steps, bool springs) {
  if (applications_of_first_sight * evaluations_of_application > spent_in_vain * steps)
    return std::numeric_limits<double>::infinity();
  const double cost = (springs ? 2 : 1) * applications_of_search * evaluations_of_application;
  return 1 / (1 - std::fmax(least_saving, 1.5 * cost / steps));
}

bool has_contact_springs(const std::vector<ContactPair>& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const ContactPair& pair) { return pair.has_springs(); });
}

bool can_change(const scene::Scene& scene, const std::vector<ContactPair>& contacts) {
  return has_contact_springs(contacts) ||
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const auto& material) { return material.yield_stress.has_value(); });
}

bool contact_checked_before(const ContactPair& pair, long step) {
  return pair.near_checked_at == step - 1 || std::min(pair.next_near_check, pair.next_check) == step - 1;
}

namespace {

/// Whether the number of a pair's uncounted nodes is asked for at a step, which may be one to come.
bool answers_at(const ContactPair& pair, long step) {
  if (!pair.counts_springs()) return false;
  return pair.answer_due == step || pair.answer_of(std::min(pair.next_near_check, pair.next_check)) == step;
}

/// The same of the present step.
bool answers_now(const ContactPair& pair, long step) { return pair.counts_springs() && pair.answer_due == step; }

/// Nodes that can touch by a pair's last check and are not counted. The device may have launches to do behind that
/// check: none of them is waited for.
int uncounted_nodes(const ContactPair& pair) {
  // A state that was taken up has the number, but it was not sent.
  if (pair.uncounted_of != pair.near_checked_at) return to_host(pair.uncounted)(0);
  pair.uncounted_arrives.wait();
  return pair.uncounted_sent(0);
}

}  // namespace

bool contact_answers(const std::vector<ContactPair>& contacts, long step) {
  return std::any_of(contacts.begin(), contacts.end(),
                     [step](const ContactPair& pair) { return answers_at(pair, step); });
}

bool contact_has_answered(const std::vector<ContactPair>& contacts, long step) {
  return std::all_of(contacts.begin(), contacts.end(), [step](const ContactPair& pair) {
    return !answers_now(pair, step) ||
           (pair.uncounted_of == pair.near_checked_at && pair.uncounted_arrives.ahead() == 0);
  });
}

bool may_touch_uncounted(const std::vector<ContactPair>& contacts, long step) {
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const ContactPair& pair) { return answers_now(pair, step) && uncounted_nodes(pair) > 0; });
}

void choose_step(Model& model) {
  StableStep& stable = model.stable_step;
  stable.choice = {obstacle(model)};
  if (stable.choice.reason != Reason::pays) return;
  const double asked = asked_gain(model.scene, stable);
  const double least =
      asked > 0 ? asked : least_gain(steps_by_elements(model.scene, stable), has_contact_springs(model.contacts));
  if (!std::isfinite(least)) {
    stable.choice.reason = Reason::short_run;
    return;
  }
  model.global_estimate = std::make_shared<GlobalEstimate>(model, model, model.connectors.cells, model.contacts,
                                                           model.ties, model.absorbing);
  if (!take_if(least, model.scene, model.contacts, model.time, model)) {
    leave_whole_scene(Reason::gains_little, model);
    return;
  }
  for (ContactPair& pair : model.contacts)
    if (pair.has_springs()) pair.counted = Array<double*>("counted", pair.slave_nodes.size());
}

bool may_search_again(const scene::Scene& scene, const StepSizes& sizes, double time, long step) {
  const double all = steps_by_elements(scene, sizes.stable_step);
  const double saved = all * time / scene.time.end - static_cast<double>(step);
  const double cost = applications_of_search * evaluations_of_application;
  return sizes.stable_step.choice.evaluations + cost <=
         free_searches * cost + std::fmax(2 * spent_in_vain * all, 0.5 * saved);
}

void renew_automatic_step(const scene::Scene& scene, const std::vector<ContactPair>& contacts, double time, long step,
                          StepSizes& sizes) {
  // At the beginning bodies lie as they have settled, which the first search could not know.
  if (step > 0 && !may_search_again(scene, sizes, time, step))
    leave_whole_scene(Reason::changes_often, sizes);
  else if (!take_if(std::fmax(still_a_gain, asked_gain(scene, sizes.stable_step)), scene, contacts, time, sizes))
    leave_whole_scene(Reason::no_longer_pays, sizes);
}

void keep_choice(Model& model) {
  const StepChoice::Reason reason = model.stable_step.choice.reason;
  if (reason == Reason::not_asked) return;
  if (reason != Reason::pays)
    model.global_estimate.reset();
  else if (!model.global_estimate)
    model.global_estimate = std::make_shared<GlobalEstimate>(model, model, model.connectors.cells, model.contacts,
                                                             model.ties, model.absorbing);
}

std::string describe_choice(const StepChoice& choice) {
  const std::string spent =
      choice.evaluations > 0 ? fmt::format("; {:.0f} evaluations of forces spent on it", choice.evaluations) : "";
  const auto elements = [&](const std::string& why) { return "the elements' step, for " + why + spent; };
  switch (choice.reason) {
    case Reason::not_asked:
      return {};
    case Reason::pays:
      return fmt::format("the whole scene's step, {:.3g} times the elements'{}", choice.gain, spent);
    case Reason::gains_little:
      return elements(fmt::format("the whole scene's is at most {:.3g} times as long", choice.gain));
    case Reason::short_run:
      return elements("the run is too short to pay for finding a longer one");
    case Reason::step_given:
      return elements("time.step is given");
    case Reason::subcycled:
      return elements("the scene is subcycled");
    case Reason::flows:
      return elements("bodies are so fast that they change their shape");
    case Reason::strikes:
      return elements("bodies strike undamped contact springs");
    case Reason::crack_mouths:
      return elements("contact crosses a crack's mouth");
    case Reason::no_elements:
      return elements("there are no elements");
    case Reason::changes_often:
      return elements("contact changed too often to pay for the longer one, which was taken first");
    case Reason::deforms:
      return elements("bodies have changed their shape, so that the whole scene's, taken first, is no longer");
    case Reason::no_longer_pays:
      return elements(fmt::format("the whole scene's, taken first, is now at most {:.3g} times as long", choice.gain));
  }
  return {};
}

}  // namespace railwave
