#include "deck/abaqus_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "mesh/files/text_file.hpp"

namespace railwave::deck {
namespace {

constexpr Number always = 1;  // number of the curve that is 1 always

bool is_among(const std::string& name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* one) { return name == one; });
}

/// Keywords of the mesh, which read_abaqus_numbers() has read.
bool of_mesh(const std::string& name) {
  return is_among(name, {"NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "PART", "ENDPART", "ASSEMBLY", "ENDASSEMBLY",
                         "INSTANCE", "ENDINSTANCE", "HEADING", "ENDSTEP"});
}

/// Keywords that change nothing here, and why.
const char* why_dropped(const std::string& name) {
  if (is_among(name, {"PREPRINT", "RESTART", "FILEOUTPUT", "FILEFORMAT", "ENERGYOUTPUT", "CONTACTOUTPUT",
                      "ELEMENTOUTPUT", "NODEPRINT", "ELPRINT", "NODEFILE", "ELFILE", "ENERGYPRINT", "MONITOR", "PRINT",
                      "INCREMENTATIONOUTPUT", "INTEGRATEDOUTPUT", "FILTER", "DIAGNOSTICS", "PHYSICALCONSTANTS"}))
    return "what is written is as [output] of the case has it";
  if (is_among(name, {"EXPANSION", "CONDUCTIVITY", "SPECIFICHEAT", "INELASTICHEATFRACTION", "LATENTHEAT"}))
    return "there is no heat";
  if (name == "SECTIONCONTROLS") return "hourglass control is by stiffness";
  if (name == "FIXEDMASSSCALING" || name == "VARIABLEMASSSCALING")
    return "no mass is added: results are those without mass scaling";
  if (is_among(name, {"CONTACT", "CONTACTCONTROLS", "CONTACTFORMULATION", "SURFACEBEHAVIOR", "CHANGEFRICTION"}))
    return "surfaces press where they meet, by Lagrange multipliers where these can be";
  return nullptr;
}

}  // namespace

AbaqusDeckReader::AbaqusDeckReader(const std::string& path, Deck& into, Report& on)
    : deck(into), report(on), file(read_abaqus_numbers(path)), lines(path, into.mesh.files) {}

void AbaqusDeckReader::fail(const FilePlace& place, const std::string& text) const {
  throw InputError(lines.where(place) + " " + text);
}

double AbaqusDeckReader::real(std::string_view field, const char* what) const {
  if (field.empty()) return 0;
  const auto value = parse_real(field);
  if (!value) fail(lines.place(), fmt::format("'{}' is no {}; give a number", for_message(field), what));
  return *value;
}

Number AbaqusDeckReader::whole(std::string_view field, const char* what) const {
  const double value = real(field, what);
  if (std::floor(value) != value || std::fabs(value) > 2e9)
    fail(lines.place(), fmt::format("'{}' is no {}; give a whole number", for_message(field), what));
  return static_cast<Number>(value);
}

Number AbaqusDeckReader::number_of(const std::string& kind, const std::string& name) {
  // Curve 1 is taken, and numbers of other things may begin with 1.
  const auto next = static_cast<Number>(numbers_.size()) + 2;
  return numbers_.emplace(std::make_pair(kind, name), next).first->second;
}

Nodes AbaqusDeckReader::nodes(std::string_view field) {
  if (const auto number = parse_integer(field)) {
    if (!file.numbered.find_node(*number)) fail(lines.place(), fmt::format("there is no node {}; mend it", *number));
    return {*number, false};
  }
  std::string name = lower_case(field);
  // "instance.set"
  if (file.mesh.node_sets.count(name) == 0 && name.find('.') != std::string::npos)
    name = name.substr(name.find('.') + 1);
  const auto set = file.mesh.node_sets.find(name);
  if (set == file.mesh.node_sets.end())
    fail(lines.place(),
         fmt::format("there is no node set '{}'; define it by *NSET, or mend the name", for_message(name)));
  const Number number = number_of("node set", name);
  NumberSet& kept = deck.node_sets[number];
  if (kept.ranges.empty()) {
    kept.source = {lines.place(), "NSET"};
    kept.title = name;
    for (const int n : set->second) {
      const Number of_node = file.numbered.node_numbers()[n];
      kept.ranges.push_back({of_node, of_node, 1});
    }
  }
  return {number, true};
}

Number AbaqusDeckReader::surface(const std::string& name, const FilePlace& place) {
  const auto found = file.mesh.surfaces.find(name);
  if (found == file.mesh.surfaces.end())
    fail(place, fmt::format("there is no surface '{}' of element faces; define it by *SURFACE", for_message(name)));
  const Number number = number_of("surface", name);
  SegmentSet& kept = deck.segment_sets[number];
  if (kept.segments.empty()) {
    kept.source = {place, "SURFACE"};
    kept.title = name;
    for (const Face& face : found->second) {
      const auto corners = file.mesh.face_nodes(face);
      Segment segment{};
      for (int i = 0; i < 4; ++i) segment[i] = file.numbered.node_numbers()[corners[i]];
      kept.segments.push_back(segment);
    }
  }
  return number;
}

std::vector<int> AbaqusDeckReader::elements(std::string_view field) {
  std::vector<int> all;
  if (field.empty()) {
    for (std::size_t e = 0; e < file.mesh.elements.size(); ++e) all.push_back(static_cast<int>(e));
    return all;
  }
  if (const auto number = parse_integer(field)) {
    const auto element = file.numbered.find_element(*number);
    if (!element) fail(lines.place(), fmt::format("there is no element {}; mend it", *number));
    return {*element};
  }
  std::string name = lower_case(field);
  if (file.mesh.element_sets.count(name) == 0 && name.find('.') != std::string::npos)
    name = name.substr(name.find('.') + 1);
  const auto set = file.mesh.element_sets.find(name);
  if (set == file.mesh.element_sets.end())
    fail(lines.place(),
         fmt::format("there is no element set '{}'; define it by *ELSET, or mend the name", for_message(name)));
  return set->second;
}

Number AbaqusDeckReader::curve(const AbaqusKeyword& keyword) {
  const std::string name = keyword.value("AMPLITUDE");
  return name.empty() ? always : number_of("amplitude", name);
}

void AbaqusDeckReader::take_mesh() {
  const auto& numbered = file.numbered;
  const auto files = deck.mesh.files;
  deck.mesh = numbered;
  deck.mesh.files = files;  // opened again, in the same order
  deck.node_scopes.assign(numbered.node_count(), 0);
  deck.element_parts.assign(numbered.element_count(), 0);
}

void AbaqusDeckReader::begin_step(const AbaqusKeyword& keyword) {
  if (in_step) report.refuse_always(source(keyword), "this is a second step; a case has one: write each to a deck");
  in_step = true;
  skip();
}

void AbaqusDeckReader::read_dynamic(const AbaqusKeyword& keyword) {
  if (!keyword.has("EXPLICIT")) {
    report.refuse_always(source(keyword), "the step is no *DYNAMIC, EXPLICIT, the only kind that Railwave computes");
    return skip();
  }
  if (!lines.has_data()) fail(keyword.place, "the step has no time; write ', T' in the next line");
  const auto fields = lines.take_fields();
  deck.control.end = fields.size() > 1 ? real(fields[1], "time") : 0;
  deck.control.end_source = here(keyword);
  if (keyword.has("SCALEFACTOR")) deck.control.step_scale = real(keyword.parameters.at("SCALEFACTOR"), "factor");
  skip();
}

void AbaqusDeckReader::read_viscosity(const AbaqusKeyword& keyword) {
  if (lines.has_data()) {
    const auto fields = lines.take_fields();
    deck.control.linear_viscosity = real(fields[0], "b1");
    const double b2 = fields.size() > 1 ? real(fields[1], "b2") : 0;
    deck.control.quadratic_viscosity = b2 * b2;
    report.add(Fate::taken, here(keyword), "linear_bulk_viscosity b1, quadratic_bulk_viscosity b2^2");
  }
  skip();
}

void AbaqusDeckReader::read_output(const AbaqusKeyword& keyword) {
  skip();
  history_ = keyword.has("HISTORY");
  double interval = keyword.has("TIMEINTERVAL") ? real(keyword.parameters.at("TIMEINTERVAL"), "interval") : 0;
  if (const double count = keyword.has("NUMBERINTERVAL") ? real(keyword.parameters.at("NUMBERINTERVAL"), "number") : 0;
      count > 0 && deck.control.end)
    interval = *deck.control.end / count;
  if (interval > 0) (history_ ? deck.control.history_interval : deck.control.field_interval) = interval;
  report.add(Fate::replaced, source(keyword), history_ ? "output.history_interval" : "output.field_interval");
}

void AbaqusDeckReader::read_node_output(const AbaqusKeyword& keyword) {
  skip();
  if (history_ && keyword.has("NSET"))
    deck.history_node_sets.emplace_back(source(keyword), nodes(keyword.parameters.at("NSET")).number);
  else
    report.add(Fate::dropped, source(keyword), "what is written is as [output] of the case has it");
}

void AbaqusDeckReader::take(const AbaqusKeyword& keyword) {
  const std::string& name = keyword.name;
  if (of_mesh(name)) {
    if (const std::string type = keyword.value("TYPE"); name == "ELEMENT")
      report.add(type == "c3d8r" ? Fate::taken : Fate::replaced, source(keyword),
                 type == "c3d8r" ? "one-point hexahedra, the elements here"
                                 : "one-point hexahedra with hourglass control by stiffness");
    if (keyword.has("INPUT") && is_among(name, {"NODE", "ELEMENT", "NSET", "ELSET"})) lines.include(keyword);
    return skip();
  }
  if (keyword.has("INPUT")) fail(keyword.place, "INPUT= isn't read here; write the lines themselves, or *INCLUDE");
  if (report.drops(name)) {
    report.add(Fate::dropped, source(keyword), "as --drop asks");
    return skip();
  }
  if (name == "MATERIAL") return read_material(keyword);
  if (is_among(name, {"DENSITY", "ELASTIC", "PLASTIC", "DAMPING"})) return read_material_data(keyword);
  if (name == "SOLIDSECTION") return read_section(keyword);
  if (name == "AMPLITUDE") return read_amplitude(keyword);
  if (name == "SURFACEINTERACTION") {
    interaction_ = keyword.value("NAME");
    return skip();
  }
  if (name == "FRICTION") return read_friction(keyword);
  if (name == "CONTACTPAIR") return read_pair(keyword);
  if (name == "CONTACTINCLUSIONS") return read_inclusions(keyword);
  if (name == "CONTACTPROPERTYASSIGNMENT") return read_properties(keyword);
  if (name == "TIE") return read_tie(keyword);
  if (name == "BOUNDARY") return read_abaqus_boundary(*this, keyword);
  if (name == "INITIALCONDITIONS") return read_abaqus_velocity(*this, keyword);
  if (name == "CLOAD") return read_abaqus_nodal_load(*this, keyword);
  if (name == "DLOAD") return read_abaqus_distributed_load(*this, keyword);
  if (name == "DSLOAD") return read_abaqus_surface_load(*this, keyword);
  if (name == "STEP") return begin_step(keyword);
  if (name == "DYNAMIC") return read_dynamic(keyword);
  if (name == "BULKVISCOSITY") return read_viscosity(keyword);
  if (name == "OUTPUT") return read_output(keyword);
  if (name == "NODEOUTPUT") return read_node_output(keyword);
  if (const char* why = why_dropped(name))
    report.add(Fate::dropped, source(keyword), why);
  else
    report.refuse(source(keyword), name, "this keyword isn't read, and may change what is computed");
  skip();
}

void AbaqusDeckReader::finish() {
  if (deck.mesh.files.size() < file.numbered.files.size()) deck.mesh.files = file.numbered.files;
  Curve one;
  one.points = {{0, 1}, {1e-300, 1}};
  if (deck.control.end && *deck.control.end > 0) one.points[1][0] = *deck.control.end;
  one.source = {{0, 1}, "STEP"};
  deck.curves[always] = one;
  for (auto& [number, material] : deck.materials) {
    // Slope over plastic strain to that over total strain, in series with E.
    const double h = material.tangent_modulus, e = material.youngs_modulus;
    if (h > 0 && e > 0) material.tangent_modulus = e * h / (e + h);
  }
  for (const auto& [contact, interaction] : interactions_)
    if (const auto found = friction_.find(interaction); found != friction_.end())
      deck.contacts[contact].friction = found->second;
  for (const auto& [number, part] : deck.parts)
    for (const bool by_mass : {true, false}) {
      const auto& values = by_mass ? mass_damping_ : stiffness_damping_;
      const auto found = values.find(part.material);
      if (found == values.end() || found->second == 0) continue;
      // Below 0 the second kind is Rayleigh's beta.
      const double value = by_mass ? found->second : -found->second;
      deck.dampings.push_back({{part.source.place, "DAMPING"}, by_mass, number, false, 0, value});
    }
  for (std::size_t e = 0; e < deck.element_parts.size(); ++e)
    if (deck.element_parts[e] == 0)
      fail(deck.mesh.place_of_element(static_cast<int>(e)),
           fmt::format("element {} is in no *SOLID SECTION; give its set one", deck.mesh.element_numbers()[e]));
}

void AbaqusDeckReader::read() {
  take_mesh();
  // Abaqus' own: p = rho (b2 l d)^2 with b2 = 1.2, b1 = 0.06; hourglass control by stiffness.
  deck.control.quadratic_viscosity = 1.44;
  deck.control.linear_viscosity = 0.06;
  deck.control.hourglass_type = 4;
  deck.control.hourglass_coefficient = 0.05;
  while (lines.has_line()) {
    if (lines.has_data()) {
      lines.take_fields();
      continue;
    }
    take(lines.take_keyword());
  }
  finish();
}

void read_abaqus_deck(const std::string& path, Deck& deck, Report& report) {
  AbaqusDeckReader(path, deck, report).read();
}

}  // namespace railwave::deck
