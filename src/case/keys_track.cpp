#include "case/keys.hpp"
#include "case/keys_rail.hpp"
#include "case/rules.hpp"

// What a track is made of: sets by place, sleepers with their fastening and ballast, and the track itself.
namespace railwave::case_file {

using scene::Scene;

Section node_set_section() {
  using scene::NodeSet;
  auto section =
      named_section("node_sets", "node set", &Scene::node_sets,
                    "Nodes of a part picked by where they are; the set is `part.NAME`, with the part given here.");
  section.keys = {
      key("part", &NodeSet::part, "whose nodes").names(whole_part).needed(),
      key("box", &NodeSet::box,
          "where they are, in the scene's axes with the part at its `position`, before any `close_gap`; the sides "
          "count as inside; it may be as large as you like")
          .in("m")
          .within(between(-1e9, 1e9))
          .otherwise("none: give `position`"),
      key("position", &NodeSet::position, "instead of a box: nodes near this place, in the same axes")
          .in("m")
          .otherwise("none: give `box`"),
      key("radius", &NodeSet::radius, "how near; the nearest node is in the set however far it is")
          .in("m")
          .within(at_least(0)),
      key("surface", &NodeSet::surface,
          "only nodes of this surface of the part, such as z_max; its faces with all four nodes in the set are a "
          "surface of the set's name too")
          .otherwise("nodes inside count too"),
  };
  section.rule = check_node_set;
  return section;
}

Section sleeper_section() {
  using scene::Sleeper;
  auto section = named_section("sleepers", "kind of sleeper", &Scene::sleepers,
                               "Kinds of sleepers for tracks, each with its fastening and ballast. The kinds "
                               "`concrete` and `timber` are there without a section, "
                               "as below; materials, stiffness and damping are those of the thesis's table 4.1, "
                               "dimensions and longitudinal values are not in it and are ours. "
                               "Values are those of half a sleeper, from the track's centre plane outwards; tracks "
                               "with both_rails have whole ones.");
  const auto length = [](auto name, auto field, auto help) { return key(name, field, help).in("m").within(above(0)); };
  section.keys = {
      key("base", &Sleeper::base, "what all that isn't given here is taken from")
          .one_of({"concrete", "timber"})
          .otherwise("concrete; of the kind timber, timber"),
      key("material", &Sleeper::material, "its material")
          .names(material)
          .otherwise("concrete: E 38.4 GPa, nu 0.2, 2520 kg/m3; timber: E 20 GPa, nu 0.3, 1300 kg/m3"),
      length("half_length", &Sleeper::half_length, "from the track's centre plane outwards")
          .within(between(0.3, 5))
          .otherwise("concrete 1.26, timber 1.3"),
      length("width", &Sleeper::width, "along the track").within(between(0.02, 2)).otherwise("0.25"),
      length("height", &Sleeper::height, "from underside to top")
          .within(between(0.02, 1))
          .otherwise("concrete 0.18, timber 0.15"),
      key("divisions", &Sleeper::divisions, "elements along x, y, z").within(between(1, 1000)).otherwise("[3, 14, 2]"),
      length("pad_thickness", &Sleeper::pad_thickness, "from the sleeper's top to the middle of the rail's foot")
          .within(between(1e-4, 0.1))
          .otherwise("0.007"),
      length("pad_length", &Sleeper::pad_length,
             "of the fastening's area along the rail; across it is as wide as the foot")
          .within(between(0.01, 2))
          .otherwise("0.16"),
      key("fastening_stiffness", &Sleeper::fastening_stiffness, "between foot and sleeper, along x, y, z, in all")
          .in("N/m")
          .within(at_least(0))
          .mostly(between(1e4, 1e12))
          .otherwise("concrete [100e6, 100e6, 195e6], timber [150e6, 150e6, 86.7e6]"),
      key("fastening_damping", &Sleeper::fastening_damping, "the same of dashpots")
          .in("N s/m")
          .within(at_least(0))
          .otherwise("concrete [40e3, 40e3, 67.5e3], timber [40e3, 40e3, 45e3]"),
      key("fastening_spread", &Sleeper::fastening_spread, "cells along and across the rail over which it is spread")
          .within(between(1, 100)),
      key("pad", &Sleeper::pad,
          "springs: springs and dashpots between foot and sleeper. solid: bodies `NAME_pad_1` ... there, tied to "
          "both, of the vertical fastening_stiffness; connectors have what the pad's shear lacks of the horizontal "
          "one, and what its damping lacks")
          .one_of({"springs", "solid"}),
      key("pad_modulus", &Sleeper::pad_modulus,
          "Young's modulus of the pad; fastening_stiffness and fastening_damping are then those of clips beside it, by "
          "default none")
          .in("Pa")
          .within(above(0))
          .otherwise("of the vertical fastening_stiffness"),
      key("pad_poissons_ratio", &Sleeper::pad_poissons_ratio, "its Poisson's ratio").within(between(0, 0.49)),
      key("pad_density", &Sleeper::pad_density, "its density").in("kg/m3").within(above(0)),
      key("pad_damping", &Sleeper::pad_damping,
          "its stiffness_damping; 0 leaves all damping to the connectors, and allows a longer step")
          .in("s")
          .within(between(0, 1))
          .mostly(between(0, 0.01))
          .otherwise("vertical fastening_damping over fastening_stiffness"),
      key("pad_layers", &Sleeper::pad_layers, "elements through its thickness").within(between(1, 100)),
      key("ballast_stiffness", &Sleeper::ballast_stiffness, "vertical, under the half sleeper in all")
          .in("N/m")
          .within(above(0))
          .mostly(between(1e5, 1e11))
          .otherwise("45e6"),
      key("ballast_damping", &Sleeper::ballast_damping, "the same of dashpots")
          .in("N s/m")
          .within(at_least(0))
          .otherwise("32e3"),
      key("ballast_lateral_stiffness", &Sleeper::ballast_lateral_stiffness, "the same along y")
          .in("N/m")
          .within(above(0))
          .otherwise("none; where both_rails, the middle of the underside is held along y"),
      key("ballast_lateral_damping", &Sleeper::ballast_lateral_damping, "the same of dashpots")
          .in("N s/m")
          .within(at_least(0))
          .otherwise("none"),
      key("ballast_spread", &Sleeper::ballast_spread, "cells along and across the track over which it is spread")
          .within(between(1, 100)),
  };
  section.rule = check_sleeper;
  return section;
}

namespace {

std::vector<Key> joint_keys() {
  using scene::Track;
  const auto length = [](auto name, auto field, auto help) { return key(name, field, help).in("m").within(above(0)); };
  return {
      key("fishplates", &Track::fishplates,
          "a joint at the gap: fishplates `NAME_fishplate_left` (towards -y) and `NAME_fishplate_right` over both "
          "rails, and bolts, beams `NAME_bolt_1` ..., from a point beyond one plate to one beyond the other, "
          "`NAME_bolt_1_left` and `NAME_bolt_1_right`; beams of the points' names spread each head over the nodes "
          "`bolt_1` of the plate. Bolts don't touch the web; plates have stiffness hourglass control"),
      key("fishplate_fit", &Track::fishplate_fit,
          "glued to the rails, or in contact; ties and contacts have the plates' names, behind the gap with _2")
          .one_of({"tie", "contact"}),
      key("fishplate_friction", &Track::fishplate_friction, "Coulomb coefficient of that contact").within(at_least(0)),
      key("fishplate_material", &Track::fishplate_material, "of the plates").names(material).otherwise("the rail's"),
      length("fishplate_length", &Track::fishplate_length, "along the rails, half of it before the gap's middle"),
      length("fishplate_thickness", &Track::fishplate_thickness, "beside the web where that is thinnest")
          .within(at_least(0.004)),
      key("fishplate_clearance", &Track::fishplate_clearance, "between web and plate; head and foot are touched")
          .in("m")
          .within(between(0, 0.003)),
      length("fishplate_size", &Track::fishplate_size, "of the plates' elements along x")
          .otherwise("three times zone_size, or zone_size where they reach the layers of that size under the head"),
      key("bolt_positions", &Track::bolt_positions, "of each bolt along x from the gap's middle").in("m"),
      key("bolt_height", &Track::bolt_height, "above the middle of the foot, along the rail's own axis")
          .in("m")
          .within(between(0.04, 0.11))
          .otherwise("the chamber's middle: 54E1 0.070, 60E1 0.076"),
      key("bolt_diameter", &Track::bolt_diameter, "of the shank").in("m").within(between(0.01, 0.04)),
      key("bolt_pretension", &Track::bolt_pretension, "force in each bolt, as of beams").in("N").within(at_least(0)),
  };
}

}  // namespace

Section track_section() {
  using scene::Track;
  auto section =
      named_section("tracks", "track", &Scene::tracks,
                    "Half a track: a rail on sleepers, symmetric about the track's centre plane; or, with both_rails, "
                    "a whole one. It becomes parts `NAME_rail` (and `NAME_rail_2` behind a gap), "
                    "`NAME_sleeper_1`, `NAME_sleeper_2` and so on along x, connectors `NAME_fastening_1` ... between "
                    "rail and sleeper and `NAME_ballast_1` ... between ground "
                    "and sleeper, and constraints: undersides held along x, the centre plane along y; thus the sleeper "
                    "bends as a whole one. Sets are those of meshes `rail` and `box`.");
  section.keys = {
      key("rail_material", &Track::rail_material, "the rail's material")
          .names(material)
          .otherwise("elastic: E 210 GPa, nu 0.3, 7800 kg/m3"),
      key("rail_stiffness_damping", &Track::rail_stiffness_damping, "the rails' stiffness_damping, see [parts.NAME]")
          .in("s")
          .within(at_least(0))
          .mostly(between(0, 0.01)),
      key("position", &Track::position, "where the track's own origin is put: z = 0 is the middle of the rail's foot")
          .in("m"),
      key("mirror", &Track::mirror,
          "the whole is mirrored at the plane y = 0 of its own origin: the other half of the track; sets keep their "
          "names"),
      key("both_rails", &Track::both_rails,
          "whole sleepers on whole beds of ballast, and the other rail too, mirrored at the centre plane: its parts, "
          "connectors and so on are `NAME_far_rail`, `NAME_far_fastening_1` and so on. The middle of each sleeper's "
          "underside is held along y, unless the ballast has a lateral stiffness"),
      key("hourglass", &Track::hourglass,
          "how hourglass modes of rails and sleepers are resisted; plates and pads have stiffness in any case")
          .one_of({"viscous", "stiffness"}),
      key("rail_distance", &Track::rail_distance,
          "from the middle of the rail's foot to the track's centre plane, which lies where the rail leans: towards "
          "-y unless the inclination is negative, or the track mirrored")
          .in("m")
          .within(above(0)),
      key("sleeper", &Track::sleeper, "kind of the regular sleepers").names(sleeper),
      key("pitch", &Track::pitch, "distance of regular sleepers").in("m").within(at_least(0.2)).mostly(between(0.2, 3)),
      key("first_sleeper", &Track::first_sleeper, "x of the first of them")
          .in("m")
          .otherwise("half a pitch from the rail's start"),
      key("positions", &Track::positions, "x of each of them, instead of pitch and first_sleeper")
          .in("m")
          .otherwise("by pitch"),
      key("other_sleeper", &Track::other_sleeper, "kind of the other sleepers: at a joint").names(sleeper),
      key("other_positions", &Track::other_positions, "x of each of them").in("m").otherwise("none"),
      key("pair_position", &Track::pair_position,
          "x of the middle of a pair of other sleepers; the regular ones go on by pitch from both")
          .in("m")
          .otherwise("no pair"),
      key("pair_distance", &Track::pair_distance, "distance of the two").in("m").within(above(0)),
      key("gap_position", &Track::gap_position,
          "x of the middle of a gap, at which one rail ends and another begins, both free")
          .in("m")
          .otherwise("one rail"),
      key("gap", &Track::gap, "its width").in("m").within(above(0)),
  };
  for (auto& one : joint_keys()) section.keys.push_back(std::move(one));
  for (auto& one : rail_keys(&Track::rail)) {
    const bool length = one.name == "start" || one.name == "end";
    section.keys.push_back(length ? std::move(one).needed() : std::move(one));
  }
  section.rule = check_track;
  return section;
}

}  // namespace railwave::case_file
