#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/time_step/stable_step.hpp"
#include "solve/monitor/diagnosis.hpp"

namespace railwave {
namespace {

const char* const mend = "lower time.step_scale (or time.step)";

/// Certain to be unstable beyond what the estimates allow; possible beyond what a single free element allows.
double weight(double ratio, bool certain) { return (certain ? 60 : 40) + std::fmin(7, std::log2(ratio)); }

void elements(const AssembledScene& assembled, const StepSizes& sizes, std::vector<Cause>& causes) {
  const StableStep& stable = sizes.stable_step;
  const double step = sizes.step_size;
  const int element = stable.eigenvalue_element;
  const int p = element < 0 ? -1 : part_of_element(assembled.assembly, element);
  if (p < 0) return;
  const scene::Part& part = assembled.scene.parts[p];
  const ElementStep own = element_eigenvalue_step(
      corners_of(assembled.assembly.nodes, assembled.assembly.elements[element]),
      assembled.scene.materials[assembled.assembly.parts[p].material], part.hourglass, part.hourglass_coefficient);
  const ElementStep free =
      element_eigenvalue_step(corners_of(assembled.assembly.nodes, assembled.assembly.elements[element]),
                              assembled.scene.materials[assembled.assembly.parts[p].material], part.hourglass, 0);
  // Control counts where it, not the elastic modes, has shortened the element's step.
  const bool by_control = own.control < free.step;
  if (by_control && step > own.control)
    causes.push_back(Cause{"hourglass control too strong",
                           fmt::format("the step is {:.3g} times what the hourglass control of part {} allows: lower "
                                       "parts.{}.hourglass_coefficient ({:.3g}), or {}",
                                       step / own.control, part.name, part.name, part.hourglass_coefficient, mend),
                           weight(step / own.control, true)});
  const double ratio = step / stable.eigenvalue;
  if (!by_control && part.damped() && stable.eigenvalue < 0.9 * free.step && ratio > 1)
    causes.push_back(Cause{"damping of a part",
                           fmt::format("the step is {:.3g} times what the damping of part {} allows: lower "
                                       "parts.{}.stiffness_damping and its like, or {}",
                                       ratio, part.name, part.name, mend),
                           weight(ratio, true)});
  else if (!by_control && ratio > 1) {
    const bool certain = step > stable.elements;
    const int lowest = certain ? stable.element : element, q = part_of_element(assembled.assembly, lowest);
    const auto who = [&](double times) {
      return fmt::format("the step is {:.3g} times the stable step of element {} of part {}", times,
                         lowest - assembled.assembly.parts[q].first_element, assembled.scene.parts[q].name);
    };
    if (certain)
      causes.push_back(Cause{"step beyond elements", fmt::format("{}: {}", who(step / stable.elements), mend),
                             weight(step / stable.elements, true)});
    // What the assembled elements have vouched for is no cause.
    else if (step > stable.by_elements)
      causes.push_back(
          {possible_step_cause,
           who(ratio) + ", alone: solver.step_estimate = \"eigenvalue\" is safe for bodies one element thick",
           weight(ratio, false)});
  }
}

void contact_springs(const StepSizes& sizes, const std::vector<ContactPair>& contacts, std::vector<Cause>& causes) {
  const StableStep& stable = sizes.stable_step;
  const double ratio = stable.contact > 0 ? sizes.step_size / stable.contact : 0;
  // Below that the elements under the springs set it.
  if (!(ratio > 1) || stable.contact > 0.95 * stable.elements) return;
  const ContactPair* stiffest = nullptr;
  for (const ContactPair& pair : contacts)
    if (pair.has_springs() && (stiffest == nullptr || pair.contact->penalty_scale * pair.growth >
                                                          stiffest->contact->penalty_scale * stiffest->growth))
      stiffest = &pair;
  if (stiffest == nullptr) return;
  const scene::Contact& contact = *stiffest->contact;
  causes.push_back(Cause{"step beyond contact springs",
                         fmt::format("the penalty springs of contact {} are stiffer than the step allows, which is "
                                     "{:.3g} times theirs: lower contacts.{}.penalty_scale "
                                     "({:.3g}), or {}",
                                     contact.name, ratio, contact.name, contact.penalty_scale, mend),
                         weight(ratio, true) + 0.01});
}

void connectors(const AssembledScene& assembled, const StepSizes& sizes, const std::vector<ConnectorCell>& all,
                std::vector<Cause>& causes) {
  double worst = 0;
  Cause cause;
  for (std::size_t c = 0; c < assembled.scene.connectors.size(); ++c) {
    std::vector<ConnectorCell> cells;
    for (const ConnectorCell& cell : all)
      if (cell.connector == static_cast<int>(c)) cells.push_back(cell);
    const scene::Connector& connector = assembled.scene.connectors[c];
    const double frequency = connector_frequency(assembled.scene, cells, assembled.mass),
                 ratio = 0.5 * frequency * sizes.step_size;
    if (!(ratio > worst)) continue;
    worst = ratio;
    scene::Scene springs_alone;
    springs_alone.connectors = assembled.scene.connectors;
    springs_alone.connectors[c].damping = {0, 0, 0};
    const bool dashpot = connector_frequency(springs_alone, cells, assembled.mass) < 0.5 * frequency;
    cause = {dashpot ? "step beyond dashpot" : "step beyond spring",
             fmt::format("the {} of connector {} is stiffer than the step allows on the masses of its ends, which is "
                         "{:.3g} times its own: lower "
                         "connectors.{}.{}, or {}",
                         dashpot ? "dashpot" : "spring", connector.name, ratio, connector.name,
                         dashpot ? "damping" : "stiffness", mend),
             weight(ratio, true) + 0.02};
  }
  if (worst > 1) causes.push_back(cause);
}

}  // namespace

std::vector<Cause> steps_too_long(const AssembledScene& assembled, const StepSizes& sizes,
                                  const std::vector<ConnectorCell>& cells, const std::vector<ContactPair>& contacts) {
  std::vector<Cause> causes;
  // The global estimate counts elements with their control and damping, springs that press, connectors and beams:
  // within it none of them is a cause, however short its own step is.
  const double global = sizes.stable_step.global;
  if (global > 0 && sizes.step_size <= global) return causes;
  elements(assembled, sizes, causes);
  contact_springs(sizes, contacts, causes);
  connectors(assembled, sizes, cells, causes);
  const double beams = sizes.stable_step.beam > 0 ? sizes.step_size / sizes.stable_step.beam : 0;
  if (beams > 1)
    causes.push_back(
        Cause{"step beyond beams",
              fmt::format("the step is {:.3g} times what the beams allow: make beams.NAME.divisions fewer, or {}",
                          beams, mend),
              weight(beams, true) + 0.03});
  return causes;
}

}  // namespace railwave
