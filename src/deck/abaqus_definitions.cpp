#include <fmt/format.h>

#include <cmath>

#include "case/error.hpp"
#include "deck/abaqus_deck.hpp"
#include "mesh/files/text_file.hpp"

// Materials, sections, amplitudes, contacts and ties of an Abaqus input.
namespace railwave::deck {

void AbaqusDeckReader::read_material(const AbaqusKeyword& keyword) {
  const std::string name = keyword.value("NAME");
  material_ = number_of("material", name);
  Material& material = deck.materials[material_];
  material.source = source(keyword);
  material.kind = Material::Kind::elastic;
  material.title = name;
  skip();
}

void AbaqusDeckReader::read_plastic(const AbaqusKeyword& keyword) {
  Material& material = deck.materials[material_];
  std::vector<std::array<double, 2>> points;
  while (lines.has_data()) {
    const auto fields = lines.take_fields();
    points.push_back({real(fields[0], "yield stress"), fields.size() > 1 ? real(fields[1], "plastic strain") : 0});
  }
  const std::string hardening = keyword.value("HARDENING");
  const bool kinematic = hardening == "kinematic";
  if ((!hardening.empty() && hardening != "isotropic" && !kinematic) || keyword.has("RATE") || points.empty() ||
      points.size() > 2)
    material.refusal = "*PLASTIC is read of one or two points, isotropic or kinematic, without RATE; give these";
  if (points.empty()) return;
  material.kind = Material::Kind::plastic;
  material.yield_stress = points[0][0];
  material.hardening_beta = kinematic ? 0 : 1;
  if (points.size() < 2) return;
  const double slope = (points[1][0] - points[0][0]) / (points[1][1] - points[0][1]);
  if (!std::isfinite(slope) || slope < 0) fail(keyword.place, "the yield stress must grow with the plastic strain");
  material.tangent_modulus = slope;  // made one of total strain in finish(), where E is known
  report.add(
      Fate::replaced, source(keyword),
      fmt::format("it hardens as a straight line, and goes on to do so beyond a plastic strain of {}", points[1][1]));
}

void AbaqusDeckReader::read_material_data(const AbaqusKeyword& keyword) {
  if (material_ == 0)
    fail(keyword.place, fmt::format("*{} stands outside of a *MATERIAL; put it behind one", keyword.name));
  Material& material = deck.materials[material_];
  if (keyword.name == "PLASTIC") return read_plastic(keyword);
  if (keyword.name == "DAMPING") {
    skip();
    const auto value = [&](const char* key) { return keyword.has(key) ? real(keyword.parameters.at(key), key) : 0.0; };
    mass_damping_[material_] = value("ALPHA");
    stiffness_damping_[material_] = value("BETA");
    return;
  }
  if (!lines.has_data()) fail(keyword.place, fmt::format("*{} has no data; write them in the next line", keyword.name));
  const auto fields = lines.take_fields();
  if (keyword.name == "DENSITY") {
    material.density = real(fields[0], "density");
  } else {
    const std::string type = keyword.value("TYPE");
    if (!type.empty() && type != "isotropic") material.refusal = "*ELASTIC is read of TYPE=ISOTROPIC alone; give that";
    material.youngs_modulus = real(fields[0], "Young's modulus");
    material.poissons_ratio = fields.size() > 1 ? real(fields[1], "Poisson's ratio") : 0;
  }
  if (lines.has_data()) material.refusal = fmt::format("*{} depends on something: give one line", keyword.name);
  skip();
}

void AbaqusDeckReader::read_section(const AbaqusKeyword& keyword) {
  const std::string set = keyword.value("ELSET"), material = keyword.value("MATERIAL");
  skip();
  const Number number = number_of("section", set);
  Part& part = deck.parts[number];
  part.source = source(keyword);
  part.title = set;
  part.section = 1;
  part.material = number_of("material", material);
  deck.sections[1].kind = Section::Kind::solid;
  deck.sections[1].source = source(keyword);
  for (const int e : elements(set)) deck.element_parts[e] = number;
}

void AbaqusDeckReader::read_amplitude(const AbaqusKeyword& keyword) {
  const std::string name = keyword.value("NAME"), kind = keyword.value("DEFINITION");
  std::vector<double> values;
  while (lines.has_data())
    for (const auto field : lines.take_fields()) values.push_back(real(field, "time or amplitude"));
  Curve curve;
  curve.source = source(keyword);
  curve.title = name;
  const bool smooth = kind == "smoothstep" || kind == "smooth step";
  if ((!kind.empty() && kind != "tabular" && !smooth) || keyword.value("VALUE") == "absolute" ||
      keyword.has("SMOOTH")) {
    report.refuse(curve.source, "AMPLITUDE." + (kind.empty() ? std::string("VALUE") : kind),
                  "amplitudes are read of DEFINITION=TABULAR or SMOOTH STEP, relative and without SMOOTH");
    return;
  }
  constexpr int pieces = 32;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    if (i > 0 && !(values[i] > values[i - 2])) fail(keyword.place, "its times do not grow; put them in order");
    for (int k = 1; smooth && i > 0 && k < pieces; ++k) {
      const double x = static_cast<double>(k) / pieces;
      curve.points.push_back({values[i - 2] + x * (values[i] - values[i - 2]),
                              values[i - 1] + (values[i + 1] - values[i - 1]) * x * x * x * (10 + x * (6 * x - 15))});
    }
    curve.points.push_back({values[i], values[i + 1]});
  }
  if (curve.points.empty()) fail(keyword.place, "the amplitude has no points; write pairs of time and value");
  if (smooth) report.add(Fate::replaced, curve.source, "a smooth step, in 32 straight pieces");
  deck.curves[number_of("amplitude", name)] = curve;
}

void AbaqusDeckReader::read_friction(const AbaqusKeyword& keyword) {
  if (keyword.has("DEPENDENCIES") || keyword.has("EXPONENTIALDECAY") || keyword.has("ROUGH") || keyword.has("USER"))
    report.refuse(source(keyword), "FRICTION", "friction is read as one coefficient");
  if (lines.has_data()) friction_[interaction_] = real(lines.take_fields()[0], "coefficient of friction");
  skip();
}

void AbaqusDeckReader::read_pair(const AbaqusKeyword& keyword) {
  while (lines.has_data()) {
    std::vector<std::string> names;
    for (const auto field : lines.take_fields()) names.push_back(lower_case(field));
    if (names.size() < 2 || names[1].empty() || names[1] == names[0]) {
      report.refuse(here(keyword), "CONTACTPAIR.SELF", "a surface's contact with itself isn't here; name two surfaces");
      continue;
    }
    Contact contact;
    contact.source = here(keyword);
    contact.kind = Contact::Kind::nodes;
    contact.slave = {surface(names[0], lines.place()), 0};
    contact.master = {surface(names[1], lines.place()), 0};
    interactions_.emplace_back(deck.contacts.size(), keyword.value("INTERACTION"));
    deck.contacts.push_back(contact);
  }
}

void AbaqusDeckReader::read_inclusions(const AbaqusKeyword& keyword) {
  if (!keyword.has("ALLEXTERIOR")) {
    report.refuse(source(keyword), keyword.name, "general contact is read of ALL EXTERIOR; or name *CONTACT PAIR");
    return skip();
  }
  skip();
  Contact contact;
  contact.source = source(keyword);
  contact.kind = Contact::Kind::single;
  interactions_.emplace_back(deck.contacts.size(), "");
  deck.contacts.push_back(contact);
}

void AbaqusDeckReader::read_properties(const AbaqusKeyword& keyword) {
  while (lines.has_data()) {
    const auto fields = lines.take_fields();
    const bool everywhere = fields.size() > 2 && fields[0].empty() && fields[1].empty();
    if (!everywhere)
      report.refuse(here(keyword), keyword.name, "properties of some surfaces of a general contact aren't read");
    else
      for (auto& [contact, name] : interactions_)
        if (deck.contacts[contact].kind == Contact::Kind::single) name = lower_case(fields[2]);
  }
}

void AbaqusDeckReader::read_tie(const AbaqusKeyword& keyword) {
  while (lines.has_data()) {
    std::vector<std::string> names;
    for (const auto field : lines.take_fields()) names.push_back(lower_case(field));
    if (names.size() < 2) fail(lines.place(), "a tie names two surfaces: slave, master");
    Contact contact;
    contact.source = here(keyword);
    contact.title = keyword.value("NAME");
    contact.kind = Contact::Kind::tied;
    contact.slave = {surface(names[0], lines.place()), 0};
    contact.master = {surface(names[1], lines.place()), 0};
    deck.contacts.push_back(contact);
  }
}

}  // namespace railwave::deck
