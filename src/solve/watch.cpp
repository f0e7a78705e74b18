#include "solve/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/hexahedron.hpp"
#include "solve/account.hpp"
#include "solve/diagnosis_units.hpp"

namespace railwave {
namespace {

/// Between regular looks: a 64th of the run, but within these bounds; powers of two, whole rounds of any levels.
constexpr long fewest_between_looks = 512, most_between_looks = 4096, looks_of_run = 64;
constexpr long steps_when_odd = 32;
static_assert(fewest_between_looks % (1L << (most_levels - 1)) == 0);
/// Smallest Jacobian at a corner, over the mean.
constexpr double flattest_corner = 0.03;
/// Of the whole model's deformation: parts that have less are measured by that.
constexpr double least_share = 0.1;
/// In which a contact patch is passed, or a high mode fades, s.
constexpr double short_while = 1e-3;

double magnitude(const EnergyAccount& energy) {
  return std::fabs(energy.kinetic) + std::fabs(energy.internal) + std::fabs(energy.hourglass) + std::fabs(energy.contact) + std::fabs(energy.connector) +
         std::fabs(energy.plastic);
}

}  // namespace

Watch::Watch(const Model& model) : model_(model) {
  if (!model.scene.watch.active) return;
  arrays_ = std::make_unique<WatchArrays>(model);
  evidence_.worst_shape = arrays_->worst_shape();
  parts_.resize(model.assembly.parts.size());
}

bool Watch::due(long step) const {
  if (regular(step)) return true;
  if (!arrays_) return false;
  const bool power_of_two = (step & (step - 1)) == 0;
  return (step < most_between_looks && power_of_two) || (odd_ && step % steps_when_odd == 0);
}

bool Watch::regular(long step) const {
  long between = fewest_between_looks;
  while (between < most_between_looks && 2 * between * looks_of_run <= model_.step_count) between *= 2;
  return step % between == 0 || step == model_.step_count;
}

bool Watch::finite(const HistorySample& sample) const { return std::isfinite(balance_total(sample.energy)); }

std::vector<Fault> Watch::look(const HistorySample& sample) {
  new_.clear();
  if (!arrays_) {
    if (!finite(sample)) note(FaultKind::not_finite, true, 0, 0, sample, {}, false);
    return new_;
  }
  const bool whole = due(sample.step) || !finite(sample);
  if (whole) {
    WatchMeasures now = arrays_->measure(model_);
    if (!begun_) evidence_.first = now;
    if (finite(sample) && std::isfinite(now.speed.value)) evidence_.last = now;
    else if (evidence_.last.speed.place < 0) evidence_.last.speed.place = now.speed.place;
  }
  evidence_.deepest.resize(evidence_.last.penetration.size());
  for (std::size_t c = 0; c < evidence_.deepest.size(); ++c)
    evidence_.deepest[c] = std::max(evidence_.deepest[c], evidence_.last.penetration[c].value);
  if (!begun_) look_at_beginning(sample);
  begun_ = true;
  evidence_.touching.clear();
  for (const ContactTotals& contact : sample.contacts) evidence_.touching.push_back(contact.nodes_in_contact);
  const double work = std::fabs(sample.energy.external_work);
  evidence_.kinetic_share = work > 0 ? sample.energy.kinetic / work : 0;
  if (!finite(sample)) {
    note(FaultKind::not_finite, true, 0, 0, sample, evidence_.last.speed, false);
    return new_;
  }
  if (whole) look_at_model(sample);
  look_at_energies(sample);
  if (whole && by_part_.size() == parts_.size()) look_at_parts(sample);
  return new_;
}

void Watch::look_at_beginning(const HistorySample& sample) {
  given_at_start_ = magnitude(sample.energy);
  for (Fault& fault : absurd_units(model_)) {
    fault.time = sample.time;
    fault.step = sample.step;
    add(std::move(fault));
  }
  const Extreme worst = evidence_.worst_shape;
  if (worst.place >= 0 && worst.value < flattest_corner) note(FaultKind::shape, false, worst.value, flattest_corner, sample, worst, true);
}

void Watch::look_at_model(const HistorySample& sample) {
  const scene::Watch& limit = model_.scene.watch;
  const WatchMeasures& now = evidence_.last;
  if (now.jacobian.place >= 0) judge(FaultKind::inversion, now.jacobian.value, {limit.volume_ratio, 0}, sample, now.jacobian, true);
  if (now.distortion.place >= 0) judge(FaultKind::hourglass_distortion, now.distortion.value, {limit.hourglass_distortion}, sample, now.distortion, true);
  judge(FaultKind::speed, now.speed.value, {limit.speed, limit.fatal_speed}, sample, now.speed);
  for (const Extreme& one : now.penetration) judge(FaultKind::penetration, one.value, {limit.penetration}, sample, one);
  for (const Extreme& one : now.chatter) judge(FaultKind::chatter, one.value, {static_cast<double>(limit.chatter)}, sample, one);
}

/// What the run was given: what it began with, and the most that loads have worked so far.
void Watch::look_at_energies(const HistorySample& sample) {
  const scene::Watch& limit = model_.scene.watch;
  const EnergyAccount& energy = sample.energy;
  given_ = std::max(given_, given_at_start_ + std::fabs(energy.external_work) - std::min(0.0, energy.connector));
  if (!(given_ > 0)) return;
  const double error = std::fabs(energy.balance_error) / given_, beyond = energy.kinetic / given_ - 1;
  // What is off but stays so needs no closer look.
  odd_ = error > 0.2 * limit.energy_error && error > 1.1 * error_before_;
  if (regular(sample.step)) error_before_ = error;
  // What an instability adds is there. An account that is only wrong, as that of hourglass control near the stable step can be, does not end
  // a run.
  const double present = energy.kinetic + energy.internal + energy.contact + std::fmax(0.0, energy.connector);
  const double fatal = present > (1 + limit.fatal_energy_error) * given_ ? limit.fatal_energy_error : std::numeric_limits<double>::infinity();
  // In the first steps under a load little is given.
  if (sample.step >= steps_when_odd || error > fatal)
    judge(FaultKind::energy, error, {limit.energy_error, fatal}, sample, evidence_.last.speed);
  judge(FaultKind::kinetic, beyond, {limit.kinetic_growth}, sample, evidence_.last.speed);
}

void Watch::look_at_parts(const HistorySample& sample) {
  double all = 0;
  for (std::size_t p = 0; p < by_part_.size(); ++p) {
    WatchedPart& part = parts_[p];
    part.deformation = std::max(part.deformation, by_part_[p].internal);
    // What viscous control dissipates adds up in any run: what tells is how fast.
    const double gain = std::max(0.0, by_part_[p].hourglass - part.hourglass_before);
    part.dissipated_lately = part.dissipated_lately * std::exp((part.time_before - sample.time) / short_while) + gain;
    part.stored = std::max(part.stored, by_part_[p].hourglass);
    part.hourglass_before = by_part_[p].hourglass;
    part.time_before = sample.time;
    all += part.deformation;
  }
  // The first waves under a load are no picture of the run.
  if (sample.step == 0 || !regular(sample.step)) return;
  for (std::size_t p = 0; p < by_part_.size(); ++p) {
    // Parts that hardly deform have little to be spoilt.
    const double deformation = std::max(parts_[p].deformation, least_share * all);
    if (!(deformation > 0)) continue;
    const bool viscous = model_.scene.parts[p].hourglass == scene::HourglassType::viscous;
    Extreme where;
    const auto& range = model_.assembly.parts[p];
    const int seen = evidence_.last.distortion.place;
    where.place = seen >= range.first_element && seen < range.first_element + range.element_count ? seen : range.first_element;
    judge(FaultKind::hourglass_share, (viscous ? parts_[p].dissipated_lately : parts_[p].stored) / deformation, {model_.scene.watch.hourglass_share}, sample,
          where, true);
  }
}

void Watch::judge(FaultKind kind, double value, Limits limits, const HistorySample& sample, Extreme where, bool at_element) {
  const bool lower_is_worse = kind == FaultKind::inversion;
  const auto passes = [&](double limit) { return lower_is_worse ? !(value > limit) : !(value <= limit); };
  Worst& worst = worst_[static_cast<int>(kind)];
  if (!worst.seen || passes(worst.value)) worst = {value, limits.warning, sample.time, true};
  if (!passes(limits.warning)) return;
  const bool fatal = passes(limits.fatal);
  note(kind, fatal, value, fatal ? limits.fatal : limits.warning, sample, where, at_element);
}

void Watch::note(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample, Extreme where, bool at_element) {
  // What has become fatal is told anew.
  const auto known = std::find_if(found_.begin(), found_.end(), [&](const Fault& one) { return one.kind == kind; });
  if (known != found_.end() && (known->fatal || !fatal)) return;
  Fault fault;
  fault.kind = kind;
  fault.fatal = fatal;
  fault.time = sample.time;
  fault.step = sample.step;
  fault.value = value;
  fault.limit = limit;
  if (at_element) place_at_element(fault, where.place);
  else place_at_node(fault, where.place);
  fault.causes = likely_causes(model_, fault, evidence_);
  add(std::move(fault));
}

void Watch::add(Fault fault) {
  new_.push_back(fault);
  const auto known = std::find_if(found_.begin(), found_.end(), [&](const Fault& one) { return one.kind == fault.kind; });
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
    const Worst& worst = worst_[static_cast<int>(fault.kind)];
    if (worst.seen && worst.value != fault.value) line += fmt::format(" (worst {:.4g}, at t = {:.6g} s)", worst.value, worst.time);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string Watch::worst_told() const {
  std::string line;
  for (int kind = 0; kind < fault_kinds; ++kind)
    if (const Worst& worst = worst_[kind]; worst.seen)
      line += fmt::format("{}{} {:.3g} ({:.3g})", line.empty() ? "" : ", ", key_of(static_cast<FaultKind>(kind)), worst.value, worst.limit);
  return line;
}

}  // namespace railwave
