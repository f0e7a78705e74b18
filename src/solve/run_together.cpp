#include <exception>
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
  // While one waits for the device, in a search for its step or an output, others go on. A search waits for its turn.
  std::size_t whose_turn = 0, of_others = 0;
  const Meanwhile others_go_on([&] {
    for (std::size_t tried = 0; tried < members.size(); ++tried) {
      of_others = (of_others + 1) % members.size();
      const auto& loop = loops[of_others];
      if (of_others == whose_turn || !loop || loop->has_ended() || loop->busy() || loop->may_search()) continue;
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
      take_turn(m, most_in_turn);
    }
  }
  for (std::size_t m = 0; m < members.size(); ++m) {
    whose_turn = m;
    if (loops[m]) end(m);
  }
  return outcomes;
}

}  // namespace railwave
