#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "kernels/contact/contact_multiplier.hpp"
#include "model/contact/contact_law.hpp"
#include "solve/tasks/contributions.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {
namespace {

FreeMotion free_motion(const NodalState& nodal, const Instant& instant, const RelaxationUpdate* relaxation) {
  if (relaxation != nullptr)
    return {relaxation->acceleration, instant.step, instant.step, relaxation->relaxation_mass,
            relaxation->body_acceleration};
  const NodeAdvance advance = node_advance(nodal, instant.step);
  return {nodal.acceleration(), advance.velocity_step, advance.step, {}, {}};
}

/// Share of a residual that a step takes back. At 0.01 no mode of two blocks gains more than 7e-8 of its amplitude in a
/// step, at 0.02 6e-7, at 1 up to 2e-3 (docs/contact.md); a hundred steps are a wave's way over sixty elements.
constexpr double taken_back_running = 0.01;
/// Settling damps what a residual makes, and is sooner at rest.
constexpr double taken_back_settling = 1;

using AnyMultiplier = std::variant<ContactMultiplier<false>, ContactMultiplier<true>,
                                   ContactMultiplier<false, SmoothNormals>, ContactMultiplier<true, SmoothNormals>>;

static_assert(GrowingPenalty::friction_state == 0, "multipliers take the first values of the law's state");

template <class Normals>
AnyMultiplier multiplier_with(const NodalState& nodal, const ContactPair& pair, const FreeMotion& motion,
                              double elapsed, bool friction) {
  const bool settling = motion.relaxation_mass.extent(0) != 0;
  const ContactSearch search{{pair.arrays, nodal.nodes.position}};
  const auto with = [&](auto has_friction) -> AnyMultiplier {
    return ContactMultiplier<decltype(has_friction)::value, Normals>{
        search,
        pair.window,
        nodal.external.sum,
        motion,
        pair.multipliers,
        first_touch(nodal, elapsed),
        settling ? taken_back_settling : taken_back_running,
        falling_friction(*pair.contact),
        pair.contact->falling_friction() ? pair.law.state : Array<double*>()};
  };
  return friction ? with(std::true_type()) : with(std::false_type());
}

AnyMultiplier multiplier_of(const NodalState& nodal, const ContactPair& pair, const FreeMotion& motion, double elapsed,
                            bool friction) {
  if (pair.contact->normals == scene::ContactNormals::smooth)
    return multiplier_with<SmoothNormals>(nodal, pair, motion, elapsed, friction);
  return multiplier_with<FacetNormals>(nodal, pair, motion, elapsed, friction);
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

std::vector<Task> multiplier_tasks(const scene::Scene& scene, const NodalState& nodal,
                                   std::vector<ContactPair>& contacts, StepKind kind,
                                   const RelaxationUpdate* relaxation) {
  std::string names;
  int sweeps = 0;
  for (const ContactPair& pair : contacts) {
    if (pair.has_springs()) continue;
    names += fmt::format("{} contact {}{}", sweeps == 0 ? "" : ",", describe_contact(*pair.contact),
                         describe_contact_law(*pair.contact));
    sweeps = std::max(sweeps, pair.contact->sweeps);
  }
  if (sweeps == 0) return {};
  return {
      {"search of" + names, "d",
       [&scene, &nodal, &contacts, kind](const Instant& instant) {
         for (ContactPair& pair : contacts)
           if (!pair.has_springs()) keep_window(scene, nodal, pair, instant.step, kind);
       }},
      {"multipliers of" + names, "d", [&scene, &nodal, &contacts, kind, relaxation, sweeps](const Instant& instant) {
         const FreeMotion motion = free_motion(nodal, instant, relaxation);
         std::vector<AnyMultiplier> pairs;
         for (const ContactPair& pair : contacts)
           if (!pair.has_springs())
             pairs.push_back(multiplier_of(nodal, pair, motion, instant.elapsed, has_friction(scene, pair, kind)));
         find_multipliers(pairs, sweeps);
       }}};
}

}  // namespace railwave
