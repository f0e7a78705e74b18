#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "tests/verify/two_blocks.hpp"

/// Scenes that are hard on the program, run as a user's case would be: with the monitor, at the default settings.
namespace railwave::verify {

/// What a run came to.
struct Ordeal : RunObserver {
  std::vector<Fault> warnings;
  RunSummary summary;
  double given = 0;          ///< J: the energy at the beginning and the most that loads have worked
  double worst_balance = 0;  ///< largest error of the energy balance, over the energy given at the end
  std::vector<Vec3> force;   ///< of contact 0 on the slave at each sample, N
  std::vector<Vec3>
      rest;         ///< of all else on it: its momentum's change (the scene's first history set) less its load, N
  double mass = 0;  ///< kg, of that set, when it is wanted

  void history(const Model&, const HistorySample& sample) override {
    const EnergyAccount& e = sample.energy;
    if (sample.step == 0) start_ = e.kinetic + e.internal + e.contact;
    given = std::max({given, start_, start_ + std::fabs(e.external_work), e.internal, e.contact});
    worst_ = std::isfinite(e.balance_error) ? std::max(worst_, std::fabs(e.balance_error)) : 1e300;
    if (!sample.contacts.empty())
      force.push_back(sample.contacts[0].normal_force + sample.contacts[0].tangential_force);
    if (mass > 0)
      rest.push_back(mass * sample.sets.at(0).acceleration - (sample.loads.empty() ? Vec3{} : sample.loads[0].force));
  }
  void warning(const Model&, const Fault& fault) override { warnings.push_back(fault); }
  void end(const Model&, const RunSummary& ended) override {
    summary = ended;
    worst_balance = worst_ / given;
  }
  /// How far the contact force is from what moves the body and carries its load: mean of the difference over the run,
  /// N.
  double unbalanced() const {
    Vec3 sum{};
    for (std::size_t k = 0; k < force.size(); ++k)
      sum = sum + (1.0 / static_cast<double>(force.size())) * (force[k] - rest[k]);
    return norm(sum);
  }
  std::string said() const {
    std::string reported;
    for (const Fault& fault : warnings) reported += "\n    " + fault.summary();
    if (!summary.completed) reported += "\n    ended: " + summary.reason;
    return reported;
  }

 private:
  double start_ = 0, worst_ = 0;
};

/// Runs a built model for a number of steps of its own choice.
/// @param mass kg, of the body whose momentum is to be balanced; 0: none
inline Ordeal endure(Model& model, long steps, double mass = 0) {
  model.step_count = steps;
  model.scene.time.end = static_cast<double>(steps) * model.step_size;  // where contact makes the step another one
  model.output_times.history = static_cast<double>(std::max(1L, steps / 400)) * model.step_size;
  model.output_times.fields = 1e9 * model.step_size;
  Ordeal ordeal;
  ordeal.mass = mass;
  run(model, {&ordeal});
  return ordeal;
}

}  // namespace railwave::verify
