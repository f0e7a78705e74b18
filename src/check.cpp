#include "check.hpp"

#include <fmt/format.h>

#include <ostream>
#include <sstream>

#include "kernels/lanes.hpp"
#include "mesh/quality.hpp"
#include "model/stable_step.hpp"
#include "solve/stages.hpp"

namespace railwave {
namespace {

/// One part's mesh as it stands in the assembly.
Mesh mesh_of(const Assembly& assembly, const Assembly::PartRange& part) {
  Mesh mesh;
  mesh.nodes.assign(assembly.nodes.begin() + part.first_node, assembly.nodes.begin() + part.first_node + part.node_count);
  for (int e = 0; e < part.element_count; ++e) {
    auto corners = assembly.elements[part.first_element + e];
    for (int& n : corners) n -= part.first_node;
    mesh.elements.push_back(corners);
  }
  return mesh;
}

double part_mass(const Model& model, const Assembly::PartRange& part) {
  double mass = 0;
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n) mass += model.mass[n];
  return mass;
}

std::string indented(const std::string& text) {
  std::string result, line;
  std::istringstream lines(text);
  while (std::getline(lines, line)) result += "    " + line + "\n";
  return result;
}

void describe_step(const Model& model, std::ostream& out) {
  out << "Step\n";
  for (const std::string& line : describe_stable_step(model)) out << "  " << line << '\n';
  out << fmt::format("  used {:.4g} s; {} steps to t = {:.4g} s\n", model.step_size, model.step_count, model.scene.time.end);
  for (const std::string& line : describe_subcycling(model)) out << "  subcycling: " << line << '\n';
}

}  // namespace

void describe_run(Model& model, std::ostream& out) {
  if (!model.scene.title.empty()) out << model.scene.title << '\n';
  out << "Parts\n";
  for (const auto& part : model.assembly.parts) {
    const scene::Material& material = model.scene.materials[part.material];
    out << fmt::format("  {}: {} elements, {} nodes, {:.5g} kg of {}\n", part.name, part.element_count, part.node_count,
                       part_mass(model, part), material.name);
    out << indented(describe(mesh_quality(mesh_of(model.assembly, part), material.dilatational_speed())));
  }
  out << fmt::format("  in all: {} elements, {} nodes\n", model.element_count(), model.node_count());
  describe_step(model, out);
  const double megabytes = static_cast<double>(device_bytes(model)) / 1e6;
  out << fmt::format("Memory: {:.4g} MB of arrays, {:.0f} bytes an element\n", megabytes,
                     1e6 * megabytes / static_cast<double>(model.element_count()));
  out << fmt::format("Runs on: {}, patches of {} elements, {} in a pack\n", ExecutionSpace::name(), patch_size, lane_count<double>);
  out << "A step computes\n";
  for (const Stage& stage : force_stages(model)) out << "  " << stage.name << '\n';
  out << "  nodes: gather, constraints, velocities, positions\n";
  out << "Left out\n";
  for (const std::string& what : model.left_out) out << "  " << what << '\n';
}

}  // namespace railwave
