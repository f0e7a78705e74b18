#include "solve/monitor/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/hexahedron.hpp"
#include "solve/monitor/account.hpp"

namespace railwave {
namespace {

/// Between regular checks: at most a 23rd of the run, as for energies, but within these bounds; powers of two, whole
/// cycles of any levels.
constexpr long fewest_between_checks = 512, most_between_checks = 4096, checks_of_run = 23;
/// At the energies alone, at least: a broken account must not waste more than a twentieth of a run. Long runs have
/// twice as many, each in half the time: a check of a GPU takes as long as ten steps.
constexpr long energy_checks_of_run = 24, most_energy_checks = 48;
static_assert(fewest_between_checks % (1L << (most_levels - 1)) == 0);
/// Smallest Jacobian at a corner, over the mean.
constexpr double flattest_corner = 0.03;
/// Of the whole model's deformation: parts that have less are measured by that.
constexpr double least_share = 0.1;
/// What a step's rounding can do to the energy given: velocities are rounded to half a unit in the last place, so that
/// a step changes v^2 by two such halves at most; and as much again for the sums and for the work. Steps before the
/// first count for sums.
constexpr double rounding_of_step = 4 * 0.5 * std::numeric_limits<double>::epsilon();
constexpr double steps_of_sums = 1000;
/// The same of loads' work where nodes are in single precision: these hold what work has changed of the motion that a
/// part began with.
constexpr double rounding_of_single_step = 4 * 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
/// Of the part (w dt)^2 of its kinetic energy, what the first steps of a body that turns by w dt in each, unsettled,
/// can lose or make: they carry its nodes along tangents, and it rings with what that stretches.
constexpr double turning = 4;
/// The angle that loads may make bodies turn by in a step: the same of their work.
constexpr double turned_by_loads = 5e-4;
/// In which a contact patch is passed, or a high mode fades, s.
constexpr double short_while = 1e-3;

double magnitude(const EnergyAccount& energy) {
  return std::fabs(energy.kinetic) + std::fabs(energy.internal) + std::fabs(energy.hourglass) +
         std::fabs(energy.contact) + std::fabs(energy.connector) + std::fabs(energy.plastic);
}

/// What is seen at an instant, without its place and causes.
Fault seen_at(const HistorySample& sample, FaultKind kind, bool fatal, double value, double limit) {
  Fault fault;
  fault.kind = kind;
  fault.fatal = fatal;
  fault.time = sample.time;
  fault.step = sample.step;
  fault.value = value;
  fault.limit = limit;
  return fault;
}

}  // namespace

Monitor::Monitor(const AssembledScene& assembled, const NodalState& nodal, const StepSizes& sizes,
                 const LoadModel& loads, const std::vector<ContactPair>& contacts, const SceneAsMade& made,
                 const OwnItems* own, SampledRanks* others)
    : assembled_(assembled), nodal_(nodal), sizes_(sizes), loads_(loads), contacts_(contacts), others_(others) {
  if (!assembled.scene.monitor.active) return;
  arrays_ = std::make_unique<MonitorArrays>(assembled.assembly, contacts, own);
  evidence_.worst_shape = made.worst_shape;
  energy_of_rounding_ = made.energy_of_rounding;
  energy_of_rest_ = made.energy_of_rest;
  energy_of_places_ = made.energy_of_places;
  parts_.resize(assembled.assembly.parts.size());
  if (!contacts.empty()) ends_ = std::make_unique<EndMonitor>(assembled, nodal, contacts, others);
}

void Monitor::check_contact_ends(long step) {
  static_assert(EndMonitor::steps_between % (1L << (most_levels - 1)) == 0);
  if (!contact_ends_due(step) || whole_due(step)) return;
  ends_->check(false);
  for (std::size_t c = 0; c < ends_->sightings().size(); ++c) {
    const EndSighting& seen = ends_->sightings()[c];
    const std::string& name = assembled_.scene.contacts[c].name;
    wants_check_ = wants_check_ ||
                   (seen.at_end > assembled_.scene.monitor.contact_edge && !knows(FaultKind::contact_edge, name)) ||
                   (seen.outside_zone > assembled_.scene.monitor.fine_zone && !knows(FaultKind::contact_zone, name)) ||
                   seen.lost;
  }
}

bool Monitor::knows(FaultKind kind, const std::string& contact) const {
  return std::any_of(found_.begin(), found_.end(),
                     [&](const Fault& one) { return one.kind == kind && one.contact == contact; });
}

bool Monitor::due(long step) const { return whole_due(step) || (arrays_ && energies_due(step)); }

bool Monitor::energies_due(long step) const {
  long between = fewest_between_checks;
  while (between > steps_when_odd && between * energy_checks_of_run > sizes_.step_count) between /= 2;
  while (between < most_between_checks && 2 * between * most_energy_checks <= sizes_.step_count) between *= 2;
  return step % between == 0;
}

bool Monitor::whole_due(long step) const {
  if (regular(step)) return true;
  if (!arrays_) return false;
  const bool power_of_two = (step & (step - 1)) == 0;
  return (step < most_between_checks && power_of_two) || ((odd_ || wants_check_) && step % steps_when_odd == 0);
}

bool Monitor::regular(long step) const {
  long between = fewest_between_checks;
  while (between < most_between_checks && 2 * between * checks_of_run <= sizes_.step_count) between *= 2;
  return step % between == 0 || step == sizes_.step_count;
}

bool Monitor::finite(const HistorySample& sample) const { return std::isfinite(balance_total(sample.energy)); }

std::vector<Fault> Monitor::check(const HistorySample& sample) {
  new_.clear();
  if (!arrays_) {
    if (!finite(sample)) note(FaultKind::not_finite, true, 0, 0, sample, {}, false);
    return new_;
  }
  if (!begun_) {
    given_at_start_ = magnitude(sample.energy);
    rate_at_start_ = arrays_->largest_rate(nodal_);
    if (others_ != nullptr) rate_at_start_ = others_->largest_rate(rate_at_start_);
  }
  if (finite(sample)) weigh_energies(sample);
  const bool whole_asked = whole_due(sample.step);
  const bool whole = whole_asked || !finite(sample) || share_ > assembled_.scene.monitor.fatal_energy_error;
  wants_check_ = false;
  if (whole) {
    MonitorMeasures now = arrays_->measure(nodal_, contacts_);
    if (others_ != nullptr) others_->join_measures(now);
    if (!begun_) evidence_.first = now;
    if (finite(sample) && std::isfinite(now.speed.value))
      evidence_.last = now;
    else if (evidence_.last.speed.place < 0)
      evidence_.last.speed.place = now.speed.place;
  }
  evidence_.deepest.resize(evidence_.last.penetration.size());
  for (std::size_t c = 0; c < evidence_.deepest.size(); ++c)
    evidence_.deepest[c] = std::max(evidence_.deepest[c], evidence_.last.penetration[c].value);
  if (!begun_) check_beginning(sample);
  begun_ = true;
  evidence_.touching.clear();
  for (const ContactTotals& contact : sample.contacts) {
    if (ends_ && contact.nodes_in_contact > 0) ends_->note_closed(evidence_.touching.size());
    evidence_.touching.push_back(contact.nodes_in_contact);
  }
  const double work = std::fabs(sample.energy.external_work);
  evidence_.kinetic_share = work > 0 ? sample.energy.kinetic / work : 0;
  if (!finite(sample)) {
    note(FaultKind::not_finite, true, 0, 0, sample, evidence_.last.speed, false);
    return new_;
  }
  if (whole) check_model(sample);
  check_energies(sample);
  if (whole && ends_) check_ends(sample);
  if (whole_asked && by_part_.size() == parts_.size()) check_parts(sample);
  return new_;
}

void Monitor::check_beginning(const HistorySample& sample) {
  for (Fault& fault : absurd_units(assembled_)) {
    fault.time = sample.time;
    fault.step = sample.step;
    add(std::move(fault));
  }
  const Extreme worst = evidence_.worst_shape;
  if (worst.place >= 0 && worst.value < flattest_corner)
    note(FaultKind::shape, false, worst.value, flattest_corner, sample, worst, true);
}

void Monitor::check_model(const HistorySample& sample) {
  const scene::Monitor& limit = assembled_.scene.monitor;
  const MonitorMeasures& now = evidence_.last;
  if (now.jacobian.place >= 0)
    judge(FaultKind::inversion, now.jacobian.value, {limit.volume_ratio, 0}, sample, now.jacobian, true);
  if (now.distortion.place >= 0)
    judge(FaultKind::hourglass_distortion, now.distortion.value, {limit.hourglass_distortion}, sample, now.distortion,
          true);
  judge(FaultKind::speed, now.speed.value, {limit.speed, limit.fatal_speed}, sample, now.speed);
  for (const Extreme& one : now.penetration) judge(FaultKind::penetration, one.value, {limit.penetration}, sample, one);
  for (const Extreme& one : now.chatter)
    judge(FaultKind::chatter, one.value, {static_cast<double>(limit.chatter)}, sample, one);
}

/// J, that rounding and the step explain of an error of the balance.
double Monitor::floor_of_error(const HistorySample& sample) const {
  const double turn = rate_at_start_ * sizes_.step_size, steps = steps_of_sums + static_cast<double>(sample.step);
  double floor =
      given_ * (rounding_of_step * steps + turning * turn * turn) + work_ * turning * turned_by_loads * turned_by_loads;
  if (assembled_.scene.solver.precision == scene::Precision::single_precision)
    floor += rounding_of_single_step * steps * work_;
  floor += (1 + static_cast<double>(sample.step)) * energy_of_places_;
  return floor + steps * energy_of_rest_ + std::min(energy_of_rounding_, rounding_of_single_step * given_);
}

/// The error against what deforms (docs/monitor.md): rigid travel is in kinetic energy and in the work of loads alone,
/// so it counts in the floor only.
void Monitor::weigh_energies(const HistorySample& sample) {
  const EnergyAccount& energy = sample.energy;
  work_ = std::max(work_, std::fabs(energy.external_work));
  given_ = std::max(given_, given_at_start_ + std::fabs(energy.external_work) - std::min(0.0, energy.connector));
  // An impact can only take energy: what an account of impacts gives back, contact has made.
  impacts_ = std::max(impacts_, energy.impacts);
  const double error = energy.balance_error + (impacts_ - energy.impacts);
  deformation_ = std::max(deformation_, deformation_energy(energy) - std::max(0.0, error));
  const double floor = floor_of_error(sample), scale = std::max(deformation_, floor),
               beyond = std::max(0.0, std::fabs(error) - floor);
  share_ = scale > 0 ? beyond / scale : 0;
  blown_up_ = beyond > assembled_.scene.monitor.fatal_energy_error * std::max(scale, given_);
  kinetic_share_ = scale > 0 ? std::max(0.0, energy.kinetic - given_ - floor) / scale : 0;
}

void Monitor::check_ends(const HistorySample& sample) {
  const scene::Monitor& limit = assembled_.scene.monitor;
  ends_->check(regular(sample.step));
  for (std::size_t c = 0; c < ends_->sightings().size(); ++c) {
    const EndSighting& seen = ends_->sightings()[c];
    judge_contact(FaultKind::contact_edge, false, seen.at_end, limit.contact_edge, sample, c, seen.end_node, seen.end);
    judge_contact(FaultKind::contact_zone, false, seen.outside_zone, limit.fine_zone, sample, c, seen.zone_node,
                  seen.zone);
    if (seen.lost) judge_contact(FaultKind::contact_lost, true, 1, 0, sample, c, seen.end_node, seen.end);
  }
}

void Monitor::judge_contact(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample,
                            std::size_t contact, int node, const std::string& text) {
  Worst& worst = worst_[static_cast<int>(kind)];
  if (!fatal && (!worst.seen || value > worst.value)) worst = {value, limit, sample.time, true};
  const std::string& name = assembled_.scene.contacts[contact].name;
  if (!(value > limit) || knows(kind, name)) return;
  Fault fault = seen_at(sample, kind, fatal, value, limit);
  fault.contact = name;
  place_at_node(fault, node);
  fault.causes.push_back(Cause{"end of a contact surface", text, 97});
  add(std::move(fault));
}

void Monitor::check_energies(const HistorySample& sample) {
  const scene::Monitor& limit = assembled_.scene.monitor;
  // What is off but stays so needs no closer check.
  odd_ = share_ > 0.2 * limit.energy_error && (share_ > 1.1 * share_before_ || share_ > limit.fatal_energy_error);
  if (regular(sample.step)) share_before_ = share_;
  judge_lasting(FaultKind::energy, share_, {limit.energy_error, limit.fatal_energy_error}, lasting_error_, sample);
  judge_lasting(FaultKind::kinetic, kinetic_share_, {limit.kinetic_growth}, lasting_growth_, sample);
}

/// A node that touches first has next to nothing deformed yet, and can err by as much: what is beyond a limit counts
/// when it has lasted.
void Monitor::judge_lasting(FaultKind kind, double value, Limits limits, Lasting& lasting,
                            const HistorySample& sample) {
  const bool last = sample.step == sizes_.step_count;
  const auto judge_it = [&](double what) { judge(kind, what, limits, sample, evidence_.last.acceleration); };
  if (blown_up_ || last || value <= limits.warning) {
    lasting.since = -1;
    // In the first steps under a load little has deformed.
    if (blown_up_ || last || sample.step >= steps_when_odd) judge_it(value);
  } else if (lasting.since < 0) {
    lasting = {value, sample.step};
  } else {
    lasting.least = std::min(lasting.least, value);
    if (sample.step - lasting.since < steps_when_odd) return;
    judge_it(lasting.least);
    lasting = {value, sample.step};
  }
}

void Monitor::check_parts(const HistorySample& sample) {
  double all = 0;
  for (std::size_t p = 0; p < by_part_.size(); ++p) {
    MonitoredPart& part = parts_[p];
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
    const bool viscous = assembled_.scene.parts[p].hourglass == scene::HourglassType::viscous;
    Extreme where;
    const auto& range = assembled_.assembly.parts[p];
    const int seen = evidence_.last.distortion.place;
    where.place =
        seen >= range.first_element && seen < range.first_element + range.element_count ? seen : range.first_element;
    judge(FaultKind::hourglass_share, (viscous ? parts_[p].dissipated_lately : parts_[p].stored) / deformation,
          {assembled_.scene.monitor.hourglass_share}, sample, where, true);
  }
}

void Monitor::judge(FaultKind kind, double value, Limits limits, const HistorySample& sample, Extreme where,
                    bool at_element) {
  const bool lower_is_worse = kind == FaultKind::inversion;
  const auto passes = [&](double limit) { return lower_is_worse ? !(value > limit) : !(value <= limit); };
  Worst& worst = worst_[static_cast<int>(kind)];
  if (!worst.seen || passes(worst.value)) worst = {value, limits.warning, sample.time, true};
  if (!passes(limits.warning)) return;
  const bool fatal = passes(limits.fatal);
  note(kind, fatal, value, fatal ? limits.fatal : limits.warning, sample, where, at_element);
}

void Monitor::note(FaultKind kind, bool fatal, double value, double limit, const HistorySample& sample, Extreme where,
                   bool at_element) {
  // What has become fatal is reported anew.
  const auto known = std::find_if(found_.begin(), found_.end(), [&](const Fault& one) { return one.kind == kind; });
  if (known != found_.end() && (known->fatal || !fatal)) return;
  if (others_ != nullptr) others_->gather_mesh();  // causes are looked for in all of it
  Fault fault = seen_at(sample, kind, fatal, value, limit);
  if (at_element)
    place_at_element(fault, where.place);
  else
    place_at_node(fault, where.place);
  fault.causes = likely_causes(assembled_, sizes_, loads_, contacts_, fault, evidence_);
  add(std::move(fault));
}

void Monitor::add(Fault fault) {
  new_.push_back(fault);
  const auto known = std::find_if(found_.begin(), found_.end(), [&](const Fault& one) {
    return one.kind == fault.kind && one.contact == fault.contact;
  });
  if (known != found_.end())
    *known = std::move(fault);
  else
    found_.push_back(std::move(fault));
}

void Monitor::place_at_element(Fault& fault, int element) const {
  if (element < 0) return;
  fault.element = element;
  fault.element_volume =
      hexahedron_volume(corners_of(assembled_.assembly.nodes, assembled_.assembly.elements[element]));
  for (int n : assembled_.assembly.elements[element])
    for (int i = 0; i < 3; ++i) fault.place[i] += 0.125 * assembled_.assembly.nodes[n][i];
  for (const auto& part : assembled_.assembly.parts) {
    const int within = element - part.first_element;
    if (within < 0 || within >= part.element_count) continue;
    fault.part = part.name;
    fault.element_in_part = within;
  }
}

void Monitor::place_at_node(Fault& fault, int node) const {
  if (node < 0) return;
  const auto& elements = assembled_.assembly.elements;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (std::find(elements[e].begin(), elements[e].end(), node) != elements[e].end()) {
      place_at_element(fault, static_cast<int>(e));
      break;
    }
  fault.node = node;
  fault.place = assembled_.assembly.nodes[node];
}

const Fault* Monitor::fatal() const {
  // The first that stops the run; what is not finite says the least, so it comes last.
  const Fault* first = nullptr;
  for (const Fault& fault : found_)
    if (fault.fatal && (first == nullptr || first->kind == FaultKind::not_finite)) first = &fault;
  return first;
}

std::vector<std::string> Monitor::summary() const {
  std::vector<std::string> lines;
  for (const Fault& fault : found_) {
    std::string line = "monitor: " + fault.summary();
    const Worst& worst = worst_[static_cast<int>(fault.kind)];
    if (worst.seen && worst.value != fault.value)
      line += fmt::format(" (worst {:.4g}, at t = {:.6g} s)", worst.value, worst.time);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string Monitor::account_summary() const {
  if (!arrays_) return "energy account not judged: monitor.active = false";
  // A run that something else has ended may not have waited for the error to last.
  const double most = std::max(worst_[static_cast<int>(FaultKind::energy)].value, share_),
               limit = assembled_.scene.monitor.fatal_energy_error;
  return fmt::format("energy account {}: error at most {:.2g} of what deformation held and dissipated, limit {:g}",
                     most > limit ? "broken" : "kept", most, limit);
}

std::vector<std::string> Monitor::never_closed() const {
  return ends_ ? ends_->never_closed() : std::vector<std::string>();
}

std::string Monitor::worst_summary() const {
  std::string line;
  for (int kind = 0; kind < fault_kinds; ++kind)
    if (const Worst& worst = worst_[kind]; worst.seen)
      line += fmt::format("{}{} {:.3g} ({:.3g})", line.empty() ? "" : ", ", key_of(static_cast<FaultKind>(kind)),
                          worst.value, worst.limit);
  return line;
}

}  // namespace railwave
