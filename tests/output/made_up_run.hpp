#pragma once

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "output/results_writer.hpp"
#include "tests/post/hertz_contact.hpp"
#include "tests/temporary_folder.hpp"

namespace railwave::made_up {

/// A block of 4 x 3 x 2 cubes of 5 mm as part "block", with element set "block.lower" (the lower layer), surface
/// "block.top" and node set "block.corner".
inline Assembly block() {
  constexpr int n[3] = {4, 3, 2};
  constexpr double h = 5e-3;
  Assembly assembly;
  const auto node = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) assembly.nodes.push_back({i * h, j * h, k * h});
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const int element = static_cast<int>(assembly.elements.size());
        if (k == 0) assembly.element_sets["block.lower"].push_back(element);
        if (k == n[2] - 1) assembly.surfaces["block.top"].push_back({element, 1});
        assembly.elements.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                     node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                     node(i, j + 1, k + 1)});
      }
  assembly.node_sets["block.corner"] = {0};
  assembly.parts.push_back(
      {"block", 0, static_cast<int>(assembly.nodes.size()), 0, static_cast<int>(assembly.elements.size()), 0});
  return assembly;
}

/// Fields that follow from node number, element number and time by the formulas below, which test_results_file.py knows
/// too.
class Source : public FieldSource {
 public:
  explicit Source(double time) : time_(time) {}

  HostField field(const FieldRow& row, const std::vector<int>& numbers) const override {
    const std::string name = row.name;
    const double scale = name == "displacement" ? 1e-6 : name == "velocity" ? 1.0 : name == "acceleration" ? 1e3 : 1e6;
    HostField result{row.components, {}};
    for (const int number : numbers)
      for (int c = 0; c < row.components; ++c)
        result.values.push_back(name == "plastic_strain"
                                    ? 1e-3 * number + time_
                                    : scale * (number + (row.of_nodes() ? 0.25 : 0.1) * c + 1000 * time_));
    return result;
  }
  ContactState contact(int) const override {
    ContactState state = hertz_contact_state(hertz(time_), {}, HertzForces::sampled);
    for (ContactSide* side : {&state.slave, &state.master}) {
      side->displacement = Source::field(field_named("displacement"), side->nodes).values;
      side->places.resize(side->nodes.size());
      std::iota(side->places.begin(), side->places.end(), 0);
    }
    return state;
  }

  /// The patch rolls along x at 10 m/s and grows while the load comes on.
  static HertzContact hertz(double time) {
    HertzContact contact;
    const double load = 0.6 + 0.4 * std::min(1.0, time / 3e-4);
    contact.a *= load;
    contact.b *= load;
    contact.p0 *= load;
    contact.centre_x = 10 * time - 2e-3;
    return contact;
  }

 private:
  double time_;
};

/// Of positions and displacements at the time 0.
inline ContactSurface surface_of(const ContactSide& side) {
  ContactSurface surface{side.nodes, side.facets, side.position};
  for (std::size_t i = 0; i < side.displacement.size(); ++i) surface.coordinates[i] -= side.displacement[i];
  return surface;
}

inline RunDescription description() {
  scene::Scene scene;
  scene.path = "made-up.toml";
  scene.output.field_sets = {"block", "block.lower", "block.top"};
  RunDescription result;
  result.program_version = "0.0.0";
  result.title = "A made-up run <with> \"marks\" & ö";
  result.case_path = scene.path;
  result.case_text = "title = \"made up\"\n# a remark\n";
  result.step_size = 1e-6;
  result.end_time = 4e-4;
  const Assembly assembly = block();
  result.node_count = static_cast<long>(assembly.nodes.size());
  result.element_count = static_cast<long>(assembly.elements.size());
  const ContactState contact = Source(0).contact(0);
  ContactDescription tread{"tread", "wheel.tread", "rail.head"};
  tread.friction = contact.friction;
  tread.slave_surface = surface_of(contact.slave);
  tread.master_surface = surface_of(contact.master);
  result.contacts = {tread};
  result.history_sets = {"block.corner", "sprung_mass"};
  result.history_askers = {"probe corner", ""};
  result.loads = {{"blow", "block.corner", false, true, {0, 0, -1}}, {"drive", "wheel.bore", true, false, {0, 1, 0}}};
  result.fields = {"displacement", "velocity", "acceleration", "stress", "plastic_strain"};
  result.sets = resolve_output_sets(scene, assembly);
  return result;
}

inline HistorySample sample(long step) {
  HistorySample result;
  result.step = step;
  result.time = 1e-6 * step;
  result.energy = {1000.0 + step, 20.0 + step, 1e-3 * step,  2.0 + step, 0.5 * step,
                   3.0,           0.25 * step, 0.125 * step, 1.5 * step, 1e-2 * step};
  const HertzContact hertz = Source::hertz(result.time);
  ContactTotals totals;
  totals.normal_force = {0, 0, hertz.normal_force()};
  totals.tangential_force = {hertz.creep_force(), 0, 0};
  totals.master_force = {-hertz.creep_force(), 0, -hertz.normal_force()};
  totals.nodes_in_contact = static_cast<int>(100 + step);
  totals.nodes_slipping = static_cast<int>(step);
  result.contacts = {totals};
  const double s = static_cast<double>(step);
  result.sets = {{{s, s + 1, s + 2}, {-s, 0, s}, {2 * s, 0, 0}}, {{0, 0, s}, {0, 0, 1}, {0, 0, 0}}};
  result.loads = {{{0, 0, -s}, 0}, {{}, 2 * s}};
  return result;
}

constexpr long steps = 400, steps_between_fields = 100;

/// Feeds a writer as the time loop would: a history sample at every step, fields at every hundredth, up to and with
/// `last`.
template <class Writer>
void feed(Writer& writer, long last) {
  for (long step = 0; step <= last; ++step) {
    writer.history(sample(step));
    if (step % steps_between_fields == 0) writer.fields(Source(1e-6 * step), 1e-6 * step, step);
  }
}

inline RunSummary summary() {
  RunSummary result;
  result.completed = true;
  result.time = 4e-4;
  result.steps = steps;
  result.step_size = 1e-6;
  result.wall_seconds = 1.5;
  result.element_steps_per_second = 6400;
  result.left_out = {"gravity", "loads"};
  return result;
}

using railwave::TemporaryFolder;

}  // namespace railwave::made_up
