#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/conversion.hpp"
#include "mesh/vectors.hpp"

namespace railwave::deck {
namespace {

/// The name of a material's section, which is written when it is first asked for.
std::string write_material(Conversion& conversion, Number number) {
  std::string& name = conversion.materials[number];
  if (!name.empty()) return name;
  const Material& material = conversion.deck.materials.at(number);
  name = conversion.bodies.new_name(material.title, fmt::format("material_{}", number));
  const Units& units = conversion.units;
  CaseText& text = conversion.text;
  text.section("materials." + name);
  text.key("youngs_modulus", material.youngs_modulus * units.pressure());
  text.key("poissons_ratio", material.poissons_ratio);
  text.key("density", material.density * units.density());
  if (material.kind == Material::Kind::plastic) {
    text.key("yield_stress", material.yield_stress * units.pressure());
    text.key("tangent_modulus", material.tangent_modulus * units.pressure());
    text.key("hardening_beta", material.hardening_beta);
  }
  conversion.report.add(Fate::taken, material.source, fmt::format("[materials.{}]", name));
  return name;
}

void write_part(Conversion& conversion, const Body& body, const std::string& material) {
  const Units& units = conversion.units;
  const Settings& settings = body.settings;
  CaseText& text = conversion.text;
  text.section("parts." + body.name);
  text.key("mesh", toml(std::string("deck")));
  text.key("element_set", toml(body.element_set));
  text.key("material", toml(material));
  text.key("hourglass", toml(std::string(settings.stiffness ? "stiffness" : "viscous")));
  text.key("hourglass_coefficient", settings.hourglass);
  text.key("linear_bulk_viscosity", settings.linear);
  text.key("quadratic_bulk_viscosity", settings.quadratic);
  if (settings.mass_damping > 0) text.key("mass_damping", settings.mass_damping / units.time);
  if (settings.stiffness_damping > 0) text.key("stiffness_damping", settings.stiffness_damping * units.time);
}

/// Whether a node's displacements are all held by *BOUNDARY_SPC or its own codes, along the global axes or others.
void hold_points(Conversion& conversion) {
  for (const Constraint& constraint : conversion.deck.constraints)
    for (const int n : conversion.members(constraint.nodes, constraint.source)) {
      const auto point = conversion.points.find(n);
      if (point == conversion.points.end()) continue;
      for (int i = 0; i < 6; ++i) point->second.held[i] = point->second.held[i] || constraint.fixed[i];
    }
}

}  // namespace

void write_bodies(Conversion& conversion) {
  for (const Body& body : conversion.bodies.all()) {
    write_material(conversion, body.settings.material);
    if (conversion.deck.materials.at(body.settings.material).kind == Material::Kind::plastic)
      conversion.plastic.push_back(body.name);
  }
  CaseText& text = conversion.text;
  text.section("meshes.deck");
  text.key("type", toml(std::string("file")));
  text.key("path", toml(conversion.mesh_file));
  text.key("scale", conversion.units.length);
  for (const Body& body : conversion.bodies.all())
    write_part(conversion, body, write_material(conversion, body.settings.material));
}

void write_points(Conversion& conversion) {
  const Deck& deck = conversion.deck;
  const auto add = [&](Number number, const Source& source) -> Point* {
    const int n = conversion.node(number, source);
    if (conversion.bodies.of_node(n) >= 0) return nullptr;
    Point& point = conversion.points[n];
    if (point.name.empty()) {
      point.name = conversion.bodies.new_name("", fmt::format("node_{}", number));
      point.source = source;
    }
    return &point;
  };
  for (const Beam& beam : deck.beams)
    for (const int end : {0, 1})
      if (Point* point = add(beam.nodes[end], beam.source)) point->beam = true;
  for (const Discrete& one : deck.discretes)
    for (const Number number : one.nodes)
      if (number > 0) add(number, one.source);
  for (const PointMass& mass : deck.masses) {
    if (Point* point = add(mass.node, mass.source)) {
      point->mass += mass.mass;
      conversion.report.add(Fate::taken, mass.source, fmt::format("[points.{}]", point->name));
    } else {
      conversion.report.refuse(mass.source, "ELEMENT_MASS",
                               fmt::format("mass {} sits on node {} of a hexahedron, where there are no point masses; "
                                           "raise the density there",
                                           mass.number, mass.node));
    }
  }
  hold_points(conversion);
  for (auto& [n, point] : conversion.points) {
    const bool held = point.held[0] && point.held[1] && point.held[2];
    point.ground = held && !point.beam && !(point.mass > 0);
    if (point.ground) continue;
    if (!(point.mass > 0) && !point.beam)
      conversion.report.refuse_always(
          point.source,
          fmt::format("node {} has no mass: it belongs to no hexahedron or beam, and is not held; give it an "
                      "*ELEMENT_MASS, or hold it in all directions",
                      deck.mesh.node_numbers()[n]));
    conversion.text.section("points." + point.name);
    conversion.text.key("mass", point.mass * conversion.units.mass);
    conversion.text.key("position", scaled(conversion.units.length, conversion.bodies.mesh().nodes[n]));
  }
}

void write_joints(Conversion& conversion) {
  for (const Joint& joint : conversion.bodies.joints()) {
    const Body &owner = conversion.bodies.all()[joint.owner], &tied = conversion.bodies.all()[joint.tied];
    const std::string name = fmt::format("{}_to_{}", tied.name, owner.name);
    conversion.text.section("ties." + name);
    conversion.text.key("slave", toml(conversion.mesh.surface(joint.tied, joint.tied_faces, "joint_" + owner.name)));
    conversion.text.key("master", toml(conversion.mesh.surface(joint.owner, joint.owner_faces, "joint_" + tied.name)));
    conversion.report.add(
        Fate::replaced, conversion.deck.parts.at(tied.parts.front()).source,
        fmt::format("the nodes that it shares with part {}, of another material, are two each, tied by "
                    "[ties.{}]",
                    owner.parts.front(), name));
  }
}

namespace {

const Section& section_of(const Conversion& conversion, Number part_number, const Source& source, Section::Kind kind,
                          const Part** part) {
  const auto found = conversion.deck.parts.find(part_number);
  if (found == conversion.deck.parts.end())
    conversion.fail(source, fmt::format("there is no part {}; define it, or mend the number", part_number));
  *part = &found->second;
  const auto section = conversion.deck.sections.find(found->second.section);
  if (section == conversion.deck.sections.end())
    conversion.fail(found->second.source, fmt::format("there is no section {} that is read", found->second.section));
  if (!section->second.refusal.empty()) conversion.fail(section->second.source, section->second.refusal);
  if (section->second.kind != kind)
    conversion.fail(section->second.source, "it is not a section of the elements that part has");
  conversion.report.use(section->second.source, "its elements");
  conversion.report.use(found->second.source, "its elements");
  return section->second;
}

const Material& law_of(const Conversion& conversion, const Part& part) {
  const auto found = conversion.deck.materials.find(part.material);
  if (found == conversion.deck.materials.end())
    conversion.fail(part.source, fmt::format("there is no material {} that is read", part.material));
  if (!found->second.refusal.empty()) conversion.fail(found->second.source, found->second.refusal);
  if (found->second.kind == Material::Kind::spring || found->second.kind == Material::Kind::damper)
    conversion.report.use(found->second.source, "stiffness or damping of connectors");
  return found->second;
}

/// The direction of a section's s axis: towards the third node, square to the beam.
std::optional<Vec3> orientation_of(const Conversion& conversion, const Beam& beam) {
  if (beam.nodes[2] == 0) return std::nullopt;
  const auto at = [&](int i) { return conversion.bodies.mesh().nodes[conversion.node(beam.nodes[i], beam.source)]; };
  const Vec3 along = difference(at(1), at(0)), towards = difference(at(2), at(0));
  const double share = dot(along, towards) / dot(along, along);
  const Vec3 across = difference(towards, scaled(share, along));
  if (!(length(across) > 1e-9 * length(towards))) return std::nullopt;
  return scaled(1 / length(across), across);
}

}  // namespace

void write_beams(Conversion& conversion) {
  const Units& units = conversion.units;
  for (const Beam& beam : conversion.deck.beams) {
    const Part* part = nullptr;
    const Section& section = section_of(conversion, beam.part, beam.source, Section::Kind::beam, &part);
    const Material& law = law_of(conversion, *part);
    if (law.kind != Material::Kind::elastic)
      conversion.report.refuse(law.source, law.source.keyword + ".BEAM",
                               "beams here are elastic whatever their material");
    const auto at = [&](int i) { return conversion.bodies.mesh().nodes[conversion.node(beam.nodes[i], beam.source)]; };
    if (!(length(difference(at(1), at(0))) > 0)) conversion.fail(beam.source, "the beam has no length; mend its nodes");
    const std::string material = write_material(conversion, part->material);
    CaseText& text = conversion.text;
    text.section(fmt::format("beams.beam_{}", beam.number));
    text.key("from", toml(conversion.node_name(conversion.node(beam.nodes[0], beam.source))));
    text.key("to", toml(conversion.node_name(conversion.node(beam.nodes[1], beam.source))));
    text.key("material", toml(material));
    text.key("section", toml(std::string(section.circle ? "circle" : "rectangle")));
    if (section.circle) {
      text.key("radius", section.outer / 2 * units.length);
    } else {
      text.key("height", section.outer * units.length);
      text.key("width", section.inner * units.length);
    }
    const auto orientation = orientation_of(conversion, beam);
    if (orientation) text.key("orientation", *orientation);
    if (!orientation && !section.circle)
      conversion.fail(beam.source, "a rectangular beam needs its third node, off its axis, for the direction of s");
  }
}

namespace {

/// The direction in which a discrete element acts.
Vec3 direction_of(const Conversion& conversion, const Discrete& one) {
  const Deck& deck = conversion.deck;
  const auto at = [&](Number n, const Source& by) { return conversion.bodies.mesh().nodes[conversion.node(n, by)]; };
  Vec3 direction{0, 0, 0};
  if (one.orientation != 0) {
    const auto found = deck.orientations.find(one.orientation);
    if (found == deck.orientations.end())
      conversion.fail(one.source, fmt::format("there is no *DEFINE_SD_ORIENTATION {}; define it", one.orientation));
    const Direction& given = found->second;
    conversion.report.use(given.source, "direction of connectors");
    if (given.option != 0 && given.option != 2)
      conversion.fail(given.source,
                      fmt::format("IOP {} isn't read, only 0 (a vector) and 2 (two nodes)", given.option));
    direction = given.option == 0 ? given.vector
                                  : difference(at(given.nodes[1], given.source), at(given.nodes[0], given.source));
  } else if (one.nodes[1] > 0) {
    direction = difference(at(one.nodes[1], one.source), at(one.nodes[0], one.source));
    conversion.report.add(Fate::replaced, one.source,
                          "it acts along the line that its nodes make at the start, which does not turn with them");
  }
  if (!(length(direction) > 0))
    conversion.fail(one.source,
                    "it has no direction: its ends are at one place; give it a *DEFINE_SD_ORIENTATION (VID)");
  return scaled(1 / length(direction), direction);
}

std::string axes_text(const Vec3& first) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::fabs(first[i]) < std::fabs(first[least])) least = i;
  Vec3 other{0, 0, 0};
  other[least] = 1;
  Vec3 third = cross(first, other);
  third = scaled(1 / length(third), third);
  return fmt::format("[{}, {}, {}]", toml(first), toml(cross(third, first)), toml(third));
}

}  // namespace

void write_connectors(Conversion& conversion) {
  const Units& units = conversion.units;
  for (const Discrete& one : conversion.deck.discretes) {
    const Part* part = nullptr;
    section_of(conversion, one.part, one.source, Section::Kind::discrete, &part);
    const Material& law = law_of(conversion, *part);
    const bool spring = law.kind == Material::Kind::spring;
    if (!spring && law.kind != Material::Kind::damper)
      conversion.fail(law.source,
                      "discrete elements have *MAT_SPRING_ELASTIC or *MAT_DAMPER_VISCOUS; give one of these");
    if (one.offset != 0)
      conversion.report.refuse(one.source, "ELEMENT_DISCRETE.OFFSET", "an initial offset isn't read");
    const auto end = [&](Number number) -> std::string {
      if (number == 0) return "ground";
      const int n = conversion.node(number, one.source);
      const auto point = conversion.points.find(n);
      return point != conversion.points.end() && point->second.ground ? "ground" : conversion.node_name(n);
    };
    const std::string from = end(one.nodes[0]), to = end(one.nodes[1]);
    if (from == to) conversion.fail(one.source, "both ends are held, or one node; it has no effect: take it out");
    CaseText& text = conversion.text;
    text.section(fmt::format("connectors.discrete_{}", one.number));
    text.key("from", toml(from));
    text.key("to", toml(to));
    const double value = law.coefficient * one.scale * units.force() / units.length * (spring ? 1 : units.time);
    text.key(spring ? "stiffness" : "damping", Vec3{value, 0, 0});
    text.key("axes", axes_text(direction_of(conversion, one)));
  }
}

}  // namespace railwave::deck
