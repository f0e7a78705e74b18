#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "tests/verify/two_blocks.hpp"

/// Scenes that are hard on the program, run as a user's case would be: with the watch, at the default settings.
namespace railwave::verify {

/// What a run came to.
struct Ordeal : RunObserver {
  std::vector<Fault> warnings;
  RunSummary summary;
  double given = 0;          ///< J: the energy at the beginning and the most that loads have worked
  double worst_balance = 0;  ///< largest error of the energy balance, over the energy given at the end
  std::vector<Vec3> force;   ///< of contact 0 on the slave at each sample, N

  void history(const Model&, const HistorySample& sample) override {
    const EnergyAccount& e = sample.energy;
    if (sample.step == 0) start_ = e.kinetic + e.internal + e.contact;
    given = std::max({given, start_, start_ + std::fabs(e.external_work), e.internal, e.contact});
    worst_ = std::isfinite(e.balance_error) ? std::max(worst_, std::fabs(e.balance_error)) : 1e300;
    if (!sample.contacts.empty()) force.push_back(sample.contacts[0].normal_force + sample.contacts[0].tangential_force);
  }
  void warning(const Model&, const Fault& fault) override { warnings.push_back(fault); }
  void end(const Model&, const RunSummary& ended) override {
    summary = ended;
    worst_balance = worst_ / given;
  }
  /// Mean contact force over the second half of the run.
  Vec3 late_force() const {
    Vec3 sum{};
    const std::size_t from = force.size() / 2;
    for (std::size_t k = from; k < force.size(); ++k) sum = sum + (1.0 / static_cast<double>(force.size() - from)) * force[k];
    return sum;
  }
  std::string said() const {
    std::string told;
    for (const Fault& fault : warnings) told += "\n    " + fault.told();
    if (!summary.completed) told += "\n    ended: " + summary.reason;
    return told;
  }

 private:
  double start_ = 0, worst_ = 0;
};

/// Runs a built model for a number of steps of its own choice.
inline Ordeal endure(Model& model, long steps) {
  model.step_count = steps;
  model.scene.output.history_interval = static_cast<double>(std::max(1L, steps / 400)) * model.step_size;
  model.scene.output.field_interval = 1e9 * model.step_size;
  Ordeal ordeal;
  run(model, {&ordeal});
  return ordeal;
}

}  // namespace railwave::verify
