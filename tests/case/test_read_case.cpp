#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "source_folder.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using scene::Vec3;

namespace {

// Every key of the table, with a value that is not its default.
const char* const every_key = R"(
title = "everything"

[materials.rubber]
youngs_modulus = 1e7
poissons_ratio = 0.49
density = 1100

[materials.steel]
youngs_modulus = 210_000_000_000
poissons_ratio = 0.3
density = 7800
yield_stress = 5e8
tangent_modulus = 21e9

[meshes.block]
type = "box"
origin = [1, 2, 3.5]
size = [4, 5, 6]
divisions = [7, 8, 9]

[meshes.wheel]
type = "wheel"
profile = "cone"
conicity = 0.05
radius = 0.45
bore_radius = 0.09
hub_radius = 0.12
hub_width = 0.17
web_inner_radius = 0.15
web_inner_thickness = 0.03
web_outer_thickness = 0.02
web_outer_radius = 0.34
rim_inner_radius = 0.38
rim_width = 0.13
zone_size = 0.003
zone_length = 0.2
zone_start = -0.03
zone_centre = 0.01
zone_width = 0.04
growth = 1.3
coarse_size = 0.04
core_size = 0.05
section_size = 0.007
zone_layers = 4
web_columns = 5
web_centre = 0.001

[meshes.rail]
type = "rail"
section = "60E1"
inclination = 0.05
start = -0.4
end = 0.6
zone_size = 0.001
zone_start = -0.01
zone_end = 0.15
zone_centre = -0.004
zone_width = 0.02
growth = 1.2
coarse_size = 0.02
core_size = 0.06
section_size = 0.008
zone_layers = 6
web_columns = 7

[meshes.made_elsewhere]
type = "file"
path = "meshes/block.inp"
scale = 0.001

[parts.wheel]
mesh = "wheel"
material = "steel"
element_set = "ring"
position = [0, 0.1, 0.2]
hourglass = "stiffness"
hourglass_coefficient = 0.07

[parts.rail]
mesh = "rail"
material = "steel"

[parts.pad]
mesh = "block"
material = "rubber"
hourglass = "stiffness"

[points.body]
mass = 1000
position = [1, 2, 3]

[points.axle]
mass = 0
position = [0, 0, 0.46]

[beams.spokes]
from = "axle"
to = "wheel.bore"
material = "steel"
section = "rectangle"
width = 0.03
height = 0.04
orientation = [0, 2, 0]
count = 4
divisions = 3
pretension = 12500

[beams.shaft]
from = "axle"
to = "body"
material = "steel"
radius = 0.09

[connectors.suspension]
from = "body"
to = "wheel.bore"
stiffness = [1, 2, 3]
damping = [4, 5, 6]
preload = [7, 8, -9]
axes = [[0, 1, 0], [0, 0, 1], [1, 0, 0]]

[connectors.anchor]
from = "ground"
to = "rail.start"

[constraints.foot]
target = "rail.foot"
fixed = ["z", "x"]
fixed_rotation = ["y"]
axes = [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]

[contacts.tread]
slave = "wheel.tread"
master = "rail.head"
friction = 0.4
penalty_scale = 0.5
dynamic_friction = 0.25
friction_decay = 6
penalty_growth = [[0, 1], [1e-6, 4]]
damping = 0.1
symmetric = true
close_gap = [0, 0, -2]

[curves.ramp]
type = "cosine_ramp"
start = 1e-3
duration = 2e-3

[curves.pulse]
type = "table"
points = [[0, 0], [1e-3, 1], [2e-3, 0.5]]

[curves.steady]
type = "constant"

[loads.push]
type = "nodal_force"
target = "body"
force = [1, 2, 3]
curve = "pulse"

[loads.press]
type = "pressure"
target = "rail.head"
pressure = 1e6

[loads.drag]
type = "traction"
target = "rail.head"
traction = [10, 20, 30]

[loads.drive]
type = "torque"
target = "wheel.bore"
moment = 15000
axis = [0, 3, 4]
curve = "ramp"

[gravity]
acceleration = [0, 0, -9.81]

[initial_motion.roll]
parts = ["wheel", "body"]
velocity = [1, 2, 3]
angular_velocity = [4, 5, 6]
centre = [7, 8, 9]

[non_reflecting.far]
target = "wheel.x_max"

[absorbing_layers.far]
target = "wheel.x_max"
length = 0.5
reflection = 0.02

[ties.zone]
slave = "wheel.tread"
master = "wheel.rim"
max_distance = 2e-4

[settle]
tolerance = 1e-4
max_steps = 5e3

[time]
end = 2e-3
step_scale = 0.8
step = 1e-8

[solver]
precision = "mixed"
step_estimate = "global"
subcycling = true
renew_steps = 500

[output]
file = "out/everything.h5"
history_interval = 1e-6
field_interval = 1e-4
field_sets = ["wheel", "wheel.zone", "rail.head"]
fields = ["stress", "velocity"]
history_sets = ["wheel.bore", "body"]
progress_interval = 2.5
)";

}  // namespace

TEST_CASE("every key reaches its field", "[case]") {
  TemporaryCase file(every_key);
  std::filesystem::create_directories(file.folder() / "meshes");
  file.write("meshes/block.inp", "*NODE\n");
  const auto scene = read_case(file.path());

  CHECK(scene.title == "everything");
  CHECK(scene.path == file.path());

  REQUIRE(scene.materials.size() == 2);  // in the file's order, not by name
  CHECK(scene.materials[0].name == "rubber");
  CHECK(scene.materials[0].line == 4);
  CHECK(scene.materials[0].youngs_modulus == 1e7);
  CHECK(scene.materials[0].poissons_ratio == 0.49);
  CHECK(scene.materials[0].density == 1100);
  CHECK(scene.materials[1].name == "steel");
  CHECK(scene.materials[1].youngs_modulus == 210e9);
  CHECK(scene.materials[1].yield_stress == 5e8);
  CHECK(scene.materials[1].tangent_modulus == 21e9);
  CHECK_FALSE(scene.materials[0].yield_stress);
  CHECK(scene.materials[0].tangent_modulus == 0);

  REQUIRE(scene.meshes.size() == 4);
  CHECK(scene.meshes[0].type == scene::MeshType::box);
  CHECK(scene.meshes[0].box.origin == Vec3{1, 2, 3.5});
  CHECK(scene.meshes[0].box.size == Vec3{4, 5, 6});
  CHECK(scene.meshes[0].box.divisions == std::array<int, 3>{7, 8, 9});

  CHECK(scene.meshes[1].type == scene::MeshType::wheel);
  const auto& wheel = scene.meshes[1].wheel;
  CHECK(wheel.profile == "cone");
  CHECK(wheel.conicity == 0.05);
  CHECK(wheel.radius == 0.45);
  CHECK(wheel.bore_radius == 0.09);
  CHECK(wheel.hub_radius == 0.12);
  CHECK(wheel.hub_width == 0.17);
  CHECK(wheel.web_inner_radius == 0.15);
  CHECK(wheel.web_inner_thickness == 0.03);
  CHECK(wheel.web_outer_thickness == 0.02);
  CHECK(wheel.web_outer_radius == 0.34);
  CHECK(wheel.rim_inner_radius == 0.38);
  CHECK(wheel.rim_width == 0.13);
  CHECK(wheel.zone_size == 0.003);
  CHECK(wheel.zone_length == 0.2);
  CHECK(wheel.zone_start == -0.03);
  CHECK(wheel.zone_centre == 0.01);
  CHECK(wheel.zone_width == 0.04);
  CHECK(wheel.growth == 1.3);
  CHECK(wheel.coarse_size == 0.04);
  CHECK(wheel.core_size == 0.05);
  CHECK(wheel.section_size == 0.007);
  CHECK(wheel.zone_layers == 4);
  CHECK(wheel.web_columns == 5);
  CHECK(wheel.web_centre == 0.001);

  CHECK(scene.meshes[2].type == scene::MeshType::rail);
  const auto& rail = scene.meshes[2].rail;
  CHECK(rail.section == "60E1");
  CHECK(rail.inclination == 0.05);
  CHECK(rail.start == -0.4);
  CHECK(rail.end == 0.6);
  CHECK(rail.zone_size == 0.001);
  CHECK(rail.zone_start == -0.01);
  CHECK(rail.zone_end == 0.15);
  CHECK(rail.zone_centre == -0.004);
  CHECK(rail.zone_width == 0.02);
  CHECK(rail.growth == 1.2);
  CHECK(rail.coarse_size == 0.02);
  CHECK(rail.core_size == 0.06);
  CHECK(rail.section_size == 0.008);
  CHECK(rail.zone_layers == 6);
  CHECK(rail.web_columns == 7);

  CHECK(scene.meshes[3].type == scene::MeshType::file);
  CHECK(scene.meshes[3].file.path == (file.folder() / "meshes" / "block.inp").string());
  CHECK(scene.meshes[3].file.scale == 0.001);

  REQUIRE(scene.parts.size() == 3);
  CHECK(scene.parts[0].mesh == "wheel");
  CHECK(scene.parts[0].material == "steel");
  CHECK(scene.parts[0].element_set == "ring");
  CHECK(scene.parts[0].position == Vec3{0, 0.1, 0.2});
  CHECK(scene.parts[0].hourglass == scene::HourglassType::stiffness);
  CHECK(scene.parts[0].hourglass_coefficient == 0.07);

  REQUIRE(scene.points.size() == 2);
  CHECK(scene.points[0].name == "body");
  CHECK(scene.points[0].mass == 1000);
  CHECK(scene.points[0].position == Vec3{1, 2, 3});
  CHECK(scene.points[1].mass == 0);

  REQUIRE(scene.beams.size() == 2);
  CHECK(scene.beams[0].name == "spokes");
  CHECK(scene.beams[0].from == "axle");
  CHECK(scene.beams[0].to == "wheel.bore");
  CHECK(scene.beams[0].material == "steel");
  CHECK(scene.beams[0].section == scene::BeamSection::rectangle);
  CHECK(scene.beams[0].width == 0.03);
  CHECK(scene.beams[0].height == 0.04);
  REQUIRE(scene.beams[0].orientation);
  CHECK(*scene.beams[0].orientation == Vec3{0, 1, 0});
  CHECK(scene.beams[0].count == 4);
  CHECK(scene.beams[0].divisions == 3);
  CHECK(scene.beams[0].pretension == 12500);
  CHECK(scene.beams[1].section == scene::BeamSection::circle);
  CHECK(scene.beams[1].radius == 0.09);
  CHECK(!scene.beams[1].orientation);
  CHECK(!scene.beams[1].count);
  CHECK(!scene.beams[1].pretension);

  REQUIRE(scene.connectors.size() == 2);
  CHECK(scene.connectors[0].from == "body");
  CHECK(scene.connectors[0].to == "wheel.bore");
  CHECK(scene.connectors[0].stiffness == Vec3{1, 2, 3});
  CHECK(scene.connectors[0].damping == Vec3{4, 5, 6});
  CHECK(scene.connectors[0].preload == Vec3{7, 8, -9});
  CHECK(scene.connectors[0].axes[0] == Vec3{0, 1, 0});
  CHECK(scene.connectors[0].axes[2] == Vec3{1, 0, 0});
  CHECK(scene.connectors[1].from == "ground");

  REQUIRE(scene.constraints.size() == 1);
  CHECK(scene.constraints[0].target == "rail.foot");
  CHECK(scene.constraints[0].fixed == std::array<bool, 3>{true, false, true});
  CHECK(scene.constraints[0].fixed_rotation == std::array<bool, 3>{false, true, false});
  CHECK(scene.constraints[0].axes[1] == Vec3{-0.8, 0.6, 0});

  REQUIRE(scene.contacts.size() == 1);
  CHECK(scene.contacts[0].slave == "wheel.tread");
  CHECK(scene.contacts[0].master == "rail.head");
  CHECK(scene.contacts[0].friction == 0.4);
  CHECK(scene.contacts[0].penalty_scale == 0.5);
  CHECK(scene.contacts[0].dynamic_friction == 0.25);
  CHECK(scene.contacts[0].friction_decay == 6);
  REQUIRE(scene.contacts[0].penalty_growth.size() == 2);
  CHECK(scene.contacts[0].penalty_growth[1] == std::array<double, 2>{1e-6, 4});
  CHECK(scene.contacts[0].damping == 0.1);
  CHECK(scene.contacts[0].symmetric);
  CHECK(scene.contacts[0].close_gap == Vec3{0, 0, -1});  // a direction is stored with length 1

  REQUIRE(scene.curves.size() == 3);
  CHECK(scene.curves[0].type == scene::CurveType::cosine_ramp);
  CHECK(scene.curves[0].start == 1e-3);
  CHECK(scene.curves[0].duration == 2e-3);
  CHECK(scene.curves[1].type == scene::CurveType::table);
  REQUIRE(scene.curves[1].points.size() == 3);
  CHECK(scene.curves[1].points[2] == std::array<double, 2>{2e-3, 0.5});
  CHECK(scene.curves[2].type == scene::CurveType::constant);

  REQUIRE(scene.loads.size() == 4);
  CHECK(scene.loads[0].type == scene::LoadType::nodal_force);
  CHECK(scene.loads[0].target == "body");
  CHECK(scene.loads[0].force == Vec3{1, 2, 3});
  CHECK(scene.loads[0].curve == "pulse");
  CHECK(scene.loads[1].type == scene::LoadType::pressure);
  CHECK(scene.loads[1].pressure == 1e6);
  CHECK(scene.loads[1].curve.empty());
  CHECK(scene.loads[2].type == scene::LoadType::traction);
  CHECK(scene.loads[2].traction == Vec3{10, 20, 30});
  CHECK(scene.loads[3].type == scene::LoadType::torque);
  CHECK(scene.loads[3].moment == 15000);
  CHECK(std::fabs(scene.loads[3].axis[1] - 0.6) < 1e-15);
  CHECK(std::fabs(scene.loads[3].axis[2] - 0.8) < 1e-15);

  CHECK(scene.gravity == Vec3{0, 0, -9.81});

  REQUIRE(scene.initial_motions.size() == 1);
  CHECK(scene.initial_motions[0].parts == std::vector<std::string>{"wheel", "body"});
  CHECK(scene.initial_motions[0].velocity == Vec3{1, 2, 3});
  CHECK(scene.initial_motions[0].angular_velocity == Vec3{4, 5, 6});
  CHECK(scene.initial_motions[0].centre == Vec3{7, 8, 9});
  REQUIRE(scene.non_reflecting.size() == 1);
  CHECK(scene.non_reflecting[0].target == "wheel.x_max");
  REQUIRE(scene.absorbing_layers.size() == 1);
  CHECK(scene.absorbing_layers[0].target == "wheel.x_max");
  CHECK(scene.absorbing_layers[0].length == 0.5);
  CHECK(scene.absorbing_layers[0].reflection == 0.02);
  REQUIRE(scene.ties.size() == 1);
  CHECK(scene.ties[0].slave == "wheel.tread");
  CHECK(scene.ties[0].master == "wheel.rim");
  CHECK(scene.ties[0].max_distance == 2e-4);

  CHECK(scene.settle.active);
  CHECK(scene.settle.tolerance == 1e-4);
  CHECK(scene.settle.max_steps == 5000);
  CHECK(scene.time.end == 2e-3);
  CHECK(scene.time.step_scale == 0.8);
  CHECK(scene.time.step == 1e-8);
  CHECK(scene.solver.precision == scene::Precision::mixed);
  CHECK(scene.solver.step_estimate == scene::StepEstimate::global);
  CHECK(scene.solver.subcycling);
  CHECK(scene.solver.renew_steps == 500);
  CHECK(scene.output.file == "out/everything.h5");
  CHECK(scene.output.history_interval == 1e-6);
  CHECK(scene.output.field_interval == 1e-4);
  CHECK(scene.output.field_sets == std::vector<std::string>{"wheel", "wheel.zone", "rail.head"});
  CHECK(scene.output.fields == std::vector<std::string>{"stress", "velocity"});
  CHECK(scene.output.history_sets == std::vector<std::string>{"wheel.bore", "body"});
  CHECK(scene.output.progress_interval == 2.5);
}

TEST_CASE("what a case does not say keeps scene.hpp's defaults", "[case]") {
  TemporaryCase file(small_case);
  const auto scene = read_case(file.path());
  CHECK(scene.title.empty());
  CHECK(scene.meshes[0].box.divisions == scene::BoxMesh{}.divisions);
  CHECK(scene.parts[0].element_set.empty());
  CHECK(scene.parts[0].hourglass == scene::HourglassType::stiffness);
  CHECK(scene.parts[0].hourglass_coefficient == 0.05);
  CHECK(scene.gravity == Vec3{0, 0, 0});
  CHECK_FALSE(scene.settle.active);
  CHECK(scene.time.step_scale == 0.9);
  CHECK(scene.time.step == 0);
  CHECK(scene.solver.precision == scene::Precision::double_precision);
  CHECK(scene.solver.step_estimate == scene::StepEstimate::automatic);
  CHECK_FALSE(scene.solver.subcycling);
  CHECK(scene.output.file == "results/case/case.h5");
  CHECK(scene.output.fields.empty());
  CHECK(scene.contacts.empty());
}

TEST_CASE("the hourglass coefficient's default depends on the type", "[case]") {
  TemporaryCase file(small_case);
  CHECK(read_case(file.path(), {"parts.cube.hourglass=\"stiffness\""}).parts[0].hourglass_coefficient == 0.05);
  CHECK(read_case(file.path(), {"parts.cube.hourglass=viscous"}).parts[0].hourglass_coefficient == 0.1);
  CHECK(read_case(file.path()).parts[0].hourglass_coefficient == 0.05);
}

TEST_CASE("settling is on with its section, unless that says no", "[case]") {
  TemporaryCase file("[settle]\n" + small_case);
  CHECK(read_case(file.path()).settle.active);
  CHECK_FALSE(read_case(file.path(), {"settle.active=false"}).settle.active);
}

TEST_CASE("the rolling case is read", "[case]") {
  const auto scene = read_case(source_folder + "/cases/rolling.toml");
  CHECK(scene.parts.size() >= 2);
  CHECK(scene.settle.active);
  CHECK_FALSE(scene.contacts.empty());
}

TEST_CASE("Windows line ends, tabs, a byte order mark and UTF-8 are read", "[case]") {
  std::string text = small_case;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
  TemporaryCase file(
      "\xEF\xBB\xBFtitle = \"Schienenst\xC3\xB6\xC3\x9F"
      "e\"\r\n\t" +
      text);
  const auto scene = read_case(file.path());
  CHECK(scene.title ==
        "Schienenst\xC3\xB6\xC3\x9F"
        "e");
  CHECK(scene.materials[0].line == 2);
}

TEST_CASE("dotted keys and inline tables are the same as sections", "[case]") {
  TemporaryCase file(
      "materials.steel = { youngs_modulus = 210e9, poissons_ratio = 0.3, density = 7800 }\n"
      "meshes.cube.type = \"box\"\nparts.cube.mesh = \"cube\"\nparts.cube.material = \"steel\"\ntime.end = 1e-3\n");
  const auto scene = read_case(file.path());
  CHECK(scene.materials.at(0).density == 7800);
  CHECK(scene.time.end == 1e-3);
}

TEST_CASE("overrides replace and add values", "[case]") {
  TemporaryCase file(small_case);
  const auto scene =
      read_case(file.path(), {"time.end=2e-3", " time.step_scale = 0.5 ", "title=shorter run", "output.file=out/a.h5",
                              "gravity.acceleration=[0, 0, -9.81]", "meshes.cube.divisions=[2,3,4]", "time.end=3e-3"});
  CHECK(scene.time.end == 3e-3);  // the last one counts
  CHECK(scene.time.step_scale == 0.5);
  CHECK(scene.title == "shorter run");
  CHECK(scene.output.file == "out/a.h5");
  CHECK(scene.gravity == Vec3{0, 0, -9.81});
  CHECK(scene.meshes[0].box.divisions == std::array<int, 3>{2, 3, 4});
}

TEST_CASE("an override can mend a mistake of the file", "[case]") {
  TemporaryCase file(small_case + "step_scale = 2\n");
  CHECK(mistakes_of(file.path()) == file.path() + ":12: [time] step_scale: is 2, must be above 0 and at most 1");
  CHECK(read_case(file.path(), {"time.step_scale=0.9"}).time.step_scale == 0.9);
}

TEST_CASE("a contact's master is one surface or several") {
  const auto masters = [](const std::string& written) {
    const TemporaryCase file(
        small_case +
        "[parts.other]\nmesh = \"cube\"\nmaterial = \"steel\"\n[parts.third]\nmesh = \"cube\"\nmaterial = \"steel\"\n"
        "[contacts.touch]\nslave = \"cube.z_min\"\nmaster = " +
        written + "\n");
    return read_case(file.path()).contacts.at(0).master;
  };
  CHECK(masters("\"other.z_max\"") == "other.z_max");
  CHECK(masters("[\"other.z_max\"]") == "other.z_max");
  const scene::SurfaceNames two = masters("[\"third.z_max\", \"other.z_max\"]");
  CHECK(two.list() == std::vector<std::string>{"third.z_max", "other.z_max"});
  CHECK(two.text() == "third.z_max, other.z_max");
  CHECK(two == scene::SurfaceNames{"third.z_max", "other.z_max"});
}

TEST_CASE("a section's name of earlier versions is accepted with a warning", "[case]") {
  const TemporaryCase old(small_case + "[watch]\nspeed = 7\n"), present(small_case + "[monitor]\nspeed = 7\n");
  std::vector<std::string> warnings;
  CHECK(read_case(old.path(), {}, &warnings).monitor.speed == 7);
  const auto of_names = [&] {
    return std::count_if(warnings.begin(), warnings.end(),
                         [](const std::string& text) { return text.find("old name") != std::string::npos; });
  };
  CHECK(of_names() == 1);
  CHECK(warnings.back() == old.path() + ":12: [watch]: is called [monitor] now; the old name is still accepted");
  CHECK(read_case(present.path(), {}, &warnings).monitor.speed == 7);
  CHECK(of_names() == 0);
  // Of the command line, beside either name in the file.
  for (const TemporaryCase* file : {&old, &present}) {
    const auto scene = read_case(file->path(), {"watch.active=false", "monitor.chatter=3"}, &warnings);
    CHECK_FALSE(scene.monitor.active);
    CHECK(scene.monitor.chatter == 3);
    CHECK(scene.monitor.speed == 7);
    CHECK(warnings.back() == "command line: [watch]: is called [monitor] now; the old name is still accepted");
  }
  const TemporaryCase both(small_case + "[watch]\nspeed = 7\n[monitor]\nchatter = 3\n");
  CHECK(mistakes_of(both.path()).find(":12: [watch]: is the former name of [monitor], which the file has too") !=
        std::string::npos);
}
