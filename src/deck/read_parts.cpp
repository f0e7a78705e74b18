#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "deck/deck_reader.hpp"

namespace railwave::deck {
namespace {

using Kind = DynaScope::Kind;

template <class Map, class Thing>
void define(Call& call, Map& map, Number number, const char* what, Thing thing) {
  const auto place = thing.source.place;
  const auto [entry, is_new] = map.emplace(number, std::move(thing));
  if (!is_new)
    call.reader.fail(place, fmt::format("{} {} is defined again (first at {}); give each its own number", what, number,
                                        call.reader.lines.where(entry->second.source.place)));
}

void read_part(Call& call) {
  while (call.cards.left()) {
    const std::string title = call.cards.title();
    if (!call.cards.left() && title.empty()) return;
    const DynaCard card = call.cards.take();
    Part part;
    part.source = call.cards.source(card);
    part.title = title;
    const Number number = call.number(card, 0, "PID", Kind::part);
    part.section = call.number(card, 1, "SECID", Kind::other);
    part.material = call.number(card, 2, "MID", Kind::material);
    part.hourglass = call.number(card, 4, "HGID", Kind::other);
    if (card.whole(3, "EOSID") != 0)
      call.reader.report.refuse(part.source, "PART.EOSID", "the part has an equation of state, which isn't read");
    define(call, call.reader.deck.parts, number, "part", part);
  }
}

/// Each section with source, number and kind; fill(section, card) does the rest.
template <class Fill>
void read_sections(Call& call, Section::Kind kind, const Fill& fill) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Section section;
    section.source = call.cards.source(card);
    section.kind = kind;
    fill(section, card);
    define(call, call.reader.deck.sections, call.number(card, 0, "SECID", Kind::other), "section", section);
  }
}

void read_solid_section(Call& call) {
  read_sections(call, Section::Kind::solid, [&](Section& section, const DynaCard& card) {
    section.formulation = card.whole(1, "ELFORM");
    const Number form = section.formulation;
    const Number known[] = {-18, -2, -1, 0, 1, 2, 3, 9, 18};
    if (std::find(std::begin(known), std::end(known), form) == std::end(known))
      section.refusal = fmt::format("ELFORM {} is no hexahedron of a Lagrangian solid; take ELFORM 1", form);
  });
}

/// A circle of that area and moments, if it is one.
bool is_circle(double area, double moment, double other_moment, double polar) {
  constexpr double pi = 3.14159265358979323846, close = 0.02;
  const double expected = area * area / (4 * pi);
  return std::fabs(moment / expected - 1) < close && std::fabs(other_moment / expected - 1) < close &&
         std::fabs(polar / (2 * expected) - 1) < close;
}

void read_beam_section(Call& call) {
  read_sections(call, Section::Kind::beam, [&](Section& section, const DynaCard& card) {
    section.formulation = card.whole(1, "ELFORM");
    const Number shape = card.whole(4, "CST");
    const DynaCard second = call.cards.take();
    if (section.formulation <= 1) {
      section.circle = shape == 1;
      section.outer = second.real(0, "TS1");
      section.inner = second.real(2, "TT1");
      const bool tapered = second.real(1, "TS2", section.outer) != section.outer ||
                           second.real(3, "TT2", section.inner) != section.inner;
      if (shape > 1) section.refusal = "CST is neither 0 (rectangle) nor 1 (tube)";
      if (section.circle && section.inner != 0) section.refusal = "a hollow tube isn't read, only full circles";
      if (tapered) section.refusal = "the section differs at both ends";
      if (!(section.outer > 0) || (!section.circle && !(section.inner > 0)))
        section.refusal = "it has no thickness; write TS1 and TT1";
    } else if (section.formulation == 2) {
      const double area = second.real(0, "A");
      section.circle = true;
      section.outer = std::sqrt(4 * std::fmax(area, 0) / 3.14159265358979323846);
      if (!is_circle(area, second.real(1, "ISS"), second.real(2, "ITT"), second.real(3, "J")))
        section.refusal =
            "its area and moments are not those of a full circle, the only ones that are read of ELFORM 2";
    } else {
      section.refusal = fmt::format("ELFORM {} is no Hughes-Liu (1) or resultant (2) beam", section.formulation);
    }
  });
}

void read_discrete_section(Call& call) {
  read_sections(call, Section::Kind::discrete, [&](Section& section, const DynaCard& card) {
    if (card.whole(1, "DRO") != 0) section.refusal = "torsional springs (DRO 1) aren't read";
    for (int i = 2; i < 6; ++i)
      if (card.real(i, "KD, V0, CL or FD") != 0)
        section.refusal = "KD, V0, CL and FD (stiffening with speed, clearance, failure) aren't read";
    if (call.cards.left()) {
      const DynaCard second = call.cards.take();
      if (second.real(0, "CDL") != 0 || second.real(1, "TDL") != 0) section.refusal = "deflection limits aren't read";
    }
  });
}

/// Sections of other elements only count where a part of hexahedra has them.
void read_other_section(Call& call) {
  if (call.titled) call.cards.title();
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  Section section;
  section.source = call.cards.source(card);
  section.refusal = fmt::format("*{} is no section of hexahedra, beams or discrete elements", call.name);
  call.reader.deck.sections.emplace(call.number(card, 0, "SECID", Kind::other), section);
}

Material begin_material(Call& call, const std::string& title, const DynaCard& card) {
  Material material;
  material.source = call.cards.source(card);
  material.title = title;
  return material;
}

void add_refusal(Material& material, const std::string& key, const std::string& text) {
  material.more.push_back({text, key});
}

/// Each material with density and elasticity; fill(material, card) does the rest.
template <class Fill>
void read_solid_materials(Call& call, Material::Kind kind, const Fill& fill) {
  while (call.more()) {
    const std::string title = call.titled ? call.cards.title() : "";
    const DynaCard card = call.cards.take();
    Material material = begin_material(call, title, card);
    material.kind = kind;
    material.density = card.real(1, "RO");
    material.youngs_modulus = card.real(2, "E");
    material.poissons_ratio = card.real(3, "PR");
    fill(material, card);
    define(call, call.reader.deck.materials, call.number(card, 0, "MID", Kind::material), "material", material);
  }
}

void read_elastic(Call& call) {
  read_solid_materials(call, Material::Kind::elastic, [&](Material& material, const DynaCard& card) {
    if (card.real(4, "DA") != 0 || card.real(5, "DB") != 0)
      add_refusal(material, "MAT_ELASTIC.DA", "DA and DB, the damping of beams, aren't read");
  });
}

void read_kinematic(Call& call) {
  read_solid_materials(call, Material::Kind::plastic, [&](Material& material, const DynaCard& card) {
    material.yield_stress = card.real(4, "SIGY");
    material.tangent_modulus = card.real(5, "ETAN");
    material.hardening_beta = card.real(6, "BETA");
    if (call.cards.left()) {
      const DynaCard second = call.cards.take();
      if (second.real(0, "SRC") != 0)
        add_refusal(material, "MAT_PLASTIC_KINEMATIC.SRC",
                    "SRC makes the yield stress grow with the strain rate, which "
                    "materials here don't");
      const double failure = second.real(2, "FS");
      if (failure > 0 && failure < 1e10)
        add_refusal(material, "MAT_PLASTIC_KINEMATIC.FS", "FS makes elements fail, which they don't here");
    }
  });
}

void read_piecewise(Call& call) {
  read_solid_materials(call, Material::Kind::plastic, [&](Material& material, const DynaCard& card) {
    material.yield_stress = card.real(4, "SIGY");
    material.tangent_modulus = card.real(5, "ETAN");
    const std::string name = "MAT_PIECEWISE_LINEAR_PLASTICITY";
    const double failure = card.real(6, "FAIL");
    if ((failure != 0 && std::fabs(failure) < 1e10) || card.real(7, "TDEL") != 0)
      add_refusal(material, name + ".FAIL", "FAIL or TDEL makes elements fail, which they don't here");
    bool curve = false, rate = false;
    if (call.cards.left()) {
      const DynaCard second = call.cards.take();
      rate = second.real(0, "C") != 0 || second.whole(3, "LCSR") != 0;
      curve = second.whole(2, "LCSS") != 0;
    }
    for (int i = 0; i < 2 && call.cards.left(); ++i) {
      const DynaCard points = call.cards.take();
      for (int k = 0; k < 8; ++k) curve = curve || points.real(k, "EPS or ES") != 0;
    }
    if (rate)
      add_refusal(material, name + ".C",
                  "C or LCSR makes the yield stress depend on the strain rate, which materials "
                  "here don't");
    if (curve) {
      material.refusal =
          "its hardening is a curve; give SIGY and ETAN (and no curve), or *MAT_PLASTIC_KINEMATIC, which is taken";
    }
  });
}

template <Material::Kind kind>
void read_connector_law(Call& call) {
  while (call.more()) {
    const std::string title = call.titled ? call.cards.title() : "";
    const DynaCard card = call.cards.take();
    Material material = begin_material(call, title, card);
    material.kind = kind;
    material.coefficient = card.real(1, kind == Material::Kind::spring ? "K" : "DC");
    define(call, call.reader.deck.materials, call.number(card, 0, "MID", Kind::material), "material", material);
  }
}

void read_hourglass(Call& call) {
  while (call.more()) {
    if (call.titled) call.cards.title();
    const DynaCard card = call.cards.take();
    Hourglass hourglass;
    hourglass.source = call.cards.source(card);
    hourglass.type = card.whole(1, "IHQ");
    hourglass.coefficient = card.real(2, "QM");
    hourglass.quadratic = card.real(4, "Q1");
    hourglass.linear = card.real(5, "Q2");
    define(call, call.reader.deck.hourglass, call.number(card, 0, "HGID", Kind::other), "hourglass control", hourglass);
  }
}

}  // namespace

void read_other_material(Call& call) {
  const std::string title = call.titled ? call.cards.title() : "";
  if (!call.cards.more()) return;
  const DynaCard card = call.cards.take();
  Material material = begin_material(call, title, card);
  const bool rigid = call.name == "MAT_RIGID" || call.name == "MAT_020" || call.name == "MAT_20";
  material.refusal =
      rigid ? "there are no rigid bodies here; give the part *MAT_ELASTIC with its true stiffness, hold it by "
              "*BOUNDARY_SPC_SET or move a set of its nodes by *BOUNDARY_PRESCRIBED_MOTION_SET"
            : "this law isn't here; take *MAT_ELASTIC, *MAT_PLASTIC_KINEMATIC or *MAT_PIECEWISE_LINEAR_PLASTICITY "
              "without a curve";
  call.reader.deck.materials.emplace(call.number(card, 0, "MID", Kind::material), material);
}

const std::vector<HandlerEntry>& part_handlers() {
  static const std::vector<HandlerEntry> all = {{"PART", read_part},
                                                {"SECTION_SOLID", read_solid_section},
                                                {"SECTION_BEAM", read_beam_section},
                                                {"SECTION_DISCRETE", read_discrete_section},
                                                {"SECTION_SHELL", read_other_section},
                                                {"SECTION_TSHELL", read_other_section},
                                                {"SECTION_POINT_SOURCE", read_other_section},
                                                {"SECTION_SPH", read_other_section},
                                                {"SECTION_SEATBELT", read_other_section},
                                                {"MAT_ELASTIC", read_elastic},
                                                {"MAT_001", read_elastic},
                                                {"MAT_1", read_elastic},
                                                {"MAT_PLASTIC_KINEMATIC", read_kinematic},
                                                {"MAT_003", read_kinematic},
                                                {"MAT_3", read_kinematic},
                                                {"MAT_PIECEWISE_LINEAR_PLASTICITY", read_piecewise},
                                                {"MAT_024", read_piecewise},
                                                {"MAT_24", read_piecewise},
                                                {"MAT_SPRING_ELASTIC", read_connector_law<Material::Kind::spring>},
                                                {"MAT_S01", read_connector_law<Material::Kind::spring>},
                                                {"MAT_DAMPER_VISCOUS", read_connector_law<Material::Kind::damper>},
                                                {"MAT_S02", read_connector_law<Material::Kind::damper>},
                                                {"HOURGLASS", read_hourglass}};
  return all;
}

}  // namespace railwave::deck
