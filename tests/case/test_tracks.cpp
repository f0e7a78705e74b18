#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "case/expand.hpp"
#include "case/solid_pad.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

std::string track_case(const std::string& keys) {
  return "[tracks.track]\nstart = -3\nend = 3\n" + keys + "\n[time]\nend = 1e-3\n";
}

template <class Entry>
const Entry& named(const std::vector<Entry>& entries, const std::string& name) {
  for (const auto& entry : entries)
    if (entry.name == name) return entry;
  throw std::runtime_error("there is no " + name);
}

std::vector<double> places_of(const std::string& keys) {
  TemporaryCase file(track_case(keys));
  const auto scene = read_case(file.path());
  std::vector<double> places;
  for (const auto& part : scene.parts)
    if (part.name.find("_sleeper_") != std::string::npos) places.push_back(part.position[0]);
  return places;
}

void check_places(const std::vector<double>& places, const std::vector<double>& expected) {
  REQUIRE(places.size() == expected.size());
  for (std::size_t k = 0; k < places.size(); ++k) CHECK_THAT(places[k], WithinAbs(expected[k], 1e-12));
}

}  // namespace

TEST_CASE("a track is a rail on concrete sleepers of table 4.1, half a pitch from its ends", "[case]") {
  TemporaryCase file(track_case(""));
  const auto scene = read_case(file.path());
  REQUIRE(scene.parts.size() == 11);
  CHECK(scene.parts[0].name == "track_rail");
  check_places(places_of(""), {-2.7, -2.1, -1.5, -0.9, -0.3, 0.3, 0.9, 1.5, 2.1, 2.7});
  const auto& concrete = named(scene.materials, "track_concrete");
  CHECK(concrete.youngs_modulus == 38.4e9);
  CHECK(concrete.poissons_ratio == 0.2);
  CHECK(concrete.density == 2520);
  CHECK(named(scene.materials, "track_steel").youngs_modulus == 210e9);
  const auto& box = named(scene.meshes, "track_concrete").box;
  CHECK_THAT(box.origin[1], WithinAbs(-0.755, 1e-12));
  CHECK_THAT(box.origin[2] + box.size[2], WithinAbs(-0.007, 1e-12));
  REQUIRE(scene.connectors.size() == 20);
  const auto& fastening = named(scene.connectors, "track_fastening_10");
  CHECK(fastening.from == "track_sleeper_10.z_max");
  CHECK(fastening.to == "track_rail.foot");
  CHECK(fastening.stiffness == scene::Vec3{100e6, 100e6, 195e6});
  CHECK(fastening.damping == scene::Vec3{40e3, 40e3, 67.5e3});
  CHECK_THAT((*fastening.area)[0][0], WithinAbs(2.7 - 0.08, 1e-12));
  const auto& ballast = named(scene.connectors, "track_ballast_1");
  CHECK(ballast.from == "ground");
  CHECK(ballast.stiffness == scene::Vec3{0, 0, 45e6});
  CHECK(ballast.damping == scene::Vec3{0, 0, 32e3});
  CHECK(named(scene.constraints, "track_centre_3").target == "track_sleeper_3.y_min");
}

TEST_CASE("two timber sleepers stand 0.24 m apart at a joint, and regular ones go on from them", "[case]") {
  const std::string joint = "pair_position = 0.06\ngap_position = 0.06\nzone_end = 0.2\n";
  check_places(places_of(joint), {-2.46, -1.86, -1.26, -0.66, -0.06, 0.18, 0.78, 1.38, 1.98, 2.58});
  TemporaryCase file(track_case(joint));
  const auto scene = read_case(file.path());
  CHECK(named(scene.parts, "track_sleeper_5").mesh == "track_timber");
  CHECK(named(scene.parts, "track_sleeper_6").material == "track_timber");
  CHECK(named(scene.parts, "track_sleeper_7").material == "track_concrete");
  CHECK(named(scene.materials, "track_timber").density == 1300);
  CHECK(named(scene.connectors, "track_fastening_5").to == "track_rail.foot");
  CHECK(named(scene.connectors, "track_fastening_6").to == "track_rail_2.foot");
  CHECK(named(scene.connectors, "track_fastening_6").stiffness == scene::Vec3{150e6, 150e6, 86.7e6});
  CHECK_THAT(named(scene.meshes, "track_rail").rail.end, WithinAbs(0.057, 1e-12));
  CHECK_THAT(named(scene.meshes, "track_rail").rail.zone_end, WithinAbs(0.057, 1e-12));
  CHECK_THAT(named(scene.meshes, "track_rail_2").rail.start, WithinAbs(0.063, 1e-12));
  CHECK(named(scene.meshes, "track_rail_2").rail.zone_end == 0.2);
}

TEST_CASE("sleepers stand where the case puts them, of the kinds that it names", "[case]") {
  TemporaryCase file(
      "[sleepers.twin]\nbase = \"concrete\"\nhalf_length = 0.84\nballast_stiffness = 30e6\nmaterial = \"hard\"\n"
      "[materials.hard]\nyoungs_modulus = 40e9\npoissons_ratio = 0.2\ndensity = 2400\n" +
      track_case("sleeper = \"twin\"\npositions = [1.2, -1, 0.1]\nother_positions = [2]\ninclination = "
                 "-0.025\nposition = [10, 0, 0]"));
  const auto scene = read_case(file.path());
  CHECK_THAT(named(scene.parts, "track_sleeper_1").position[0], WithinAbs(9, 1e-12));
  CHECK(named(scene.parts, "track_sleeper_3").material == "hard");
  CHECK(named(scene.parts, "track_sleeper_4").material == "track_timber");
  CHECK(named(scene.connectors, "track_ballast_1").stiffness[2] == 30e6);
  CHECK(named(scene.connectors, "track_ballast_4").stiffness[2] == 45e6);
  // The rail leans towards +y: there is the track's centre.
  CHECK_THAT(named(scene.meshes, "track_twin").box.origin[1], WithinAbs(0.755 - 0.84, 1e-12));
  CHECK(named(scene.constraints, "track_centre_1").target == "track_sleeper_1.y_max");
  CHECK_THAT((*named(scene.connectors, "track_fastening_1").area)[1][0], WithinAbs(9.08, 1e-12));
}

TEST_CASE("names that a track makes can be used, and may not be taken", "[case]") {
  const std::string load =
      "[loads.weight]\ntype = \"nodal_force\"\ntarget = \"track_rail.end\"\nforce = [0, 0, -1]\n"
      "[node_sets.seat]\npart = \"track_sleeper_2\"\nsurface = \"z_max\"\nbox = [[-9, -0.1, -9], [9, 0.1, 9]]\n";
  TemporaryCase good(load + track_case(""));
  CHECK(mistakes_of(good.path()).empty());
  TemporaryCase taken("[parts.track_sleeper_2]\nmesh = \"track_concrete\"\nmaterial = \"track_concrete\"\n" +
                      track_case(""));
  CHECK(mistakes_of(taken.path())
            .find("[tracks.track]: makes [parts.track_sleeper_2], which is there already (line 1); rename one") !=
        std::string::npos);
  TemporaryCase lost(track_case("first_sleeper = 20"));
  CHECK(mistakes_of(lost.path()).find("[tracks.track]: has no sleeper under its rail") != std::string::npos);
}

TEST_CASE("a joint is two fishplates on both rails, and bolts between points with heads spread over the plates",
          "[case]") {
  const std::string joint =
      "gap_position = 0.06\nzone_end = 0.2\nfishplates = true\nposition = [10, 1, 2]\ninclination = 0\n";
  TemporaryCase file(track_case(joint + "bolt_positions = [-0.1, 0.15]\nfishplate_clearance = 0.001\n"));
  const auto scene = read_case(file.path());
  const auto& right = named(scene.meshes, "track_fishplate_right").fishplate;
  CHECK(right.side == scene::RailSide::right);
  CHECK_THAT(right.start, WithinAbs(0.06 - 0.3, 1e-12));
  CHECK_THAT(*right.gap_end, WithinAbs(0.063, 1e-12));
  CHECK_FALSE(right.size.has_value());
  CHECK(right.rail_mesh.zone_end == named(scene.meshes, "track_rail").rail.zone_end);
  CHECK(named(scene.parts, "track_fishplate_left").position == scene::Vec3{10, 1, 2});
  REQUIRE(scene.ties.size() == 4);
  CHECK(named(scene.ties, "track_fishplate_left_2").slave == "track_fishplate_left.fishing_2");
  CHECK(named(scene.ties, "track_fishplate_left_2").master == "track_rail_2.fishing_left");
  CHECK(scene.contacts.empty());
  CHECK(scene.points.size() == 4);
  CHECK(scene.beams.size() == 6);
  const auto& bolt = named(scene.beams, "track_bolt_2");
  CHECK(bolt.from == "track_bolt_2_left");
  CHECK(*bolt.pretension == 12.5e3);
  CHECK(bolt.radius == 0.012);
  const auto &a = named(scene.points, "track_bolt_2_left").position,
             &b = named(scene.points, "track_bolt_2_right").position;
  CHECK_THAT(a[0], WithinAbs(10.21, 1e-12));
  CHECK_THAT(a[2], WithinAbs(2.07, 1e-12));
  CHECK_THAT(0.5 * (a[1] + b[1]), WithinAbs(1, 1e-12));
  CHECK_THAT(b[1] - a[1], WithinAbs(2 * (0.008 + 0.001 + 0.02 + 0.6 * 0.024), 1e-12));
  const auto& head = named(scene.beams, "track_bolt_1_right");
  CHECK(head.to == "track_fishplate_right.bolt_1");
  CHECK_FALSE(head.pretension.has_value());

  TemporaryCase loose(track_case(joint + "fishplate_fit = \"contact\"\nfishplate_friction = 0.2\n"));
  const auto other = read_case(loose.path());
  CHECK(other.ties.empty());
  REQUIRE(other.contacts.size() == 4);
  CHECK(named(other.contacts, "track_fishplate_right").friction == 0.2);
}

TEST_CASE("a joint's mistakes are reported with what would do", "[case]") {
  const auto mistakes = [](const std::string& keys) {
    TemporaryCase file(track_case(keys));
    return mistakes_of(file.path());
  };
  const auto says = [](const std::string& text, const char* part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  const std::string joint = "gap_position = 0.06\nzone_end = 0.2\nfishplates = true\n";
  says(mistakes("bolt_pretension = 1e3"), "bolt_pretension: has no effect without fishplates = true");
  says(mistakes("fishplates = true"), "fishplates: has no effect without gap_position");
  says(mistakes(joint + "fishplate_friction = 0.2"), "fishplate_friction: has no effect on plates that are tied");
  says(mistakes(joint + "bolt_positions = [0.01, 0.2]"), "bolt_positions: has 0.01, must be 0.015 to 0.276 m away");
  says(mistakes(joint + "fishplate_length = 8"), "fishplate_length: is 8, so that the plates reach from");
  says(mistakes(joint + "path_size = 0.003"), "path_size: has no effect without path_start");
  TemporaryCase box("[meshes.b]\ntype = \"box\"\n[meshes.p]\ntype = \"fishplate\"\nrail = \"b\"\ngap_start = 0\n" +
                    track_case(""));
  says(mistakes_of(box.path()), "gap_end: is missing");
  TemporaryCase other("[meshes.b]\ntype = \"box\"\n[meshes.p]\ntype = \"fishplate\"\nrail = \"b\"\n" + track_case(""));
  says(mistakes_of(other.path()), "[meshes.p] rail: 'b' is no mesh of type \"rail\"");
}

TEST_CASE("a mirrored track has the same parts, mirrored, and the same connectors and constraints", "[case]") {
  TemporaryCase plain(track_case("position = [0, 0.756, 0]\n")),
      mirrored(track_case("position = [0, -0.756, 0]\nmirror = true\n"));
  const auto left = read_case(plain.path()), right = read_case(mirrored.path());
  REQUIRE(left.parts.size() == right.parts.size());
  for (std::size_t k = 0; k < left.parts.size(); ++k) {
    CHECK_FALSE(left.parts[k].mirror);
    CHECK(right.parts[k].mirror);
    CHECK(right.parts[k].position[0] == left.parts[k].position[0]);
    CHECK(right.parts[k].position[1] == -left.parts[k].position[1]);
    CHECK(right.parts[k].mesh == left.parts[k].mesh);
  }
  // The mirrored sleeper's y_min is the side that looks to the centre of the track, at y = 0.
  for (std::size_t k = 0; k < left.constraints.size(); ++k)
    CHECK(right.constraints[k].target == left.constraints[k].target);
  for (std::size_t k = 0; k < left.connectors.size(); ++k) {
    CHECK(right.connectors[k].stiffness == left.connectors[k].stiffness);
    CHECK(right.connectors[k].area == left.connectors[k].area);
  }
}

TEST_CASE("a solid pad is tied to foot and sleeper; springs beside it have what its shear lacks", "[case]") {
  TemporaryCase file("[sleepers.concrete]\npad = \"solid\"\n" +
                     track_case("position = [10, 0, 0]\ngap_position = 0.06\nzone_end = 0.2\nfirst_sleeper = -3"));
  const auto scene = read_case(file.path());
  const auto& pad = named(scene.parts, "track_pad_6");
  CHECK(pad.position == scene::Vec3{10, 0, 0});
  CHECK(pad.material == "track_concrete_pad");
  CHECK(pad.hourglass == scene::HourglassType::stiffness);
  CHECK_THAT(pad.stiffness_damping, WithinRel(67.5e3 / 195e6, 1e-12));
  const auto& mesh = named(scene.meshes, "track_pad_7").rail_pad;
  CHECK(mesh.rail == "track_rail_2");
  CHECK_THAT(mesh.rail_mesh.start, WithinAbs(0.063, 1e-12));
  CHECK_THAT(mesh.start, WithinAbs(0.6 - 0.08, 1e-12));
  CHECK_THAT(named(scene.meshes, "track_pad_1").rail_pad.start, WithinAbs(-3, 1e-12));  // at the rail's end
  CHECK(named(scene.ties, "track_pad_7_foot").master == "track_rail_2.foot");
  CHECK(named(scene.ties, "track_pad_7_seat").slave == "track_pad_7.z_min");
  CHECK(named(scene.ties, "track_pad_7_seat").master == "track_sleeper_7.z_max");
  const auto& material = named(scene.materials, "track_concrete_pad");
  const case_file::BondedLayer layer{0.16, case_file::foot_width("54E1"), 0.007};
  CHECK_THAT(material.youngs_modulus * layer.vertical_stiffness(0.3), WithinRel(195e6, 1e-12));
  const double shear = material.shear_modulus() * 0.16 * layer.width / 0.007;
  const auto& springs = named(scene.connectors, "track_fastening_7");
  CHECK_THAT(springs.stiffness[0], WithinRel(100e6 - shear, 1e-9));
  CHECK_THAT(springs.stiffness[1], WithinRel(100e6 - shear, 1e-9));
  CHECK(springs.stiffness[2] == 0);
  CHECK_THAT(springs.damping[1], WithinRel(40e3 - 67.5e3 / 195e6 * shear, 1e-9));
  CHECK(springs.damping[2] == 0);
}

TEST_CASE("a solid pad of a modulus of its own has clips only where they are given", "[case]") {
  const std::string pad =
      "[sleepers.concrete]\npad = \"solid\"\npad_modulus = 5e7\npad_poissons_ratio = 0.45\npad_density = "
      "1200\npad_layers = 4\n";
  TemporaryCase file(pad + track_case(""));
  const auto scene = read_case(file.path());
  CHECK(scene.connectors.size() == 10);  // ballast
  CHECK(named(scene.materials, "track_concrete_pad").youngs_modulus == 5e7);
  CHECK(named(scene.materials, "track_concrete_pad").poissons_ratio == 0.45);
  CHECK(named(scene.materials, "track_concrete_pad").density == 1200);
  CHECK(named(scene.meshes, "track_pad_1").rail_pad.layers == 4);
  CHECK_THAT(named(scene.parts, "track_pad_1").stiffness_damping, WithinRel(67.5e3 / 195e6, 1e-12));
  TemporaryCase clipped(pad + "fastening_stiffness = [1e7, 2e7, 5e6]\n" + track_case(""));
  CHECK(named(read_case(clipped.path()).connectors, "track_fastening_1").stiffness == scene::Vec3{1e7, 2e7, 5e6});
  TemporaryCase undamped("[sleepers.concrete]\npad = \"solid\"\npad_damping = 0\n" + track_case(""));
  CHECK(named(read_case(undamped.path()).connectors, "track_fastening_1").damping == scene::Vec3{40e3, 40e3, 67.5e3});
}

TEST_CASE("the stiffness of a bonded layer between its limits", "[case]") {
  const double nu = 0.3, whole = (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  // Thin: nothing widens. Without lateral contraction nothing would.
  CHECK_THAT(case_file::BondedLayer({1, 1, 1e-5}).vertical_stiffness(nu), WithinRel(1e5 * whole, 1e-4));
  CHECK_THAT(case_file::BondedLayer({0.16, 0.14, 0.007}).vertical_stiffness(0), WithinRel(3.2, 1e-12));
  // A narrow strip is in plane strain.
  CHECK_THAT(case_file::BondedLayer({1000, 1e-3, 1}).vertical_stiffness(nu), WithinRel(1 / (1 - nu * nu), 2e-3));
  CHECK_THAT(case_file::BondedLayer({0.16, 0.14, 0.007}).shear_stiffness(nu), WithinRel(3.2 / 2.6, 1e-12));
}

TEST_CASE("a whole track has whole sleepers, and the other rail mirrored at the centre plane", "[case]") {
  for (bool mirrored : {false, true}) {
    TemporaryCase file(
        track_case(std::string("both_rails = true\nposition = [10, 2, 3]\n") + (mirrored ? "mirror = true\n" : "")));
    const auto scene = read_case(file.path());
    REQUIRE(scene.parts.size() == 12);
    const auto& far = named(scene.parts, "track_far_rail");
    CHECK(far.mirror != mirrored);
    CHECK_THAT(far.position[1], WithinAbs(2 + (mirrored ? 1.51 : -1.51), 1e-12));
    CHECK(far.position[2] == 3);
    CHECK(far.material == "track_steel");
    const auto& box = named(scene.meshes, "track_concrete").box;
    CHECK_THAT(box.origin[1], WithinAbs(-0.755 - 1.26, 1e-12));
    CHECK_THAT(box.size[1], WithinAbs(2.52, 1e-12));
    CHECK(box.divisions == std::array<int, 3>{3, 28, 2});
    REQUIRE(scene.connectors.size() == 30);
    CHECK(named(scene.connectors, "track_far_fastening_10").from == "track_sleeper_10.z_max");
    CHECK(named(scene.connectors, "track_far_fastening_10").to == "track_far_rail.foot");
    CHECK(named(scene.connectors, "track_ballast_1").stiffness == scene::Vec3{0, 0, 90e6});
    CHECK(named(scene.connectors, "track_ballast_1").spread == std::array<int, 2>{2, 12});
    CHECK(named(scene.constraints, "track_centre_2").target == "track_sleeper_2.centre");
    REQUIRE(scene.node_sets.size() == 10);
    CHECK_THAT((*scene.node_sets[1].box)[0][1], WithinAbs(2 + (mirrored ? 0.755 : -0.755), 1e-5));
  }
  TemporaryCase free("[sleepers.concrete]\nballast_lateral_stiffness = 2e7\npad = \"solid\"\n" +
                     track_case("both_rails = true"));
  const auto scene = read_case(free.path());
  CHECK(scene.constraints.size() == 10);  // beds
  CHECK(named(scene.connectors, "track_ballast_1").stiffness == scene::Vec3{0, 4e7, 90e6});
  CHECK(named(scene.ties, "track_far_pad_3_foot").master == "track_far_rail.foot");
  CHECK(named(scene.parts, "track_far_pad_3").material == "track_concrete_pad");
}
