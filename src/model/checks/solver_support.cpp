#include <fmt/format.h>

#include "case/error.hpp"
#include "model/build_steps.hpp"

namespace railwave {
namespace {

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& wish, const std::string& mend) {
  throw InputError(
      fmt::format("{}: [solver] {}: this version of railwave has no time loop for it; {}", scene.path, wish, mend));
}

}  // namespace

void refuse_unknown_methods(const scene::Scene& scene) {
  const scene::Solver& solver = scene.solver;
  if (solver.precision == scene::Precision::single_precision && solver.subcycling)
    refuse(scene, "precision = \"float\" with subcycling = true",
           "leave one of the two out, or set precision to \"mixed\"");
  for (const scene::Contact& contact : scene.contacts)
    if (solver.subcycling && contact.algorithm == scene::ContactAlgorithm::multiplier)
      refuse(scene, fmt::format("subcycling = true with [contacts.{}] algorithm = \"multiplier\"", contact.name),
             "leave one of the two out: multipliers look one step ahead, and subcycled nodes have steps of their "
             "own");
  if (!scene.beams.empty() && solver.subcycling)
    refuse(scene, "subcycling = true with [beams]", "leave subcycling out");
  if (!scene.prescribed_motions.empty() && solver.precision == scene::Precision::single_precision)
    refuse(scene, "precision = \"float\" with a [prescribed_motion]", "set precision to \"mixed\" or \"double\"");
  if (!scene.prescribed_motions.empty() && solver.subcycling)
    refuse(scene, "subcycling = true with a [prescribed_motion]", "leave subcycling out");
  if (!scene.ties.empty() && solver.subcycling)
    refuse(scene, fmt::format("subcycling = true with [ties.{}]", scene.ties.front().name), "leave subcycling out");
  if (solver.subcycling && solver.step_estimate == scene::StepEstimate::global)
    refuse(scene, "subcycling = true with step_estimate = \"global\"",
           "leave one of the two out: a level's steps rest on its own elements");
}

}  // namespace railwave
