#include "deck/import_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "case/error.hpp"
#include "deck/abaqus_deck.hpp"
#include "deck/conversion.hpp"
#include "deck/deck_reader.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave::deck {
namespace {

constexpr double usual_viscous = 0.1;                         // QM of IHQ 1 to 5
constexpr double usual_stiffness = 0.05;                      // of Railwave, see docs/hourglass.md
constexpr double usual_quadratic = 1.5, usual_linear = 0.06;  // Q1, Q2
constexpr double usual_step_scale = 0.9;

const char* const solid_laws = "*MAT_ELASTIC, *MAT_PLASTIC_KINEMATIC or *MAT_PIECEWISE_LINEAR_PLASTICITY";

/// Hourglass control of a part: IHQ 1 to 3 act by velocity, 4 and 5 by displacement, others are not here.
void set_hourglass(const Deck& deck, const Part& part, Settings& settings, Report& report) {
  Number type = deck.control.hourglass_type;
  double coefficient = deck.control.hourglass_coefficient;
  settings.quadratic = deck.control.quadratic_viscosity;
  settings.linear = deck.control.linear_viscosity;
  Source source = part.source;
  if (const auto own = deck.hourglass.find(part.hourglass); part.hourglass != 0 && own != deck.hourglass.end()) {
    source = own->second.source;
    if (own->second.type != 0) type = own->second.type;
    if (own->second.coefficient != 0) coefficient = own->second.coefficient;
    if (own->second.quadratic != 0) settings.quadratic = own->second.quadratic;
    if (own->second.linear != 0) settings.linear = own->second.linear;
  }
  if (settings.quadratic == 0) settings.quadratic = usual_quadratic;
  if (settings.linear == 0) settings.linear = usual_linear;
  const Section& section = deck.sections.at(part.section);
  const bool full = section.formulation == 2 || section.formulation == 3 || section.formulation == -1 ||
                    section.formulation == -2 || section.formulation == 18 || section.formulation == -18;
  if (full) {
    settings.stiffness = true;
    settings.hourglass = usual_stiffness;
    report.add(Fate::replaced, section.source,
               fmt::format("ELFORM {}: one-point hexahedra with hourglass control by stiffness, {}",
                           section.formulation, usual_stiffness));
    return;
  }
  report.add(Fate::taken, section.source, "one-point hexahedra, the elements here");
  if (type == 0) type = 2;
  settings.stiffness = type > 3;
  settings.hourglass = std::fabs(coefficient != 0 ? coefficient : usual_viscous);
  if (type > 5) settings.hourglass = usual_stiffness;
  if (settings.hourglass > 1) settings.hourglass = 1;
  const char* kind = settings.stiffness ? "stiffness" : "viscous";
  if (deck.of_abaqus)
    report.add(Fate::replaced, source,
               fmt::format("hourglass = \"{}\", {}, in place of Abaqus' own", kind, settings.hourglass));
  else if (type == 2 || type == 1 || type == 3)
    report.add(type == 2 ? Fate::taken : Fate::replaced, source,
               fmt::format("hourglass = \"{}\", {} (IHQ {})", kind, settings.hourglass, type));
  else
    report.add(
        Fate::replaced, source,
        fmt::format("IHQ {}: hourglass = \"{}\", {}; its coefficient is not quite the same, see docs/hourglass.md",
                    type, kind, settings.hourglass));
}

/// A constant factor of a damping, 1 without a curve.
bool constant_factor(const Deck& deck, const Damping& damping, double& factor) {
  factor = 1;
  if (damping.curve == 0) return true;
  const auto curve = deck.curves.find(damping.curve);
  if (curve == deck.curves.end()) return false;
  factor = curve->second.points.front()[1];
  return std::all_of(curve->second.points.begin(), curve->second.points.end(),
                     [&](const auto& point) { return point[1] == factor; });
}

void set_damping(const Deck& deck, std::map<Number, Settings>& settings, Report& report) {
  for (const Damping& damping : deck.dampings) {
    double factor = 1;
    if (!constant_factor(deck, damping, factor)) {
      report.refuse(damping.source, damping.source.keyword + ".LCID",
                    "its curve is not constant, and damping here is constant in time");
      continue;
    }
    if (!damping.by_mass && damping.value > 0) {
      report.refuse(damping.source, damping.source.keyword + ".COEF",
                    "COEF above 0 damps each element's highest frequencies, which has no counterpart; COEF below 0, "
                    "Rayleigh's beta, is taken");
      continue;
    }
    const double value = damping.curve != 0 || damping.part == 0 ? factor * damping.value : damping.value;
    for (auto& [number, of_part] : settings) {
      bool meant = damping.part == 0 || damping.part == number;
      if (damping.is_set) {
        const auto set = deck.part_sets.find(damping.part);
        meant = set != deck.part_sets.end() &&
                std::any_of(set->second.ranges.begin(), set->second.ranges.end(), [&, n = number](const Range& range) {
                  return n >= range.first && n <= range.last && (n - range.first) % range.step == 0;
                });
      }
      if (meant && damping.by_mass) of_part.mass_damping = value;
      if (meant && !damping.by_mass) of_part.stiffness_damping = -value;
    }
    if (const auto curve = deck.curves.find(damping.curve); curve != deck.curves.end())
      report.add(Fate::taken, curve->second.source, "it is constant: damping of the parts");
    report.add(Fate::taken, damping.source,
               damping.by_mass ? "mass_damping of the parts" : "stiffness_damping of the parts");
  }
}

/// Settings of each part that has hexahedra; refuses what these can't have.
std::map<Number, Settings> part_settings(const Deck& deck, Report& report) {
  std::map<Number, Settings> settings;
  std::set<Number> seen;
  for (std::size_t e = 0; e < deck.element_parts.size(); ++e) {
    const Number number = deck.element_parts[e];
    if (!seen.insert(number).second) continue;
    const Source of_element{deck.mesh.place_of_element(static_cast<int>(e)), "ELEMENT_SOLID"};
    const auto part = deck.parts.find(number);
    if (part == deck.parts.end()) {
      report.refuse_always(of_element,
                           fmt::format("there is no part {}; define it by *PART, or mend the number", number));
      continue;
    }
    const Source& source = part->second.source;
    const auto section = deck.sections.find(part->second.section);
    const auto material = deck.materials.find(part->second.material);
    if (section == deck.sections.end()) {
      report.refuse_always(source,
                           fmt::format("part {}: there is no section {} that is read", number, part->second.section));
      continue;
    }
    if (material == deck.materials.end()) {
      report.refuse_always(source, fmt::format("part {}: there is no material {} that is read; take {}", number,
                                               part->second.material, solid_laws));
      continue;
    }
    const Material& law = material->second;
    const std::string& unfit = section->second.refusal;
    if (!unfit.empty() || section->second.kind != Section::Kind::solid)
      report.refuse_always(section->second.source,
                           fmt::format("part {} of hexahedra: {}", number,
                                       unfit.empty() ? "its section is none of *SECTION_SOLID" : unfit));
    if (!law.refusal.empty() || (law.kind != Material::Kind::elastic && law.kind != Material::Kind::plastic))
      report.refuse_always(law.source, fmt::format("part {}: {}", number,
                                                   law.refusal.empty() ? "its law is not one of solids" : law.refusal));
    for (const auto& more : law.more) report.refuse(law.source, more[1], more[0]);
    const Number hourglass = part->second.hourglass;
    if (hourglass != 0 && deck.hourglass.count(hourglass) == 0)
      report.refuse_always(source, fmt::format("part {}: there is no *HOURGLASS {}; define it", number, hourglass));
    Settings& own = settings[number];
    own.material = part->second.material;
    if (unfit.empty()) set_hourglass(deck, part->second, own, report);
  }
  set_damping(deck, settings, report);
  return settings;
}

void report_unused(const Deck& deck, const std::map<Number, Settings>& used, Report& report) {
  std::set<Number> needed;
  for (const Beam& beam : deck.beams) needed.insert(beam.part);
  for (const Discrete& one : deck.discretes) needed.insert(one.part);
  for (const auto& [number, part] : deck.parts)
    if (used.count(number) == 0 && needed.count(number) == 0)
      report.add(Fate::dropped, part.source, fmt::format("part {} has no elements", number));
}

}  // namespace

Import import_deck(const std::string& path, const ImportOptions& options) {
  Deck deck;
  Report report(options.drop);
  std::optional<Units> units;
  if (!options.units.empty()) units = units_of(options.units);
  const bool abaqus = lower_case(std::filesystem::path(path).extension().string()) == ".inp";
  deck.of_abaqus = abaqus;
  if (abaqus)
    read_abaqus_deck(path, deck, report);
  else
    read_deck(path, deck, report);
  if (!deck.control.end || !(*deck.control.end > 0)) {
    const Source nowhere{deck.control.end ? deck.control.end_source.place : FilePlace{0, 1},
                         abaqus ? "STEP" : "CONTROL_TERMINATION"};
    report.refuse_always(nowhere, abaqus ? "the deck has no step with a time; give it *DYNAMIC, EXPLICIT"
                                         : "the deck has no end time; give it by ENDTIM of *CONTROL_TERMINATION");
  }
  make_walls(deck, report);
  const auto settings = part_settings(deck, report);
  report.check(deck.mesh.files);
  std::set<Number> materials;
  for (const auto& [number, of_part] : settings) materials.insert(of_part.material);
  if (!units) units = guessed_units(deck, materials, path);
  report_unused(deck, settings, report);
  Bodies bodies(deck, settings, report);
  report.check(deck.mesh.files);
  Conversion conversion{deck, report, *units, bodies, {deck, bodies}, {}, options.mesh_file, {}, {}, {}, {}};
  conversion.text.remark(fmt::format("Made by railwave import of {}, whose units are {}.",
                                     std::filesystem::path(path).filename().string(), units->name));
  conversion.text.key("title", toml(deck.title.empty() ? std::filesystem::path(path).stem().string() : deck.title));
  for (const auto write :
       {write_bodies, write_points, write_joints, write_beams, write_connectors, write_constraints, write_motions,
        write_non_reflecting, write_velocities, write_loads, write_contacts, write_run})
    write(conversion);
  report.check(deck.mesh.files);
  report.close();

  Import import;
  import.text = conversion.text.text();
  for (const auto& [name, section] : conversion.curves) import.text += "\n" + section;
  import.mesh = conversion.mesh.text(imported_mesh_mark);
  import.report = std::string(imported_report_mark) + "\n" + report.text(deck.mesh.files);
  import.files = deck.mesh.files;
  for (const std::string& word : report.unused_drops())
    import.notes.push_back(fmt::format("--drop {} met nothing in the deck", word));
  import.nodes = deck.mesh.node_count();
  import.elements = deck.mesh.element_count();
  import.parts = conversion.bodies.all().size();
  import.taken = report.count(Fate::taken);
  import.replaced = report.count(Fate::replaced);
  import.dropped = report.count(Fate::dropped);
  return import;
}

}  // namespace railwave::deck
