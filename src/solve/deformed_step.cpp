#include "solve/deformed_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/elements/relative_coordinates.hpp"
#include "model/model.hpp"
#include "model/time_step/automatic_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// Steps between checks; powers of two.
constexpr long fewest_at_rest = 16, most_at_rest = 512;
/// Share of the way to where an element is in the way after which the next check comes.
constexpr double share_of_way = 0.5, share_of_way_at_rest = 0.25;
/// Of the allowed step that may be used before the step is made shorter; that which must never be used.
constexpr double most_used = 0.92, never_used = 0.97;
/// Below that share of the limit elements are looked at in motion too.
constexpr double hardly_deformed = 0.99;
/// A step so much longer than what is allowed has been unstable for a while: what deforms then is no body, and the
/// monitor ends the run. Shorter steps would only draw that out.
constexpr double beyond_help = 1.25;
/// Elements that have lost less have their shape.
constexpr double any_loss = 1e-3;
/// A step is made longer again where it can grow so much.
constexpr double worthwhile_growth = 1.1;
/// Less than that share of the undeformed limit is not followed: such elements are about to invert, which the monitor
/// stops.
constexpr double least_left = 0.05;

long layouts_of(const std::vector<ContactPair>& contacts) {
  long all = 0;
  for (const ContactPair& pair : contacts) all += pair.layouts;
  return all;
}

}  // namespace

DeformedStep::DeformedStep(const Model& model, DeformedElements elements, SampledRanks* others)
    : scene_(model.scene),
      nodal_(model),
      contacts_(model.contacts),
      sizes_(model),
      others_(others),
      any_(!model.assembly.elements.empty() && std::isfinite(model.stable_step.limit)),
      elements_(std::move(elements)),
      fast_(striking_speed(model)),
      undeformed_(model.stable_step.limit) {}

bool DeformedStep::may_strike() const { return moves_fast() && (2 * approach_ > fast_ || window_is_new()); }

bool DeformedStep::window_is_new() const { return layouts_ != layouts_of(contacts_); }

bool DeformedStep::contact_checked_before(long step) const {
  return std::any_of(contacts_.begin(), contacts_.end(),
                     [&](const ContactPair& pair) { return railwave::contact_checked_before(pair, step); });
}

bool DeformedStep::due(long step) const {
  return any_ && !given_up_ && nodal_.subcycling.in_phase(step) &&
         (step >= next_ || (may_strike() && contact_checked_before(step)));
}

/// @param approach whether that of the contacts is asked for, too
DeformedNow DeformedStep::measure_now(double elements, bool approach) const {
  const std::vector<ContactPair> none_asked;
  DeformedNow found =
      railwave::measure_now(elements_, nodal_, undeformed_, elements, approach ? contacts_ : none_asked);
  if (others_ != nullptr) others_->join_deformed(found, undeformed_, elements);
  return found;
}

DeformedAhead DeformedStep::measure_ahead(double limit, double least) const {
  DeformedAhead found = railwave::measure_ahead(elements_, nodal_, limit, sizes_.step_size, least);
  if (others_ != nullptr) others_->join_deformed(found, limit, sizes_.step_size, least);
  return found;
}

/// Share of the stable step that is used by [time].
double DeformedStep::used_share() const {
  StableStep undeformed;
  undeformed.limit = undeformed_;
  return largest_step(scene_.time, undeformed) / undeformed_;
}

bool DeformedStep::check() { return due(nodal_.step) && check(sizes_.step_size); }

bool DeformedStep::check_again() {
  if (!any_ || given_up_) return false;
  next_ = nodal_.step;
  return check(largest_step(scene_.time, sizes_.stable_step));
}

/// @param size s, of the step that is to be judged
bool DeformedStep::check(double size) {
  const long step = nodal_.step, cycle = nodal_.subcycling.cycle();
  if (nodal_.relative.begun) update_absolute_nodes(nodal_);
  const bool whole = sizes_.global_estimate != nullptr;
  const double elements = whole ? elements_limit(sizes_.stable_step) : undeformed_;
  const bool asks_approach = moves_fast() && (step >= next_ || window_is_new());
  std::optional<DeformedNow> measured;
  if (step >= next_) measured = measure_now(elements, asks_approach);
  if (!moves_fast()) {
    layouts_ = none;  // nobody asks for the approach, and it will be another one
  } else if (asks_approach) {
    approach_ = measured ? measured->approach : fastest_approach(nodal_, contacts_);
    layouts_ = layouts_of(contacts_);
  }
  const double to_strike = may_strike() ? steps_to_strike(nodal_, contacts_, fast_, sizes_.step_size)
                                        : std::numeric_limits<double>::infinity();
  const bool strikes = to_strike < most_at_rest;
  if (strikes) next_ = std::min(next_, step + static_cast<long>(0.8 * to_strike));
  if (step < next_) return false;

  const DeformedNow now = measured ? *measured : measure_now(elements, false);
  speed_ = now.speed;
  by_elements_ = now.second >= now.first;
  found_ = std::fmax(std::fmin(std::fmax(now.first, now.second), undeformed_), least_left * undeformed_);
  given_up_ = size > beyond_help * found_;
  if (given_up_) return false;
  const double left = found_ / undeformed_;
  double steps =
      std::clamp(static_cast<double>(step), static_cast<double>(fewest_at_rest), static_cast<double>(most_at_rest));
  const double used = used_share(), alarm = std::fmax(most_used, used + 0.2 * (1 - used)),
               never = std::fmax(never_used, used + 0.6 * (1 - used));
  loss_ = 0;
  if (left < hardly_deformed || strikes || striking_ || moving_) {
    const DeformedAhead ahead = measure_ahead(by_elements_ ? elements : undeformed_, size / never);
    loss_ = ahead.loss;
    steps = std::fmin(steps, share_of_way * ahead.steps);
    moving_ = ahead.steps < 4 * most_at_rest;
  } else if (left < left_ && step > last_) {
    steps =
        std::fmin(steps, share_of_way_at_rest * (left - alarm) * static_cast<double>(step - last_) / (left_ - left));
  }
  // What lies on the other body from the beginning is met in the first step, before there are windows.
  if (step == 0 && moves_fast()) {
    steps = 1;
    moving_ = true;
  }
  if (strikes) steps = std::fmin(steps, 0.8 * to_strike);
  striking_ = strikes;
  left_ = left;
  last_ = step;
  next_ = step + std::max(1L, static_cast<long>(std::ceil(std::fmax(steps, 1) / static_cast<double>(cycle)))) * cycle;
  const StableStep& stable = sizes_.stable_step;
  return (size > alarm * found_ && left < 1 - any_loss) ||
         (stable.deformed > 0 && std::fmin(found_, undeformed_) > worthwhile_growth * stable.limit);
}

void DeformedStep::set(StableStep& stable) {
  // Ahead of what comes, so that the step changes seldom.
  const double ahead = std::clamp(16 * loss_, 0.005, 0.04);
  const bool as_new = found_ >= (1 - 0.005) * undeformed_;
  stable.limit = as_new ? undeformed_ : (1 - ahead) * found_;
  stable.deformed = as_new ? 0 : stable.limit;
}

}  // namespace railwave
