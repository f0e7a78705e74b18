#include "solve/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/hexahedron.hpp"
#include "solve/account.hpp"

namespace railwave {
namespace {

constexpr long steps_between_looks = 512, steps_when_odd = 32;

double magnitude(const EnergyAccount& energy) {
  return std::fabs(energy.kinetic) + std::fabs(energy.internal) + std::fabs(energy.hourglass) + std::fabs(energy.contact) + std::fabs(energy.connector) +
         std::fabs(energy.plastic);
}

}  // namespace

Watch::Watch(const Model& model) : model_(model) {
  if (!model.scene.watch.active) return;
  arrays_ = std::make_unique<WatchArrays>(model);
  most_of_part_.resize(model.assembly.parts.size());
}

bool Watch::due(long step) const {
  if (step % steps_between_looks == 0) return true;
  if (!arrays_) return false;
  const bool power_of_two = (step & (step - 1)) == 0;
  return (step < steps_between_looks && power_of_two) || (odd_ && step % steps_when_odd == 0);
}

bool Watch::finite(const HistorySample& sample) const { return std::isfinite(balance_total(sample.energy)); }

std::vector<Fault> Watch::look(const HistorySample& sample) {
  new_.clear();
  if (!arrays_) {
    if (!finite(sample)) note(FaultKind::not_finite, true, 0, 0, sample, {}, false);
    return new_;
  }
  const bool whole = due(sample.step) || !finite(sample) || model_.step == model_.step_count;
  if (whole) {
    WatchMeasures now = arrays_->measure(model_);
    if (!begun_) evidence_.first = now;
    if (finite(sample) && std::isfinite(now.speed.value)) evidence_.last = now;
    else if (evidence_.last.speed.place < 0) evidence_.last.speed.place = now.speed.place;
  }
  evidence_.deepest.resize(evidence_.last.penetration.size());
  for (std::size_t c = 0; c < evidence_.deepest.size(); ++c)
    evidence_.deepest[c] = std::max(evidence_.deepest[c], evidence_.last.penetration[c].value);
  if (!begun_) {
    given_at_start_ = magnitude(sample.energy);
    for (Fault& fault : absurd_materials(model_)) {
      fault.time = fault.worst_time = sample.time;
      fault.step = sample.step;
      new_.push_back(fault);
      found_.push_back(std::move(fault));
    }
  }
  begun_ = true;
  const double work = std::fabs(sample.energy.external_work);
  evidence_.kinetic_share = work > 0 ? sample.energy.kinetic / work : 0;
  if (!finite(sample)) {
    note(FaultKind::not_finite, true, 0, 0, sample, evidence_.last.speed, false);
    return new_;
  }
  if (whole) look_at_model(sample);
  look_at_energies(sample);
  if (whole && by_part_.size() == most_of_part_.size()) look_at_parts(sample);
  return new_;
}

void Watch::look_at_model(const HistorySample& sample) {
  const scene::Watch& limit = model_.scene.watch;
  const WatchMeasures& now = evidence_.last;
  if (now.jacobian.place >= 0 && !(now.jacobian.value > limit.volume_ratio)) {
    const bool inverted = !(now.jacobian.value > 0) && !(evidence_.first.jacobian.value <= 0 && sample.step == 0);
    note(FaultKind::inversion, inverted, now.jacobian.value, inverted ? 0 : limit.volume_ratio, sample, now.jacobian, true);
  }
  if (now.distortion.place >= 0 && now.distortion.value > limit.hourglass_distortion)
    note(FaultKind::hourglass_distortion, false, now.distortion.value, limit.hourglass_distortion, sample, now.distortion, true);
  if (now.speed.value > limit.speed) {
    const bool fatal = now.speed.value > limit.fatal_speed;
    note(FaultKind::speed, fatal, now.speed.value, fatal ? limit.fatal_speed : limit.speed, sample, now.speed, false);
  }
  for (const Extreme& one : now.penetration)
    if (one.value > limit.penetration) note(FaultKind::penetration, false, one.value, limit.penetration, sample, one, false);
  for (const Extreme& one : now.chatter)
    if (one.value > limit.chatter) note(FaultKind::chatter, false, one.value, limit.chatter, sample, one, false);
}

/// What the run was given: what it began with, and the most that loads have worked so far.
void Watch::look_at_energies(const HistorySample& sample) {
  const scene::Watch& limit = model_.scene.watch;
  const EnergyAccount& energy = sample.energy;
  given_ = std::max(given_, given_at_start_ + std::fabs(energy.external_work) - std::min(0.0, energy.connector));
  if (!(given_ > 0)) return;
  const double error = std::fabs(energy.balance_error) / given_, beyond = energy.kinetic / given_ - 1;
  odd_ = error > 0.2 * limit.energy_error;
  if (error > limit.energy_error) {
    const bool fatal = error > limit.fatal_energy_error;
    note(FaultKind::energy, fatal, error, fatal ? limit.fatal_energy_error : limit.energy_error, sample, evidence_.last.speed, false);
  }
  if (beyond > limit.kinetic_growth) note(FaultKind::kinetic, false, beyond, limit.kinetic_growth, sample, evidence_.last.speed, false);
}

void Watch::look_at_parts(const HistorySample& sample) {
  const double limit = model_.scene.watch.hourglass_share;
  double all = 0;
  for (std::size_t p = 0; p < by_part_.size(); ++p) {
    most_of_part_[p].internal = std::max(most_of_part_[p].internal, by_part_[p].internal);
    most_of_part_[p].hourglass = std::max(most_of_part_[p].hourglass, by_part_[p].hourglass);
    all += most_of_part_[p].internal;
  }
  for (std::size_t p = 0; p < by_part_.size(); ++p) {
    // Parts that hardly deform have nothing to be spoilt.
    const double elastic = most_of_part_[p].internal, hourglass = most_of_part_[p].hourglass;
    if (!(elastic > 1e-3 * all) || !(hourglass > limit * elastic)) continue;
    Extreme where;
    const auto& range = model_.assembly.parts[p];
    const int seen = evidence_.last.distortion.place;
    where.place = seen >= range.first_element && seen < range.first_element + range.element_count ? seen : range.first_element;
    note(FaultKind::hourglass_share, false, hourglass / elastic, limit, sample, where, true);
  }
}

void Watch::note(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample, Extreme where, bool at_element) {
  const auto known = std::find_if(found_.begin(), found_.end(), [&](const Fault& one) { return one.kind == kind; });
  const bool lower_is_worse = kind == FaultKind::inversion;
  if (known != found_.end() && (lower_is_worse ? value < known->worst : value > known->worst)) {
    known->worst = value;
    known->worst_time = sample.time;
  }
  // What has become fatal is told anew.
  if (known != found_.end() && (known->fatal || !fatal)) return;
  Fault fault;
  fault.kind = kind;
  fault.fatal = fatal;
  fault.time = fault.worst_time = sample.time;
  fault.step = sample.step;
  fault.value = fault.worst = value;
  fault.limit = limit;
  if (at_element) place_at_element(fault, where.place);
  else place_at_node(fault, where.place);
  fault.causes = likely_causes(model_, fault, evidence_);
  new_.push_back(fault);
  if (known != found_.end()) *known = std::move(fault);
  else found_.push_back(std::move(fault));
}

void Watch::place_at_element(Fault& fault, int element) const {
  if (element < 0) return;
  fault.element = element;
  fault.element_volume = hexahedron_volume(corners_of(model_.assembly.nodes, model_.assembly.elements[element]));
  for (int n : model_.assembly.elements[element])
    for (int i = 0; i < 3; ++i) fault.place[i] += 0.125 * model_.assembly.nodes[n][i];
  for (const auto& part : model_.assembly.parts) {
    const int within = element - part.first_element;
    if (within < 0 || within >= part.element_count) continue;
    fault.part = part.name;
    fault.element_in_part = within;
  }
}

void Watch::place_at_node(Fault& fault, int node) const {
  if (node < 0) return;
  const auto& elements = model_.assembly.elements;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (std::find(elements[e].begin(), elements[e].end(), node) != elements[e].end()) {
      place_at_element(fault, static_cast<int>(e));
      break;
    }
  fault.node = node;
  fault.place = model_.assembly.nodes[node];
}

const Fault* Watch::fatal() const {
  // The first that stops the run; what is not finite says the least, so it comes last.
  const Fault* first = nullptr;
  for (const Fault& fault : found_)
    if (fault.fatal && (first == nullptr || first->kind == FaultKind::not_finite)) first = &fault;
  return first;
}

std::vector<std::string> Watch::told() const {
  std::vector<std::string> lines;
  for (const Fault& fault : found_) {
    std::string line = "watch: " + fault.told();
    if (fault.worst != fault.value) line += fmt::format(" (worst {:.4g}, at t = {:.6g} s)", fault.worst, fault.worst_time);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace railwave
