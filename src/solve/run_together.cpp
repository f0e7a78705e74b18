#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "kernels/support/meanwhile.hpp"
#include "solve/launch_graph.hpp"
#include "solve/loop.hpp"

namespace railwave {
namespace {

/// A member's tasks come one after the other: nothing is launched in parts so that others might go on beside. What
/// leaves members more room is a launch of its own.
void launch_whole(Model& model) {
  model.parts = {};
  model.early_shared = 0;
  model.plain_apart = model.plain_apart || on_device;
}

/// Steps, graphs or halves of steps that a member takes before the next one's turn.
constexpr int most_in_turn = 8;

/// Steps that a member takes before the next one begins, at most. All search for a step at the same one of theirs, one
/// after the other: so others have enough to do meanwhile. No multiple of the steps between checks for near nodes.
constexpr long most_steps_apart = 160;

/// So much of a run at most the last member begins after the first: what one has to do alone takes longer.
constexpr double most_of_run_apart = 0.125;

long steps_apart(const std::vector<EnsembleMember>& members) {
  long shortest = std::numeric_limits<long>::max();
  for (const EnsembleMember& member : members) shortest = std::min(shortest, member.model->step_count);
  const double of_run = most_of_run_apart * static_cast<double>(shortest) / static_cast<double>(members.size());
  return std::min(most_steps_apart, static_cast<long>(of_run));
}

/// s, after which the results of who has ended are surely written: before, all others would wait for that.
constexpr double until_written = 1;

/// The members' loops, of which each takes its turn.
class Turns {
 public:
  explicit Turns(const std::vector<EnsembleMember>& members)
      : members_(members),
        spaces_(separate_spaces(members.size())),
        outcomes_(members.size()),
        loops_(members.size()),
        apart_(steps_apart(members)) {
    for (std::size_t m = 0; m < members.size(); ++m) {
      const EnsembleMember& member = members[m];
      unless_it_fails(m, [&] {
        launch_whole(*member.model);
        loops_[m] =
            std::make_unique<TimeLoop>(*member.model, member.observers, member.settled, member.keeping, &spaces_[m]);
      });
      first_step_.push_back(member.model->step);
    }
  }

  /// A round of turns. @return false: all have ended
  bool go_round() {
    bool any = false;
    for (std::size_t m = 0; m < loops_.size(); ++m) {
      if (!loops_[m]) continue;
      whose_turn_ = m;
      if (loops_[m]->has_ended()) {
        if (loops_[m]->seconds_since_end() > until_written) end(m);
        continue;
      }
      any = true;
      if (!waits_to_begin(m)) take_turn(m, most_in_turn);
    }
    return any;
  }

  /// While one waits for the device, in a search for its step or an output: a step of another. A search waits for its
  /// turn.
  void go_on_meanwhile() {
    for (std::size_t tried = 0; tried < loops_.size(); ++tried) {
      of_others_ = (of_others_ + 1) % loops_.size();
      if (of_others_ == whose_turn_ || !under_way(of_others_) || waits_to_begin(of_others_)) continue;
      const TimeLoop& loop = *loops_[of_others_];
      if (!loop.busy() && !loop.may_search()) return take_turn(of_others_, 1);
    }
  }

  std::vector<RunOutcome> outcomes() {
    for (std::size_t m = 0; m < loops_.size(); ++m) {
      whose_turn_ = m;
      if (loops_[m]) end(m);
    }
    return std::move(outcomes_);
  }

 private:
  template <class Step>
  void unless_it_fails(std::size_t m, const Step& step) {
    try {
      step();
    } catch (const std::exception& error) {
      outcomes_[m].error = error.what();
      loops_[m].reset();
    }
  }

  void take_turn(std::size_t m, int most) {
    unless_it_fails(m, [&] {
      for (int k = 0; k < most && !loops_[m]->busy() && loops_[m]->go_on(); ++k) {
      }
    });
  }

  void end(std::size_t m) {
    unless_it_fails(m, [&] {
      outcomes_[m].summary = loops_[m]->summary();
      loops_[m].reset();
    });
  }

  long steps_taken(std::size_t m) const { return members_[m].model->step - first_step_[m]; }

  bool under_way(std::size_t m) const { return loops_[m] && !loops_[m]->has_ended(); }

  bool waits_to_begin(std::size_t m) const {
    return m > 0 && steps_taken(m) == 0 && under_way(m - 1) && steps_taken(m - 1) < apart_;
  }

  const std::vector<EnsembleMember>& members_;
  const std::vector<ExecutionSpace> spaces_;
  std::vector<RunOutcome> outcomes_;
  std::vector<std::unique_ptr<TimeLoop>> loops_;  ///< null: failed, or ended and written
  const long apart_;                              ///< steps
  std::vector<long> first_step_;
  std::size_t whose_turn_ = 0, of_others_ = 0;
};

}  // namespace

std::vector<RunOutcome> run_together(const std::vector<EnsembleMember>& members) {
  Turns turns(members);
  const Meanwhile others_go_on([&turns] { turns.go_on_meanwhile(); });
  while (turns.go_round()) {
  }
  return turns.outcomes();
}

}  // namespace railwave
