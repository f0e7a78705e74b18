#include <algorithm>
#include <exception>
#include <limits>
#include <memory>

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
  model.plain_apart = on_device;
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

}  // namespace

std::vector<RunOutcome> run_together(const std::vector<EnsembleMember>& members) {
  std::vector<RunOutcome> outcomes(members.size());
  const std::vector<ExecutionSpace> spaces = separate_spaces(members.size());
  std::vector<std::unique_ptr<TimeLoop>> loops(members.size());
  const auto unless_it_fails = [&](std::size_t m, const auto& step) {
    try {
      step();
    } catch (const std::exception& error) {
      outcomes[m].error = error.what();
      loops[m].reset();
    }
  };
  for (std::size_t m = 0; m < members.size(); ++m)
    unless_it_fails(m, [&] {
      launch_whole(*members[m].model);
      loops[m] = std::make_unique<TimeLoop>(*members[m].model, members[m].observers, members[m].settled,
                                            members[m].keeping, &spaces[m]);
    });
  const auto end = [&](std::size_t m) {
    unless_it_fails(m, [&] {
      outcomes[m].summary = loops[m]->summary();
      loops[m].reset();
    });
  };
  const auto take_turn = [&](std::size_t m, int most) {
    unless_it_fails(m, [&] {
      for (int k = 0; k < most && !loops[m]->busy() && loops[m]->go_on(); ++k) {
      }
    });
  };
  std::vector<long> first_step;
  for (const EnsembleMember& member : members) first_step.push_back(member.model->step);
  const auto steps_taken = [&](std::size_t m) { return members[m].model->step - first_step[m]; };
  const long apart = steps_apart(members);
  const auto waits_to_begin = [&](std::size_t m) {
    return m > 0 && steps_taken(m) == 0 && loops[m - 1] && !loops[m - 1]->has_ended() && steps_taken(m - 1) < apart;
  };
  // While one waits for the device, in a search for its step or an output, others go on. A search waits for its turn.
  std::size_t whose_turn = 0, of_others = 0;
  const Meanwhile others_go_on([&] {
    for (std::size_t tried = 0; tried < members.size(); ++tried) {
      of_others = (of_others + 1) % members.size();
      const auto& loop = loops[of_others];
      if (of_others == whose_turn || !loop || loop->has_ended() || loop->busy() || loop->may_search() ||
          waits_to_begin(of_others))
        continue;
      return take_turn(of_others, 1);
    }
  });
  for (bool any = true; any;) {
    any = false;
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (!loops[m]) continue;
      whose_turn = m;
      if (loops[m]->has_ended()) {
        if (loops[m]->seconds_since_end() > until_written) end(m);
        continue;
      }
      any = true;
      if (!waits_to_begin(m)) take_turn(m, most_in_turn);
    }
  }
  for (std::size_t m = 0; m < members.size(); ++m) {
    whose_turn = m;
    if (loops[m]) end(m);
  }
  return outcomes;
}

}  // namespace railwave
