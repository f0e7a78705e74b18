#include "solve/contact_multiplier.hpp"

#include <fmt/format.h>

#include "kernels/contact_multiplier.hpp"
#include "solve/contact_window.hpp"
#include "solve/element_forces.hpp"

namespace railwave {
namespace {

FreeMotion free_motion(const Model& model, const Instant& instant) {
  if (instant.relaxation != nullptr) {
    const RelaxationUpdate& update = *instant.relaxation;
    return {update.acceleration, instant.step, instant.step, update.relaxation_mass, update.body_acceleration};
  }
  const NodeAdvance advance = node_advance(model, instant.step);
  return {model.acceleration(), advance.velocity_step, advance.step, {}, {}};
}

template <class Phase, class Multiplier>
void run_phase(const char* name, const Multiplier& multiplier) {
  // How many nodes can touch is known on the device only.
  using Policy = Kokkos::RangePolicy<ExecutionSpace, Phase, Kokkos::LaunchBounds<64>, AsArgument>;
  Kokkos::parallel_for(name, Policy(0, multiplier.window.count), multiplier);
}

template <bool Friction>
void find_multipliers(Model& model, ContactPair& pair, const Instant& instant) {
  using Multiplier = ContactMultiplier<Friction>;
  const Multiplier multiplier{ContactSearch{{pair.arrays, model.nodes.position}}, pair.window, model.extra.sum,
                              free_motion(model, instant), pair.multipliers};
  run_phase<typename Multiplier::Begin>("multipliers_begin", multiplier);
  for (int sweep = 0; sweep < pair.contact->sweeps; ++sweep) {
    run_phase<typename Multiplier::Push>("multipliers_push", multiplier);
    run_phase<typename Multiplier::Correct>("multipliers_correct", multiplier);
  }
  run_phase<typename Multiplier::Finish>("multipliers_finish", multiplier);
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
