#include "solve/loop.hpp"

#include <atomic>

#include "solve/statics/settle.hpp"

namespace railwave {
namespace {

/// Set by signal handlers and by the thread that writes.
std::atomic<int> stop_requested{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

void request_stop() { stop_requested = 1; }

bool stop_is_requested() { return stop_requested != 0; }

bool prepare(Model& model, const std::vector<RunObserver*>& observers, SettledStates* settled, Transport* others,
             const std::function<bool()>& go_on) {
  refuse_moving_held_nodes(model, model.nodes.reference);
  bool in_equilibrium = false;
  if (model.scene.settle.active) {
    const auto report_and_go_on = [&](const SettleReport& so_far) {
      for (RunObserver* observer : observers) observer->settling(model, so_far);
      return go_on();
    };
    const SettleReport report = come_to_rest(model, settled, report_and_go_on, others);
    for (RunObserver* observer : observers) observer->settled(model, report);
    in_equilibrium = report.settled;
  }
  set_initial_motion(model, model.nodes, model.beams);
  return in_equilibrium;
}

std::string while_settling(const scene::Scene& scene, bool out_of_time) {
  const bool kept = scene.settle.cache && scene.settle.keep_unsettled && !scene.static_text.empty();
  return std::string(out_of_time ? "the wall time was spent" : "interrupted") + " while the scene settled" +
         (kept ? "; how far it came is kept, and the next run without --restart settles on from there" : "");
}

}  // namespace railwave
