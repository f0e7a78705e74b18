#include "commands/check.hpp"

#include <fmt/format.h>

#include <ostream>
#include <sstream>

#include "case/activity.hpp"
#include "kernels/support/lanes.hpp"
#include "mesh/quality.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/checks/doubts.hpp"
#include "model/contact/contact_law.hpp"
#include "model/contact/initial_overlap.hpp"
#include "model/sets/place_sets.hpp"
#include "model/time_step/stable_step.hpp"
#include "output/results_file.hpp"
#include "solve/plan.hpp"
#include "solve/statics/settle.hpp"

namespace railwave {
namespace {

/// One part's mesh as it stands in the assembly.
Mesh mesh_of(const Assembly& assembly, const Assembly::PartRange& part) {
  Mesh mesh;
  mesh.nodes.assign(assembly.nodes.begin() + part.first_node,
                    assembly.nodes.begin() + part.first_node + part.node_count);
  for (int e = 0; e < part.element_count; ++e) {
    auto corners = assembly.elements[part.first_element + e];
    for (int& n : corners) n -= part.first_node;
    mesh.elements.push_back(corners);
  }
  return mesh;
}

double part_mass(const std::vector<double>& mass, const Assembly::PartRange& part) {
  double sum = 0;
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n) sum += mass[n];
  return sum;
}

/// The first part after `first` that isn't the same mesh of the same material: a track's sleepers are reported once.
std::size_t first_unlike(const scene::Scene& scene, std::size_t first) {
  const scene::Part& one = scene.parts[first];
  std::size_t next = first + 1;
  while (next < scene.parts.size() && scene.parts[next].mesh == one.mesh &&
         scene.parts[next].material == one.material && scene.parts[next].element_set == one.element_set)
    ++next;
  return next;
}

std::string indented(const std::string& text) {
  std::string result, line;
  std::istringstream lines(text);
  while (std::getline(lines, line)) result += "    " + line + "\n";
  return result;
}

void describe_step(const Model& model, std::ostream& out) {
  out << "Step\n";
  for (const std::string& line : describe_stable_step(model, model.stable_step, model.beams))
    out << "  " << line << '\n';
  out << fmt::format("  used {:.4g} s; {} steps to t = {:.4g} s\n", model.step_size, model.step_count,
                     model.scene.time.end);
  for (const std::string& line : describe_output_times(model.scene, model, model.subcycling.cycle()))
    out << "  " << line << '\n';
  for (const std::string& line : describe_subcycling(model.scene, model.subcycling))
    out << "  subcycling: " << line << '\n';
}

void describe_places(const AssembledScene& assembled, std::ostream& out) {
  const auto placed = placed_sets(assembled.scene, assembled.assembly);
  const auto elements = placed_element_sets(assembled.scene, assembled.assembly);
  if (placed.empty() && elements.empty()) return;
  out << "Sets by position, hammers and probes\n";
  for (const PlacedSet& one : placed) {
    const Vec3& at = assembled.assembly.nodes[one.nearest];
    out << fmt::format("  {}.{}: {} node{}, the nearest at [{:.6g}, {:.6g}, {:.6g}], {:.3g} mm away\n", one.set->part,
                       one.set->name, one.count, one.count == 1 ? "" : "s", at[0], at[1], at[2], 1e3 * one.distance);
    if (!one.warning.empty()) out << "    warning: " << one.warning << '\n';
  }
  for (const PlacedElements& one : elements) {
    out << fmt::format("  {}.{}: {} element{}, {} with its centre at [{:.6g}, {:.6g}, {:.6g}], {:.3g} mm away\n",
                       one.set->part, one.set->name, one.count, one.count == 1 ? "" : "s",
                       one.warning.empty() ? "in one" : "the nearest", one.centre[0], one.centre[1], one.centre[2],
                       1e3 * one.distance);
    if (!one.warning.empty()) out << "    warning: " << one.warning << '\n';
  }
}

/// Where waves leave, and which do not.
void describe_ends(const AssembledScene& assembled, const AbsorbingLayers& absorbing, std::ostream& out) {
  for (const std::string& line : describe_absorbing_layers(assembled, absorbing)) out << line << '\n';
  report("note", describe_slender_ends(assembled, absorbing), out);
}

/// Small overlaps of contacts, as cases have that press bodies together by their places: the deep ones are doubts.
void describe_overlaps(const AssembledScene& assembled, const std::vector<ContactPair>& contacts, double step_size,
                       std::ostream& out) {
  for (const InitialOverlap& overlap : initial_overlaps(assembled, contacts, step_size))
    if (!overlap.deep) out << "note: " << describe(assembled.scene, overlap) << '\n';
}

/// Which algorithm each contact has, and why.
void describe_algorithms(const scene::Scene& scene, std::ostream& out) {
  for (const scene::Contact& contact : scene.contacts)
    out << fmt::format("[contacts.{}]: {}\n", contact.name, describe_algorithm(contact));
}

/// What rolls, and at what rate; then all that may be a mistake.
void describe_motions(const Model& model, std::ostream& out) {
  for (const scene::InitialMotion& motion : model.scene.initial_motions)
    if (motion.rolling) {
      const Vec3& w = motion.angular_velocity;
      out << fmt::format("[initial_motion.{}] rolls at [{:.6g}, {:.6g}, {:.6g}] rad/s\n", motion.name, w[0], w[1],
                         w[2]);
    }
  report("warning", scene_doubts(model, model.contacts, model.absorbing, model.step_size), out);
}

void describe_tasks(const std::string& title, const std::vector<std::string>& lines, std::ostream& out) {
  out << title << '\n';
  for (const std::string& line : lines) out << "  " << line << '\n';
}

}  // namespace

void report(const char* kind, const std::vector<std::string>& lines, std::ostream& out) {
  for (const std::string& line : lines) out << kind << ": " << line << '\n';
  out.flush();
}

void describe_run(Model& model, std::ostream& out) {
  const Activity describing("judging the elements' shapes");
  if (!model.scene.title.empty()) out << model.scene.title << '\n';
  out << "Parts\n";
  for (std::size_t p = 0; p < model.assembly.parts.size();) {
    const auto& part = model.assembly.parts[p];
    const scene::Material& material = model.scene.materials[part.material];
    const std::size_t next = first_unlike(model.scene, p);
    const std::string name = next == p + 1 ? part.name
                                           : fmt::format("{} to {}, {} alike, each", part.name,
                                                         model.assembly.parts[next - 1].name, next - p);
    out << fmt::format("  {}: {} elements, {} nodes, {:.5g} kg of {}\n", name, part.element_count, part.node_count,
                       part_mass(model.mass, part), material.name);
    out << indented(describe(mesh_quality(mesh_of(model.assembly, part), material.dilatational_speed())));
    p = next;
  }
  out << fmt::format("  in all: {} elements, {} nodes\n", model.element_count(), model.node_count());
  if (!model.scene.connectors.empty())
    out << fmt::format("Connectors: {}, of {} springs and dashpots\n", model.scene.connectors.size(),
                       model.connectors.cells.size());
  describe_places(model, out);
  describe_ends(model, model.absorbing, out);
  describe_algorithms(model.scene, out);
  describe_overlaps(model, model.contacts, model.step_size, out);
  describe_motions(model, out);
  describe_step(model, out);
  const double megabytes = static_cast<double>(device_bytes(model)) / 1e6;
  out << fmt::format("Memory: {:.4g} MB of arrays, {:.0f} bytes an element\n", megabytes,
                     1e6 * megabytes / static_cast<double>(model.element_count()));
  out << describe(ResultsFile(model.scene, model.assembly, RAILWAVE_VERSION).size(model, model)) << '\n';
  out << fmt::format("Runs on: {}, blocks of {} elements, {} in a pack\n", ExecutionSpace::name(), elements_of_block,
                     lane_count<double>);
  const StepPlans plans(model);
  describe_tasks("A step computes (steps of table 2.1 of the thesis)", describe_plan(plans.of(StepKind::advancing)),
                 out);
  describe_tasks("A step that is sampled, for histories, fields and the monitor, computes",
                 describe_plan(plans.of(StepKind::sampled)), out);
  for (const SettlingTasks& settling : describe_settling(model))
    describe_tasks("Settling by " + settling.method + " computes", settling.lines, out);
  out << "Left out\n";
  for (const std::string& what : model.left_out) out << "  " << what << '\n';
}

}  // namespace railwave
