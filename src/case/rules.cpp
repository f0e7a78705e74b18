#include "case/rules.hpp"
#include "case/usual_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace railwave::case_file {
namespace {

struct Named {
  const char* key;
  double value;
};

/// "0.5", or "0.5 by default" when the file doesn't say it.
std::string said(const EntryCheck& check, const Named& one) {
  return fmt::format("{}{}", one.value, check.given(one.key) ? "" : " by default");
}

/// Blames the key that the file gives, if it gives only one of the two.
void blame(EntryCheck& check, const Named& small, const Named& large, const char* small_must_be,
           const char* large_must_be) {
  const bool blame_small = check.given(small.key) && !check.given(large.key);
  const auto& wrong = blame_small ? small : large;
  const auto& other = blame_small ? large : small;
  check.complain(wrong.key, fmt::format("is {}, must be {} {} ({})", said(check, wrong),
                                        blame_small ? small_must_be : large_must_be, other.key, said(check, other)));
}

void ascending(EntryCheck& check, std::initializer_list<Named> values) {
  const Named* last = nullptr;
  for (const auto& value : values) {
    const bool wrong = last && check.sound({last->key, value.key}) && !(last->value < value.value);
    if (wrong) blame(check, *last, value, "smaller than", "larger than");
    last = &value;
  }
}

void at_most(EntryCheck& check, Named value, Named limit) {
  if (!check.sound({value.key, limit.key}) || !(value.value > limit.value)) return;
  if (check.given(value.key)) {
    check.complain(value.key,
                   fmt::format("is {}, must be at most {} ({})", value.value, limit.key, said(check, limit)));
  } else {
    check.complain(limit.key,
                   fmt::format("is {}, must be at least {} ({})", limit.value, value.key, said(check, value)));
  }
}

void check_band(scene::ZoneBand zone, EntryCheck& check) {
  if (!check.sound({"zone"}) || zone != scene::ZoneBand::contact) return;
  for (const char* key : {"zone_centre", "zone_width"})
    if (check.given(key))
      check.complain(key,
                     fmt::format("has no effect with zone = \"contact\", which finds it; leave it out, or say zone "
                                 "= \"given\""));
}

void check_wheel(const scene::WheelMesh& wheel, EntryCheck& check) {
  check_band(wheel.zone, check);
  ascending(check, {{"bore_radius", wheel.bore_radius},
                    {"hub_radius", wheel.hub_radius},
                    {"web_inner_radius", wheel.web_inner_radius},
                    {"web_outer_radius", wheel.web_outer_radius},
                    {"rim_inner_radius", wheel.rim_inner_radius},
                    {"radius", wheel.radius}});
  at_most(check, {"web_inner_thickness", wheel.web_inner_thickness}, {"hub_width", wheel.hub_width});
  at_most(check, {"web_outer_thickness", wheel.web_outer_thickness}, {"rim_width", wheel.rim_width});
  at_most(check, {"zone_width", wheel.zone_width}, {"rim_width", wheel.rim_width});
  at_most(check, {"zone_size", wheel.zone_size}, {"zone_width", wheel.zone_width});
  at_most(check, {"zone_size", wheel.zone_size}, {"zone_length", wheel.zone_length});
  at_most(check, {"zone_size", wheel.zone_size}, {"coarse_size", wheel.coarse_size});
  if (check.given("conicity") && check.sound({"profile"}) && wheel.profile != "cone") {
    check.complain("conicity",
                   "has no effect on profile '" + wheel.profile + "'; leave it out, or say profile = \"cone\"");
  }
  for (const char* key : {"path_length", "path_size"})
    if (check.given(key) && !check.given("path_start"))
      check.complain(key, fmt::format("has no effect without path_start; give that too, or leave {} out", key));
  if (wheel.path_start) {
    at_most(check, {"path_start", *wheel.path_start}, {"zone_start", wheel.zone_start});
    at_most(check, {"zone_size", wheel.zone_size}, {"path_size", wheel.path_size});
    at_most(check, {"path_size", wheel.path_size}, {"coarse_size", wheel.coarse_size});
  }
  const double around = 2 * M_PI * wheel.radius;
  if (check.sound({"zone_length", "radius"}) && wheel.zone_length > around) {
    check.complain("zone_length",
                   fmt::format("is {}, must be at most once around the wheel ({:.4g} m)", wheel.zone_length, around));
  }
}

std::string part_of(const std::string& set) { return set.substr(0, set.find('.')); }

}  // namespace

void check_rail(const scene::RailMesh& rail, EntryCheck& check) {
  check_band(rail.zone, check);
  constexpr double longest_modelled = 200;  // m
  if (const double length = rail.end - rail.start; check.sound({"start", "end"}) && length > longest_modelled)
    check.remark("end", fmt::format("the rail is {:.6g} m long, which is unusual: mostly it is up to {} m; m are "
                                    "expected: {:.4g}, if it is in mm",
                                    length, longest_modelled, 1e-3 * length));
  ascending(check, {{"start", rail.start}, {"end", rail.end}});
  ascending(check, {{"zone_start", rail.zone_start}, {"zone_end", rail.zone_end}});
  at_most(check, {"zone_size", rail.zone_size}, {"zone_width", rail.zone_width});
  at_most(check, {"zone_size", rail.zone_size}, {"coarse_size", rail.coarse_size});
  if (check.given("height_map_depth") && !check.given("height_map"))
    check.complain("height_map_depth",
                   "has no effect without height_map; give that too, or leave height_map_depth out");
  const bool path = check.given("path_start") || check.given("path_end");
  if (check.given("path_size") && !path)
    check.complain("path_size",
                   "has no effect without path_start or path_end; give one of them, or leave path_size out");
  if (path) {
    at_most(check, {"path_size", rail.path_size}, {"coarse_size", rail.coarse_size});
    at_most(check, {"zone_size", rail.zone_size}, {"path_size", rail.path_size});
  }
  if (rail.path_start) at_most(check, {"path_start", *rail.path_start}, {"zone_start", rail.zone_start});
  if (rail.path_end) at_most(check, {"zone_end", rail.zone_end}, {"path_end", *rail.path_end});
  if (!check.sound({"start", "end"})) return;
  for (const auto& end : {Named{"zone_start", rail.zone_start}, Named{"zone_end", rail.zone_end}}) {
    if (!check.sound({end.key}) || (end.value >= rail.start && end.value <= rail.end)) continue;
    check.complain(end.key, fmt::format("is {}, must be on the rail, from start = {} to end = {}", said(check, end),
                                        rail.start, rail.end));
  }
}

namespace {

/// Elements of a body of so many divisions, against those that solids of a railway have.
void remark_element_size(double length, int divisions, const char* size_key, const std::string& which,
                         EntryCheck& check) {
  const double size = length / divisions;
  if (size >= finest_mesh && size <= coarsest_mesh) return;
  check.remark(size_key, fmt::format("makes elements {:.4g} m {}, which is unusual: mostly they are {} to {} m; see "
                                     "the lengths, in m, and the divisions",
                                     size, which, finest_mesh, coarsest_mesh));
}

}  // namespace

void check_mesh(void* entry, EntryCheck& check) {
  const auto& mesh = *static_cast<scene::MeshSource*>(entry);
  if (!check.sound({"type"})) return;
  if (mesh.type == scene::MeshType::box && check.sound({"size", "divisions"}))
    for (int i = 0; i < 3; ++i)
      remark_element_size(mesh.box.size[i], mesh.box.divisions[i], "size", std::string("along ") + "xyz"[i], check);
  if (mesh.type == scene::MeshType::cylinder && check.sound({"length", "length_divisions"}))
    remark_element_size(mesh.cylinder.length, mesh.cylinder.length_divisions, "length", "along z", check);
  if (mesh.type == scene::MeshType::wheel) check_wheel(mesh.wheel, check);
  if (mesh.type == scene::MeshType::wheelset) check_wheel(mesh.wheelset, check);
  if (mesh.type == scene::MeshType::rail) check_rail(mesh.rail, check);
  if (mesh.type == scene::MeshType::fishplate && check.given("gap_start") != check.given("gap_end"))
    check.complain(check.given("gap_start") ? "gap_end" : "gap_start", "is missing; a gap has a start and an end");
}

void check_part(void* entry, EntryCheck& check) {
  auto& part = *static_cast<scene::Part*>(entry);
  if (!check.given("hourglass_coefficient")) return part.take_hourglass(part.hourglass);
  if (!check.given("hourglass") && check.sound({"hourglass_coefficient"}) && part.hourglass_coefficient > 0)
    check.remark("hourglass_coefficient",
                 "is given without hourglass, and so is one of stiffness control, the default; give hourglass = "
                 "\"stiffness\" beside it, or \"viscous\" if that "
                 "control's coefficient is meant (docs/hourglass.md)");
}

void check_beam(void* entry, EntryCheck& check) {
  const auto& beam = *static_cast<scene::Beam*>(entry);
  if (check.sound({"from", "to"}) && beam.from == beam.to) {
    check.complain("to", fmt::format("is '{}' like `from`; the two ends must differ", beam.to));
  }
  if (!check.sound({"section"})) return;
  const bool circle = beam.section == scene::BeamSection::circle;
  const char* name = circle ? "circle" : "rectangle";
  for (const auto& [key, value] :
       {Named{"radius", beam.radius}, Named{"width", beam.width}, Named{"height", beam.height}}) {
    const bool belongs = circle == (key[0] == 'r');
    if (belongs && !check.given(key)) check.complain(key, fmt::format("is missing; section = \"{}\" needs it", name));
    if (!belongs && check.given(key))
      check.complain(key, fmt::format("does not belong to section = \"{}\"; leave it out", name));
  }
}

void check_constraint(void* /*entry*/, EntryCheck& check) {
  if (check.given("fixed") || check.given("fixed_rotation")) return;
  check.complain("fixed", "is missing; must be a list of 'x', 'y' and 'z', unless fixed_rotation is given");
}

void check_connector(void* entry, EntryCheck& check) {
  const auto& connector = *static_cast<scene::Connector*>(entry);
  if (check.given("area") && !check.given("spread"))
    check.complain("area", "has no effect without spread; give that too, such as [3, 3], or leave area out");
  if (check.sound({"from", "to"}) && connector.from == connector.to) {
    check.complain("to", fmt::format("is '{}' like `from`; the two ends must differ", connector.to));
  }
}

namespace {

void check_falling_friction(const scene::Contact& contact, EntryCheck& check) {
  if (!check.sound({"friction", "dynamic_friction", "friction_decay"})) return;
  if (contact.dynamic_friction && contact.friction_decay == 0) {
    check.complain("dynamic_friction",
                   "has no effect without friction_decay above 0; give that too, such as 6 s/m, or leave "
                   "dynamic_friction out");
  } else if (contact.friction_decay > 0 && !contact.dynamic_friction) {
    check.complain("friction_decay",
                   "has no effect without dynamic_friction; give that too, or leave friction_decay out");
  } else if (contact.dynamic_friction && !(*contact.dynamic_friction < contact.friction)) {
    check.complain("dynamic_friction",
                   fmt::format("is {}, must be smaller than friction ({}), from which it falls",
                               *contact.dynamic_friction, said(check, {"friction", contact.friction})));
  }
  if (check.given("friction_memory") && contact.friction_decay == 0)
    check.complain("friction_memory",
                   "has no effect without dynamic_friction and friction_decay; give those too, or leave "
                   "friction_memory out");
}

void check_penalty_growth(const scene::Contact& contact, EntryCheck& check) {
  if (!check.sound({"penalty_growth"})) return;
  double before = -1;
  for (std::size_t i = 0; i < contact.penalty_growth.size(); ++i) {
    const double depth = contact.penalty_growth[i][0];
    if (!(depth > before)) {
      check.complain(
          "penalty_growth",
          fmt::format("penetration must be at least 0 m and increase from pair to pair, but pair {} has {} m{}", i + 1,
                      depth, i > 0 ? fmt::format(" after {} m", before) : ""));
      return;
    }
    before = depth;
  }
}

/// Multipliers have no springs, and one surface whose nodes must not enter the other.
void check_algorithm(const scene::Contact& contact, EntryCheck& check) {
  if (!check.sound({"algorithm"}) || contact.algorithm != scene::ContactAlgorithm::multiplier) return;
  for (const char* key : {"penalty_growth", "damping", "symmetric"})
    if (check.given(key))
      check.complain(key, "belongs to the penalty algorithm; leave it out, or set algorithm = \"penalty\"");
}

}  // namespace

void check_contact(void* entry, EntryCheck& check) {
  const auto& contact = *static_cast<scene::Contact*>(entry);
  check_algorithm(contact, check);
  check_falling_friction(contact, check);
  check_penalty_growth(contact, check);
  if (!check.sound({"slave", "master"})) return;
  const bool several = contact.master.size() > 1;
  const bool own = std::any_of(contact.master.begin(), contact.master.end(),
                               [&](const std::string& name) { return part_of(name) == part_of(contact.slave); });
  if (contact.master.has(contact.slave)) {
    check.complain(
        "master",
        several ? fmt::format("has '{}', which is the `slave`; a surface cannot touch itself: leave it out of the list",
                              contact.slave)
                : fmt::format("is '{}' like `slave`; a surface cannot touch itself: name two surfaces", contact.slave));
  } else if (contact.close_gap && own) {
    check.complain(
        "close_gap",
        several ? fmt::format("the slave and one of the masters are of the part '{}', which cannot be moved towards "
                              "itself; leave close_gap out",
                              part_of(contact.slave))
                : fmt::format(
                      "both surfaces are of the part '{}', which cannot be moved towards itself; leave close_gap out",
                      part_of(contact.slave)));
  }
}

void check_curve(void* entry, EntryCheck& check) {
  const auto& curve = *static_cast<scene::Curve*>(entry);
  if (!check.sound({"type", "points", "file"})) return;
  if (curve.type == scene::CurveType::table && check.given("points") == check.given("file")) {
    check.complain("points", check.given("file")
                                 ? "has no effect beside file; leave one of them out"
                                 : "is missing; must be a list of pairs [[time, value], ...], unless file is given");
    return;
  }
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const double before = curve.points[i - 1][0], time = curve.points[i][0];
    if (time > before) continue;
    check.complain("points", fmt::format("time must increase from pair to pair, but pair {} has {} s after {} s", i + 1,
                                         time, before));
    return;
  }
}

void check_motion(void* entry, EntryCheck& check) {
  const auto& motion = *static_cast<scene::InitialMotion*>(entry);
  const scene::Vec3 zero{0, 0, 0};
  if (check.given("rolling_radius") && !motion.rolling && check.sound({"rolling"}))
    check.complain("rolling_radius",
                   "has no effect without rolling = true; give that too, or leave rolling_radius out");
  if (motion.rolling && check.given("angular_velocity"))
    check.complain("rolling",
                   "is true beside angular_velocity; leave out angular_velocity, which then follows from the velocity, "
                   "or rolling");
  if (motion.centre && motion.angular_velocity == zero && !motion.rolling &&
      check.sound({"centre", "angular_velocity", "rolling"})) {
    check.complain("centre",
                   "has no effect without angular_velocity or rolling; give one of them too, or leave centre out");
  }
}

void check_prescribed(void* /*entry*/, EntryCheck& check) {
  const bool displacement = check.given("displacement"), when = check.given("displacement_curve");
  if (displacement && !when)
    check.complain(
        "displacement",
        "has no effect without displacement_curve, which says when; give that too, or leave displacement out");
  if (when && !displacement)
    check.complain("displacement_curve",
                   "has no effect without displacement; give that too, or leave displacement_curve out");
}

void check_tie(void* entry, EntryCheck& check) {
  const auto& tie = *static_cast<scene::Tie*>(entry);
  if (check.sound({"slave", "master"}) && tie.slave == tie.master) {
    check.complain("master", fmt::format("is '{}' like `slave`; a surface cannot be tied to itself: name two surfaces",
                                         tie.master));
  }
}

void check_time(void* entry, EntryCheck& check) {
  const auto& time = *static_cast<scene::Time*>(entry);
  at_most(check, {"step", time.step}, {"end", time.end});
}

void check_output(void* entry, EntryCheck& check) {
  const auto& output = *static_cast<scene::Output*>(entry);
  if (!check.sound({"field_sets", "fields"})) return;
  if (!output.field_sets.empty() && !check.given("fields")) {
    check.complain(
        "fields",
        "is missing, so nothing would be written for field_sets; add for instance fields = [\"displacement\"]");
  }
  if (!output.fields.empty() && !check.given("field_sets")) {
    check.complain("field_sets",
                   "is missing, so none of the fields would be written; add for instance field_sets = [\"PART\"]");
  }
}

void check_output_window(void* entry, EntryCheck& check) {
  const auto& window = *static_cast<scene::OutputWindow*>(entry);
  if (window.end) at_most(check, {"start", window.start}, {"end", *window.end});
}

}  // namespace railwave::case_file
