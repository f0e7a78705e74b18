#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "kernels/contact/contact_multiplier.hpp"
#include "model/contact/contact_law.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/contact_window.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {
namespace {

FreeMotion free_motion(const Model& model, const Instant& instant, const RelaxationUpdate* relaxation) {
  if (relaxation != nullptr)
    return {relaxation->acceleration, instant.step, instant.step, relaxation->relaxation_mass,
            relaxation->body_acceleration};
  const NodeAdvance advance = node_advance(model, instant.step);
  return {model.acceleration(), advance.velocity_step, advance.step, {}, {}};
}

using AnyMultiplier = std::variant<ContactMultiplier<false>, ContactMultiplier<true>,
                                   ContactMultiplier<false, SmoothNormals>, ContactMultiplier<true, SmoothNormals>>;

template <class Normals>
AnyMultiplier multiplier_with(const Model& model, const ContactPair& pair, const FreeMotion& motion, double elapsed,
                              bool friction) {
  const ContactSearch search{{pair.arrays, model.nodes.position}};
  if (friction)
    return ContactMultiplier<true, Normals>{search, pair.window,      model.extra.sum,
                                            motion, pair.multipliers, first_touch(model, elapsed)};
  return ContactMultiplier<false, Normals>{search, pair.window,      model.extra.sum,
                                           motion, pair.multipliers, first_touch(model, elapsed)};
}

AnyMultiplier multiplier_of(const Model& model, const ContactPair& pair, const FreeMotion& motion, double elapsed,
                            bool friction) {
  if (pair.contact->normals == scene::ContactNormals::smooth)
    return multiplier_with<SmoothNormals>(model, pair, motion, elapsed, friction);
  return multiplier_with<FacetNormals>(model, pair, motion, elapsed, friction);
}

template <class Phase>
void run_phase(const char* name, const AnyMultiplier& any, bool by_node = false) {
  std::visit(
      [&](const auto& multiplier) {
        // How many nodes can touch is known on the device only.
        using Policy = Kokkos::RangePolicy<ExecutionSpace, Phase, Kokkos::LaunchBounds<64>, AsArgument>;
        Kokkos::parallel_for(
            name, Policy(0, (by_node ? multiplier.multipliers.most_nodes : 1) * multiplier.window.count), multiplier);
      },
      any);
}

void find_multipliers(const std::vector<AnyMultiplier>& pairs, int sweeps) {
  for (const auto& pair : pairs) run_phase<Multiplier::Begin>("multipliers_begin", pair);
  for (const auto& pair : pairs) run_phase<Multiplier::Predict>("multipliers_predict", pair, true);
  for (const auto& pair : pairs) run_phase<Multiplier::Scatter>("multipliers_scatter", pair);
  for (int sweep = 1; sweep <= sweeps; ++sweep)
    for (const auto& pair : pairs) {
      run_phase<Multiplier::Correct>("multipliers_correct", pair);
      if (sweep < sweeps)
        run_phase<Multiplier::Scatter>("multipliers_scatter", pair);
      else
        run_phase<Multiplier::Finish>("multipliers_finish", pair);
    }
}

}  // namespace

std::vector<Task> multiplier_tasks(Model& model, StepKind kind, const RelaxationUpdate* relaxation) {
  std::string names;
  int sweeps = 0;
  for (const ContactPair& pair : model.contacts) {
    if (pair.has_springs()) continue;
    names += fmt::format("{} contact {}{}", sweeps == 0 ? "" : ",", describe_contact(*pair.contact),
                         describe_contact_law(*pair.contact));
    sweeps = std::max(sweeps, pair.contact->sweeps);
  }
  if (sweeps == 0) return {};
  return {{"search of" + names, "d",
           [&model, kind](const Instant& instant) {
             for (ContactPair& pair : model.contacts)
               if (!pair.has_springs()) keep_window(model, pair, instant.step, kind);
           }},
          {"multipliers of" + names, "d", [&model, kind, relaxation, sweeps](const Instant& instant) {
             const FreeMotion motion = free_motion(model, instant, relaxation);
             std::vector<AnyMultiplier> pairs;
             for (const ContactPair& pair : model.contacts)
               if (!pair.has_springs())
                 pairs.push_back(multiplier_of(model, pair, motion, instant.elapsed, has_friction(model, pair, kind)));
             find_multipliers(pairs, sweeps);
           }}};
}

}  // namespace railwave
