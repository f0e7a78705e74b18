#include "solve/contact_multiplier.hpp"

#include <fmt/format.h>

#include "kernels/contact_multiplier.hpp"
#include "solve/contact_window.hpp"
#include "solve/element_forces.hpp"

namespace railwave {
namespace {

constexpr int team_size = 512;

FreeMotion free_motion(const Model& model, const Instant& instant) {
  if (instant.relaxation != nullptr) {
    const RelaxationUpdate& update = *instant.relaxation;
    return {update.acceleration, instant.step, instant.step, update.relaxation_mass, update.body_acceleration};
  }
  const NodeAdvance advance = node_advance(model, instant.step);
  return {model.acceleration(), advance.velocity_step, advance.step, {}, {}};
}

template <class Phase, class Multiplier>
void run_phase(const char* name, const Multiplier& multiplier, int count) {
  Kokkos::parallel_for(name, Kokkos::RangePolicy<ExecutionSpace, Phase>(0, count), multiplier);
}

template <bool Friction>
void find_multipliers(Model& model, ContactPair& pair, const Instant& instant) {
  using Multiplier = ContactMultiplier<Friction>;
  const int sweeps = pair.contact->sweeps;
  const Multiplier multiplier{ContactSearch{{pair.arrays, model.nodes.position}}, pair.window, model.extra.sum,
                              free_motion(model, instant), pair.multipliers, sweeps};
  if constexpr (on_device) {
    using OneTeam = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<team_size>, AsArgument>;
    Kokkos::parallel_for("contact_multipliers", OneTeam(1, team_size), multiplier);
  } else {
    const int count = pair.window.near_count(0);
    run_phase<typename Multiplier::Begin>("multipliers_begin", multiplier, count);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      run_phase<typename Multiplier::Push>("multipliers_push", multiplier, count);
      run_phase<typename Multiplier::Correct>("multipliers_correct", multiplier, count);
    }
    run_phase<typename Multiplier::Push>("multipliers_push", multiplier, count);
    run_phase<typename Multiplier::Finish>("multipliers_finish", multiplier, count);
  }
}

}  // namespace

Stage multiplier_stage(Model& model, ContactPair& pair) {
  const bool friction = pair.arrays.friction > 0;
  return {fmt::format("contact {}, multipliers, {}", pair.contact->name, friction ? "friction" : "frictionless"),
          [&model, &pair, friction](const Instant& instant) {
            keep_window(model, pair, instant);
            if (friction) find_multipliers<true>(model, pair, instant);
            else find_multipliers<false>(model, pair, instant);
          }};
}

}  // namespace railwave
