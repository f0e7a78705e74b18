#include <fmt/format.h>

#include <cmath>

#include "model/beams/beams.hpp"
#include "model/time_step/automatic_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

std::string near(int element, const scene::Vec3& at) {
  if (element < 0) return {};
  return fmt::format(" (element near {:.4g}, {:.4g}, {:.4g} m)", at[0], at[1], at[2]);
}

/// What one estimate allows, in all and in parts.
std::string line(const char* by, double all, double elements, const std::string& place, const StableStep& stable,
                 double contact) {
  std::string text = fmt::format("{}: {:.4g} s; elements {:.4g} s{}", by, all, elements, place);
  if (contact > 0) text += fmt::format(", contact springs {:.4g} s", contact);
  if (stable.beam > 0) text += fmt::format(", beams {:.4g} s", stable.beam);
  if (stable.connector > 0) text += fmt::format(", connectors {:.4g} s", stable.connector);
  return text;
}

/// Whether the estimate by heights is below what its parts allow: the assembled scene was asked.
bool shortened(const StableStep& stable) {
  double parts = stable.elements;
  for (double part : {stable.contact, stable.beam})
    if (part > 0) parts = std::fmin(parts, part);
  if (stable.connector > 0) parts = 2 / std::sqrt(4 / (parts * parts) + 4 / (stable.connector * stable.connector));
  return stable.by_elements < 0.9999 * parts;
}

}  // namespace

std::string what_sets_step(const AssembledScene& assembled, const StableStep& stable) {
  if (assembled.scene.time.step > 0) return "time.step";
  const scene::StepEstimate choice = assembled.scene.solver.step_estimate;
  const bool heights = choice == scene::StepEstimate::element ||
                       (choice == scene::StepEstimate::automatic && stable.limit == stable.by_elements);
  const double elements = heights ? stable.elements : stable.eigenvalue,
               contact = heights ? stable.contact : stable.eigenvalue_contact;
  const auto least = [&](double step) { return step > 0 && step <= elements; };
  if (least(stable.connector) && !(contact > 0 && contact < stable.connector))
    return "springs and dashpots of connectors, by their stiffness, damping and masses";
  if (least(contact)) return "contact springs, by penalty_scale and damping";
  if (least(stable.beam)) return "beams, by their sections, lengths and material";
  const int element = heights ? stable.element : stable.eigenvalue_element;
  if (const int part = part_of_element(assembled.assembly, element); part >= 0)
    return fmt::format("elements of part {} by their size, material and damping{}", assembled.assembly.parts[part].name,
                       near(element, heights ? stable.element_place : stable.eigenvalue_place));
  return "the scene as a whole";
}

std::vector<std::string> describe_stable_step(const AssembledScene& assembled, const StableStep& stable,
                                              const std::shared_ptr<BeamModel>& beams) {
  const scene::StepEstimate choice = assembled.scene.solver.step_estimate;
  std::vector<std::string> lines{
      line("stable by element heights", stable.by_elements, stable.elements, near(stable.element, stable.element_place),
           stable, stable.contact),
      line("stable by element eigenvalues", stable.by_eigenvalues, stable.eigenvalue,
           near(stable.eigenvalue_element, stable.eigenvalue_place), stable, stable.eigenvalue_contact)};
  if (shortened(stable)) lines[0] += "; shortened to what they allow together at free surfaces and in contact";
  if (stable.global > 0)
    lines.push_back(
        fmt::format(
            "stable by the whole scene's highest frequency: {:.4g} s{}; {:.3g} times the element heights' step",
            stable.global,
            assembled.scene.contacts.empty() ? "" : fmt::format(" ({} contact springs counted in)", stable.springs),
            stable.global / stable.by_elements) +
        (stable.limit < stable.global
             ? fmt::format("; {:.4g} s for contact springs that bodies strike undamped", stable.limit)
             : ""));
  const char* names[] = {"automatic", "element", "eigenvalue", "global"};
  lines.push_back(assembled.scene.time.step > 0
                      ? fmt::format("set by time.step = {:.4g} s", assembled.scene.time.step)
                      : fmt::format("set by solver.step_estimate = {}, times time.step_scale = {:.4g}",
                                    names[static_cast<int>(choice)], assembled.scene.time.step_scale));
  if (const std::string chosen = describe_choice(stable.choice); !chosen.empty())
    lines.push_back("automatic: " + chosen);
  if (stable.deformed > 0)
    lines.push_back(fmt::format("elements have changed their shape: {:.4g} s is left of it", stable.deformed));
  if (const std::string inertia = describe_beam_inertia(beams); !inertia.empty()) lines.push_back(inertia);
  return lines;
}

}  // namespace railwave
