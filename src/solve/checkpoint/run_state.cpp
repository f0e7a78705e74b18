#include "solve/checkpoint/run_state.hpp"

#include "model/elements/edge_groups.hpp"
#include "model/time_step/automatic_step.hpp"
#include "solve/checkpoint/state_arrays.hpp"

namespace railwave {

void refuse_state(const std::string& name, const std::string& what) {
  throw std::runtime_error(fmt::format("it does not fit this model: {} {}", name, what));
}

std::string back_end_name() {
  return fmt::format("{} of {} numbers in a pack", ExecutionSpace::name(), lane_count<double>);
}

namespace {

/// Host values that arrays alone don't tell.
template <class Archive>
void archive(Archive& archive, const std::string& of, ContactPair& pair) {
  archive.value(of + "window_count", pair.window.count);
  archive.value(of + "next_look", pair.next_check);
  archive.value(of + "next_near_look", pair.next_near_check);
  archive.value(of + "near_checked_at", pair.near_checked_at);
  archive.value(of + "answer_due", pair.answer_due);
  archive.value(of + "layouts", pair.layouts);
  archive.value(of + "looks", pair.checks);
  SurfaceMotion& motion = pair.asked_motion.last;
  archive.newer_value(of + "motion_step", motion.step);
  archive.newer_value(of + "motion_moved", motion.moved);
  archive.newer_value(of + "motion_speed", motion.speed);
}

template <class Archive>
void archive(Archive& archive, RelativeNodes& relative) {
  archive.values("carrier_host_motion", relative.host_motion);
  archive.value("carried_begun", relative.begun);
  archive.value("carrier_block_step", relative.block_step);
  archive.value("carrier_block_time", relative.block_time);
  archive.value("carrier_block_size", relative.block_size);
}

template <class Archive>
void archive(Archive& archive_, StableStep& stable) {
  archive_.value("stable_global", stable.global);
  archive_.value("stable_limit", stable.limit);
  archive_.value("stable_deformed", stable.deformed);
  archive_.value("stable_springs", stable.springs);
  archive_.value("step_choice", stable.choice.reason);
  archive_.value("step_choice_gain", stable.choice.gain);
  archive_.value("step_choice_evaluations", stable.choice.evaluations);
  for (std::size_t p = 0; p < stable.seen.size(); ++p)
    archive_.values(fmt::format("stable_seen_{}", p), stable.seen[p]);
}

/// The forces of an instant are computed anew from what is here, except where work is counted by the trapezoidal rule:
/// that needs the forces of the instant before.
template <class Archive>
void archive(Archive& archive_, Model& model) {
  // All that follows is in the order of elements and nodes.
  bool in_rows = wants_rows(model.in_single);
  archive_.value("elements_in_rows", in_rows);
  if (in_rows != wants_rows(model.in_single))
    refuse_state("its order of elements",
                 in_rows ? "is that of a processor, not of a GPU" : "is that of a GPU, not of a processor");
  archive_.value("step", model.step);
  archive_.value("step_count", model.step_count);
  archive_.value("step_size", model.step_size);
  archive_.value("time", model.time);
  archive_.value("velocity_lag", model.velocity_lag);
  archive(archive_, model.stable_step);
  if (model.relative.active()) archive(archive_, model.relative);
  for (std::size_t p = 0; p < model.contacts.size(); ++p)
    archive(archive_, fmt::format("contact_{}_", p), model.contacts[p]);
  StateArrays<Archive> arrays(archive_, model.in_single, false);
  visit_model_arrays(arrays, model);
}

}  // namespace

void save_model_state(Model& model, RunState& state) {
  for (ContactPair& pair : model.contacts) take_motion(pair);
  StateSaver saver(state);
  archive(saver, model);
  state.step = model.step;
  state.time = model.time;
  state.back_end = back_end_name();
}

void restore_model_state(Model& model, const RunState& state) {
  StateRestorer restorer(state);
  for (ContactPair& pair : model.contacts) pair.asked_motion.forget();
  archive(restorer, model);
  for (ContactPair& pair : model.contacts) pair.uncounted_of = -1;
  keep_choice(model);
  if (model.relative.begun) place_frames(model.elements, model);
}

}  // namespace railwave
