#pragma once

#include <string>
#include <utility>
#include <vector>

#include "benchmarks/common/timing.hpp"
#include "solve/stages.hpp"

namespace railwave::bench {

/// The time loop of a model without anything between the steps: no output, no account, no check.
class Loop {
 public:
  explicit Loop(Model& model) : model_(model), stages_(force_stages(model)) { instant_.step = model.step_size; }

  void steps(long count) {
    for (long k = 0; k < count; ++k) step();
  }

  void step() {
    begin(true);
    for (const Stage& stage : stages_) stage.run(instant_);
    finish();
  }

  /// A step at whose instant somebody looks, when the forces are known.
  template <class Look>
  void watched_step(const Look& look) {
    forces();
    look();
    finish();
  }

  /// Forces at the present instant, for fields that need them.
  void forces() {
    begin(false);
    for (const Stage& stage : stages_) stage.run(instant_);
  }

  /// Seconds a step of each stage by name, the nodes' update last, over `count` steps with a fence after every stage.
  /// Their sum is more than a step of the loop, which has no fences.
  std::vector<std::pair<std::string, double>> stage_seconds(long count) {
    std::vector<std::pair<std::string, double>> result;
    for (const Stage& stage : stages_) result.emplace_back(stage.name, 0.0);
    result.emplace_back("nodes", 0.0);
    for (long k = 0; k < count; ++k) {
      begin(true);
      for (std::size_t s = 0; s < stages_.size(); ++s)
        result[s].second += seconds_of([&] { stages_[s].run(instant_); });
      result.back().second += seconds_of([&] { finish(); });
    }
    for (auto& entry : result) entry.second /= static_cast<double>(count);
    return result;
  }

 private:
  void begin(bool advancing) {
    instant_.time = model_.time = static_cast<double>(model_.step) * model_.step_size;
    instant_.advancing = advancing;
  }

  void finish() {
    advance(model_, model_.step_size);
    instant_.elapsed = model_.step_size;
  }

  Model& model_;
  std::vector<Stage> stages_;
  Instant instant_;
};

}  // namespace railwave::bench
