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
AnyMultiplier multiplier_with(const NodalState& nodal, const ContactPair& pair, double elapsed, bool settling,
                              bool friction) {
  const ContactSearch search{{pair.arrays, nodal.nodes.position}};
  const auto with = [&](auto has_friction) -> AnyMultiplier {
    return ContactMultiplier<decltype(has_friction)::value, Normals>{
        search,
        pair.window,
        nodal.external.sum,
        nodal.nodes.external_row,
        nodal.constraints,
        nodal.free_nodes,
        pair.multipliers,
        first_touch(nodal, elapsed),
        settling ? taken_back_settling : taken_back_running,
        falling_friction(*pair.contact),
        pair.contact->falling_friction() ? pair.law.state : Array<double*>()};
  };
  return friction ? with(std::true_type()) : with(std::false_type());
}

AnyMultiplier multiplier_of(const NodalState& nodal, const ContactPair& pair, double elapsed, bool settling,
                            bool friction) {
  if (pair.contact->normals == scene::ContactNormals::smooth)
    return multiplier_with<SmoothNormals>(nodal, pair, elapsed, settling, friction);
  return multiplier_with<FacetNormals>(nodal, pair, elapsed, settling, friction);
}

template <class Phase, class Pairs>
void launch(const ExecutionSpace& space, const char* name, const Pairs& pairs) {
  int slaves = 0;
  for (const auto& pair : pairs.pairs) slaves += pair.window.launched();
  using Policy = Kokkos::RangePolicy<ExecutionSpace, Phase, Kokkos::LaunchBounds<64>, AsArgument>;
  Kokkos::parallel_for(name, Policy(space, 0, slaves), pairs);
}

/// A phase of all pairs: two by two in one launch where they are of the same kind, as those of a joint are.
/// @param sweep of Correct and Finish, from 1
template <class Phase>
void run_phase(const ExecutionSpace& space, const char* name, const std::vector<AnyMultiplier>& pairs, int sweep = 0) {
  for (std::size_t k = 0; k < pairs.size(); ++k)
    std::visit(
        [&](const auto& first) {
          using Pair = std::decay_t<decltype(first)>;
          const Pair* second = k + 1 < pairs.size() ? std::get_if<Pair>(&pairs[k + 1]) : nullptr;
          if (second == nullptr) return launch<Phase>(space, name, MultiplierPairs<Pair, 1>{{first}, sweep});
          launch<Phase>(space, name, MultiplierPairs<Pair, 2>{{first, *second}, sweep});
          ++k;
        },
        pairs[k]);
}

/// Nodes that the multipliers of all pairs can push, at most; on a processor those that they push.
int most_listed(const NodalState& nodal, const std::vector<ContactPair>& contacts) {
  if constexpr (!on_device) return nodal.free_nodes.listed_count(0);
  long most = 0;
  for (const ContactPair& pair : contacts)
    if (!pair.has_springs()) most += static_cast<long>(pair.multipliers.most_nodes) * pair.window.bound();
  return static_cast<int>(std::min<long>(most, nodal.external.row_count));
}

/// The multipliers of all pairs that have them.
std::vector<AnyMultiplier> multipliers_of(const scene::Scene& scene, const NodalState& nodal,
                                          const std::vector<ContactPair>& contacts, StepKind kind, double elapsed) {
  std::vector<AnyMultiplier> pairs;
  for (const ContactPair& pair : contacts)
    if (!pair.has_springs())
      pairs.push_back(multiplier_of(nodal, pair, elapsed, kind == StepKind::settling, has_friction(scene, pair, kind)));
  return pairs;
}

/// All pairs' multipliers are of one iteration: they may push the same nodes.
void find_multipliers(const ExecutionSpace& space, const std::vector<AnyMultiplier>& pairs, int sweeps) {
  for (int sweep = 1; sweep < sweeps; ++sweep)
    run_phase<Multiplier::Correct>(space, "multipliers_correct", pairs, sweep);
  run_phase<Multiplier::Finish>(space, "multipliers_finish", pairs, sweeps);
}

}  // namespace

MultiplierTasks multiplier_tasks(const scene::Scene& scene, const NodalState& nodal, std::vector<ContactPair>& contacts,
                                 StepKind kind, const RelaxationUpdate* relaxation) {
  std::string names;
  int sweeps = 0;
  for (const ContactPair& pair : contacts) {
    if (pair.has_springs()) continue;
    names += fmt::format("{} contact {}{}", sweeps == 0 ? "" : ",", describe_contact(*pair.contact),
                         describe_contact_law(*pair.contact));
    sweeps = std::max(sweeps, pair.contact->sweeps);
  }
  if (sweeps == 0) return {};
  Task search{"search of" + names, "d", [&scene, &nodal, &contacts, kind](const Instant& instant) {
                for (ContactPair& pair : contacts)
                  if (!pair.has_springs()) keep_window(scene, nodal, pair, instant, kind);
              }};
  search.recordable = false;
  const Task begin{"location of" + names, "d", [&scene, &nodal, &contacts, kind](const Instant& instant) {
                     run_phase<Multiplier::Begin>(instant.space(), "multipliers_begin",
                                                  multipliers_of(scene, nodal, contacts, kind, instant.elapsed));
                   }};
  Task find{"multipliers of" + names, "d",
            [&scene, &nodal, &contacts, kind, relaxation, sweeps](const Instant& instant) {
              Kokkos::parallel_for("multipliers_predict", SpreadRange(instant.space(), 0, most_listed(nodal, contacts)),
                                   PredictFreeNodes{nodal.free_nodes, free_motion(nodal, instant, relaxation)});
              find_multipliers(instant.space(), multipliers_of(scene, nodal, contacts, kind, instant.elapsed), sweeps);
            }};
  const auto loaded = [](const ContactPair& pair) { return !pair.has_springs() && pair.loaded; };
  if (std::none_of(contacts.begin(), contacts.end(), loaded)) find.begins = Begins::beside_loads;
  return {{search, begin}, {std::move(find)}};
}

}  // namespace railwave
