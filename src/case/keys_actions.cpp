#include "case/keys.hpp"
#include "case/rules.hpp"

// What acts on the bodies: connectors, constraints, contacts, loads, gravity, initial motion.
namespace railwave::case_file {

using scene::Scene;

Section connector_section() {
  using scene::Connector;
  auto section = named_section("connectors", "connector", &Scene::connectors,
                               "Linear springs and dashpots side by side, between the mean motions of two node sets or "
                               "points, or spread over an area.");
  section.keys = {
      key("from", &Connector::from, "one end").names(node_set | point | ground).needed(),
      key("to", &Connector::to, "the other end").names(node_set | point | ground).needed(),
      key("stiffness", &Connector::stiffness, "spring stiffness along each of the axes").in("N/m").within(at_least(0)),
      key("damping", &Connector::damping, "dashpot coefficient along each of the axes").in("N s/m").within(at_least(0)),
      key("preload", &Connector::preload,
          "force on `to` when nothing has moved yet, along the scene's x, y, z whatever `axes`")
          .in("N"),
      key("axes", &Connector::axes, "the three directions, each a unit vector"),
      key("spread", &Connector::spread,
          "cells along the first and the second of the axes, over the area in which the ends face each other along "
          "the third; the ends are surfaces then (or ground), stiffness, damping and preload are totals of which "
          "each cell has an equal share, between the means over the cell of both surfaces' motions, so that "
          "rotations are resisted too")
          .within(between(1, 1000))
          .otherwise("one, between the mean motions by mass of the ends"),
      key("area", &Connector::area, "bounds of that area").in("m").otherwise("where the ends overlap"),
  };
  section.rule = check_connector;
  return section;
}

Section constraint_section() {
  using scene::Constraint;
  auto section = named_section("constraints", "constraint", &Scene::constraints,
                               "Directions in which the nodes of a set don't move or turn.");
  section.keys = {
      key("target", &Constraint::target, "what is held").names(node_set | point).needed(),
      key("fixed", &Constraint::fixed, "held directions: along the first, second, third of the axes").otherwise("none"),
      key("fixed_rotation", &Constraint::fixed_rotation, "axes about which nodes where beams end do not turn")
          .otherwise("none"),
      key("axes", &Constraint::axes, "what x, y and z mean here: three unit vectors"),
  };
  section.rule = check_constraint;
  return section;
}

Section contact_section() {
  using scene::Contact;
  auto section = named_section("contacts", "contact", &Scene::contacts,
                               "Pairs of surfaces that may touch, with Coulomb friction.");
  section.keys = {
      key("slave", &Contact::slave, "surface whose nodes must not enter the other").names(surface).needed(),
      key("master", &Contact::master,
          "surface whose faces the nodes meet; a list of several, such as the heads of two rails, is one surface and "
          "one contact")
          .names(surface)
          .or_one()
          .needed(),
      key("friction", &Contact::friction,
          "Coulomb's coefficient; 0 leaves friction out; with friction_decay the one at rest")
          .within(between(0, 2)),
      key("dynamic_friction", &Contact::dynamic_friction,
          "coefficient at high sliding speed; at a speed v it is dynamic_friction + (friction - dynamic_friction) "
          "exp(-friction_decay v)")
          .within(between(0, 2))
          .otherwise("friction does not depend on speed"),
      key("friction_decay", &Contact::friction_decay, "how fast friction falls from `friction` to `dynamic_friction`")
          .in("s/m")
          .within(at_least(0)),
      key("friction_memory", &Contact::friction_memory,
          "of falling friction: the speed that counts is that of the sliding velocity's mean over the past, weighted "
          "by exp(-t/friction_memory); 0: the present speed, at which nodes stick and slip in turn (docs/contact.md)")
          .in("s")
          .within(between(0, 1)),
      key("algorithm", &Contact::algorithm,
          "`penalty`: springs where nodes penetrate; `multiplier`: the forces with which no node penetrates at the "
          "next step, nor slips where friction holds it; `automatic`: multipliers, but springs where the scene has "
          "what only these go with (docs/contact.md)")
          .one_of({"penalty", "multiplier", "automatic"}),
      key("normals", &Contact::normals,
          "`facet`: each face of the master is as its nodes make it and presses along its own normal; `smooth`: it "
          "is curved such that the normal is continuous, at nodes the mean of the faces around; faces that meet at "
          "more than 30 degrees keep their edge")
          .one_of({"facet", "smooth"}),
      key("sweeps", &Contact::sweeps,
          "iterations of the multipliers in a step; the residual is corrected in the next step; where several "
          "contacts give it, the largest number counts for all")
          .within(between(2, 100)),
      key("penalty_scale", &Contact::penalty_scale, "multiplies the penalty stiffness")
          .within(between(1e-6, 1e6))
          .mostly(between(1e-3, 100)),
      key("penalty_growth", &Contact::penalty_growth,
          "pairs [penetration in m, factor on the penalty's stiffness there], with increasing penetration; straight "
          "lines between, constant before and after; the force is the integral")
          .pairs_of({"penetration in m", "factor", between(0, 1), between(1e-6, 1e6)})
          .otherwise("the penalty is linear"),
      key("damping", &Contact::damping,
          "share of the critical damping of a contact spring and the masses that it joins; 0.1 keeps what slides for "
          "long on springs from chattering (docs/contact.md)")
          .within(between(0, 1)),
      key("symmetric", &Contact::symmetric,
          "the master's nodes against the slave's faces as well, each with half the stiffness; neither surface then "
          "cuts into the other"),
      key("bridged_gap", &Contact::bridged_gap,
          "cracks, slots and gaps between faces of the master that are no wider are crossed: what slides or rolls "
          "over one presses on the nearer side as if that went on")
          .in("m")
          .within(at_least(0))
          .otherwise("one face of the slave, of its smallest ones; or four of them, but not over 1 mm"),
      key("close_gap", &Contact::close_gap,
          "before the run, the slave's part is moved along this direction until it first touches")
          .direction()
          .otherwise("it stays where it is"),
      key("zone_lateral_start", &Contact::zone_lateral_start,
          "for meshes with zone = \"contact\": how far along y from its place the wheel is when it is farthest to one "
          "side; the band covers all places where the profiles meet from there to zone_lateral_end")
          .in("m")
          .within(between(-0.1, 0.1)),
      key("zone_lateral_end", &Contact::zone_lateral_end, "the same to the other side")
          .in("m")
          .within(between(-0.1, 0.1)),
      key("zone_roll", &Contact::zone_roll, "for the same: of the axle about x, positive where it rises towards +y")
          .in("rad")
          .within(between(-0.2, 0.2)),
      key("zone_margin", &Contact::zone_margin,
          "for the same: how far the band goes on beyond where the profiles come within 0.06 mm of each other; half a "
          "patch and what the bodies give way")
          .in("m")
          .within(between(0, 0.05)),
  };
  section.rule = check_contact;
  return section;
}

Section curve_section() {
  using scene::Curve;
  auto section = named_section("curves", "curve", &Scene::curves, "Factors that change with time, for loads.");
  section.keys = {
      key("type", &Curve::type,
          "its shape; `constant` is 1 at all times; `half_sine` is a blow: half a sine wave from 0 to 1 and back")
          .one_of({"constant", "cosine_ramp", "table", "half_sine"})
          .needed(),
      key("start", &Curve::start, "when the ramp, or the blow, begins: 0 before")
          .in("s")
          .only({"cosine_ramp", "half_sine"}),
      key("duration", &Curve::duration, "how long it rises from 0 to 1, as half a cosine wave")
          .in("s")
          .within(above(0))
          .needed()
          .only({"cosine_ramp"}),
      key("duration", &Curve::duration,
          "how long the blow lasts; its spectrum has fallen by 3 dB at 0.59 and by 10 dB at 1.02 over that, and is "
          "nothing at 1.5 over that")
          .in("s")
          .within(above(0))
          .needed()
          .only({"half_sine"}),
      key("points", &Curve::points,
          "pairs [time in s, factor] with increasing time; straight lines between, constant before and after")
          .pairs_of({"time in s", "factor", between(-1e9, 1e9), between(-1e15, 1e15)})
          .otherwise("none: give `file`")
          .only({"table"}),
      key("file", &Curve::file,
          "CSV with such pairs, one in a line, of a measured blow for instance: two columns, time in s and factor, "
          "separated by commas, semicolons, tabs or blanks, with decimal points; lines of names may stand before the "
          "first number, remarks begin with #; all else is refused")
          .path()
          .otherwise("none: give `points`")
          .only({"table"}),
  };
  section.rule = check_curve;
  return section;
}

Section load_section() {
  using scene::Load;
  auto section = named_section("loads", "load", &Scene::loads, "Forces from outside, constant or following a curve.");
  section.keys = {
      key("type", &Load::type, "what acts").one_of({"nodal_force", "pressure", "traction", "torque"}).needed(),
      key("target", &Load::target, "what it acts on").names(node_set | point).needed().only({"nodal_force"}),
      key("target", &Load::target, "what it acts on").names(surface).needed().only({"pressure", "traction"}),
      key("target", &Load::target, "what it acts on").names(node_set | point).needed().only({"torque"}),
      key("force", &Load::force, "total force, shared among the nodes by their mass")
          .in("N")
          .needed()
          .only({"nodal_force"}),
      key("pressure", &Load::pressure, "positive pushes into the body; follows the surface as it moves")
          .in("Pa")
          .needed()
          .only({"pressure"}),
      key("traction", &Load::traction, "force per undeformed area, of fixed direction")
          .in("Pa")
          .needed()
          .only({"traction"}),
      key("moment", &Load::moment, "torque about the axis").in("N m").needed().only({"torque"}),
      key("axis", &Load::axis,
          "its direction, through the set's moving centre of mass; of a point where beams end: the axis about which "
          "that is turned")
          .direction()
          .only({"torque"}),
      key("curve", &Load::curve, "factor that changes with time").names(curve).otherwise("constant 1"),
  };
  return section;
}

Section gravity_section() {
  auto section =
      single_section("gravity", &Scene::gravity,
                     "Acceleration of gravity on all parts and point masses; without this section there is none.");
  section.open = [](Scene& scene, const scene::Place&) -> void* { return &scene; };
  section.keys = {key("acceleration", &Scene::gravity, "usually [0, 0, -9.81]").in("m/s2").needed()};
  return section;
}

Section motion_section() {
  using scene::InitialMotion;
  auto section = named_section("initial_motion", "initial motion", &Scene::initial_motions,
                               "Velocities at the beginning of the run: a translation and a rotation.");
  section.keys = {
      key("parts", &InitialMotion::parts, "what moves").names(whole_part | point).needed(),
      key("velocity", &InitialMotion::velocity, "of the centre").in("m/s"),
      key("angular_velocity", &InitialMotion::angular_velocity, "about the centre").in("rad/s"),
      key("rolling", &InitialMotion::rolling,
          "the angular velocity is that with which the round part among `parts` (wheel, wheelset, roller, cylinder) "
          "rolls without sliding on what it touches: its velocity "
          "over its radius where it is nearest to the other surface of its contact, or over the mesh's radius where it "
          "has none"),
      key("rolling_radius", &InitialMotion::rolling_radius,
          "the radius to roll on, of a mesh from a file for instance, which turns about the horizontal across its "
          "velocity")
          .in("m")
          .within(above(0))
          .otherwise("found from the meshes"),
      key("centre", &InitialMotion::centre, "centre of the rotation")
          .in("m")
          .otherwise("that of `around`, or the centre of mass of each part"),
      key("around", &InitialMotion::around,
          "a node set whose centre of mass is the centre of the rotation; of a wheel, wheelset, roller or cylinder "
          "that turns about its axis, or a set of it as its bore: that axis")
          .names(node_set | whole_part | point)
          .otherwise("each part's own"),
  };
  section.rule = check_motion;
  return section;
}

Section prescribed_section() {
  using scene::PrescribedMotion;
  auto section = named_section(
      "prescribed_motion", "prescribed motion", &Scene::prescribed_motions,
      "Node sets that move as a rigid body whose motion is known, such as a driven roller's bore; held "
      "while the scene settles. The work this takes is in the account's external work. Several may move the same nodes "
      "along perpendicular `directions`, each with curves of its own.");
  section.keys = {
      key("target", &PrescribedMotion::target, "what is moved").names(node_set).needed(),
      key("velocity", &PrescribedMotion::velocity, "of the centre").in("m/s"),
      key("angular_velocity", &PrescribedMotion::angular_velocity,
          "about an axis of fixed direction through the moving centre")
          .in("rad/s"),
      key("centre", &PrescribedMotion::centre, "centre of the rotation when the run begins")
          .in("m")
          .otherwise(
              "of a wheel, wheelset, roller or cylinder that turns about its axis that axis; else the set's centre "
              "of mass"),
      key("curve", &PrescribedMotion::curve,
          "factor on both velocities that changes with time; give the other nodes of a body "
          "that is to move from the start an [initial_motion]")
          .names(curve)
          .otherwise("constant 1"),
      key("displacement", &PrescribedMotion::displacement,
          "besides that of the velocities, where `displacement_curve` is 1")
          .in("m"),
      key("displacement_curve", &PrescribedMotion::displacement_curve,
          "factor on the displacement that changes with time, 0 at the start; each step goes to the displacement of "
          "its end")
          .names(curve)
          .otherwise("none"),
      key("directions", &PrescribedMotion::directions, "along which of the axes; along the others the nodes are free")
          .otherwise("all"),
      key("axes", &PrescribedMotion::axes, "what x, y and z mean in `directions`: three unit vectors"),
  };
  section.rule = check_prescribed;
  return section;
}

Section non_reflecting_section() {
  using scene::NonReflecting;
  auto section = named_section(
      "non_reflecting", "non-reflecting end", &Scene::non_reflecting,
      "Surfaces where bodies go on without end: dashpots of the part's own wave impedances (rho C_d along the "
      "normal, rho C_s across) let plane waves of the continuum out. A slender bar's own waves are slower, and come "
      "back in part ((C_d - c) / (C_d + c) at least, 7 % in steel, bending more): [absorbing_layers.NAME] before the "
      "same end takes these too. While the scene settles their nodes are held, and what held them then acts on them "
      "as a constant force during the run.");
  section.keys = {key("target", &NonReflecting::target, "where waves leave").names(surface).needed()};
  return section;
}

Section absorbing_layer_section() {
  using scene::AbsorbingLayer;
  auto section =
      named_section("absorbing_layers", "absorbing layer", &Scene::absorbing_layers,
                    "Zones before the ends of bodies in which waves of all kinds die out, a bar's and a "
                    "rail's as well as those of the continuum: mass-proportional damping "
                    "that grows with the cube of the way to the end. A layer as long as a longitudinal "
                    "wave, or twice as long as a bending wave, sends about 2 % of it back at most "
                    "(table in docs/verification.md); 2.5 m with reflection = 0.1 and dashpots on the end leave "
                    "less than 1 % of the energy of a 54E1 rail's waves from 300 Hz up. It slows rigid motion of the "
                    "zone too: not for bodies that roll or travel. Statics and `modes` know nothing of it.");
  section.keys = {
      key("target", &AbsorbingLayer::target, "the plane end before which it lies").names(surface).needed(),
      key("length", &AbsorbingLayer::length, "from the end into the body").in("m").within(above(0)).needed(),
      key("reflection", &AbsorbingLayer::reflection,
          "of the amplitude of the part's fastest waves what damping leaves on the way to the end and back: its "
          "damping at the end is 4 C_d ln(1 / reflection) / length. Less is not "
          "always better: damping that grows fast sends long waves back by itself")
          .within(inside(1e-6, 1)),
  };
  return section;
}

Section tie_section() {
  using scene::Tie;
  auto section = named_section(
      "ties", "tie", &Scene::ties,
      "Pairs of surfaces grown together whose meshes need not match: each node of the slave keeps its place "
      "over a face of the master. Take the finer mesh for the slave.");
  section.keys = {
      key("slave", &Tie::slave, "surface whose nodes are tied").names(surface).needed(),
      key("master", &Tie::master, "surface to whose faces they are tied").names(surface).needed(),
      key("max_distance", &Tie::max_distance, "how far from its face a slave node may lie; the distance is kept")
          .in("m")
          .within(above(0))
          .otherwise("a tenth of the face's shorter diagonal"),
  };
  section.rule = check_tie;
  return section;
}

}  // namespace railwave::case_file
