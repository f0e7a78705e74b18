#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/contact_zone.hpp"
#include "mesh/sections/profile_contact.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double mm = 1e-3;

/// A wheel whose profile is an arc of radius `across` that bulges outwards, on a rail of radius `rail` about its crown.
ProfileContact arcs(double nominal, double across, double rail) {
  std::vector<ProfilePoint> wheel, head;
  for (double y = -0.03; y <= 0.03; y += 1e-5) wheel.push_back({y, {y, nominal - fall(across, y)}});
  for (double y = -0.05; y <= 0.05; y += 1e-5) head.push_back({y, {y, -fall(rail, y)}});
  return {wheel, head};
}

scene::Scene wheel_on_rail(double lateral) {
  scene::Scene scene;
  scene.path = "case.toml";
  scene::MeshSource wheel, rail;
  wheel.name = "wheel";
  wheel.type = scene::MeshType::wheel;
  wheel.wheel.zone = scene::ZoneBand::contact;
  wheel.line = 3;
  rail.name = "rail";
  rail.type = scene::MeshType::rail;
  rail.rail.zone = scene::ZoneBand::contact;
  rail.line = 4;
  scene.meshes = {wheel, rail};
  scene::Part upper, lower;
  upper.name = upper.mesh = "wheel";
  upper.position = {0, lateral, 0.62};
  lower.name = lower.mesh = "rail";
  scene.parts = {upper, lower};
  scene::Contact contact;
  contact.name = "tread";
  contact.slave = "wheel.tread";
  contact.master = "rail.head";
  contact.line = 5;
  scene.contacts = {contact};
  return scene;
}

/// Least and largest y of a surface of its mesh.
std::pair<double, double> ends_across(const scene::MeshSource& source, const std::string& surface) {
  const Mesh mesh = build_mesh(source);
  double first = 1, last = -1;
  for (const Face& face : mesh.surfaces.at(surface))
    for (int n : mesh.face_nodes(face)) {
      first = std::min(first, mesh.nodes[n][1]);
      last = std::max(last, mesh.nodes[n][1]);
    }
  return {first, last};
}

const scene::WheelMesh& wheel_of(const scene::Scene& scene) { return scene.meshes[0].wheel; }
const scene::RailMesh& rail_of(const scene::Scene& scene) { return scene.meshes[1].rail; }

}  // namespace

TEST_CASE("round profiles meet where their normals do, and a turned wheel ahead of its axle") {
  // Two arcs of radii a and b whose middles are d apart: the touching place has the angle d / (a + b).
  const double nominal = 0.46, across = 0.2, rail = 0.3, lateral = 0.01;
  const ProfileContact profiles = arcs(nominal, across, rail);
  const auto upright = profiles.meetings({lateral, 0, 0}, 1e-5);
  REQUIRE(upright.size() == 1);
  const double angle = std::asin(lateral / (across + rail));
  CHECK_THAT(std::abs(upright[0].angle), WithinAbs(angle, 1e-4));
  CHECK_THAT(upright[0].rail.y, WithinAbs(rail * std::sin(angle), 2e-5));
  CHECK_THAT(upright[0].wheel.y, WithinAbs(-across * std::sin(angle), 2e-5));
  CHECK_THAT(upright[0].ahead, WithinAbs(0, 1e-12));

  // At a slope R' of the tread the lowest outline of a wheel with yaw psi lies R R' tan(psi) behind the axle (Taylor).
  const double yaw = 0.02, slope = std::tan(angle);
  const auto turned = profiles.meetings({lateral, yaw, 0}, 1e-5);
  REQUIRE(turned.size() == 1);
  CHECK_THAT(std::abs(turned[0].ahead), WithinRel(nominal * slope * std::tan(yaw), 0.02));
  // The mirrored scene meets ahead where this meets behind.
  CHECK_THAT(profiles.meetings({-lateral, yaw, 0}, 1e-5)[0].ahead, WithinAbs(-turned[0].ahead, 1e-6));

  // Rolled by phi about its origin, the wheel's middle goes aside by nominal times phi and its profile leans.
  const double roll = 0.01;
  const auto rolled = profiles.meetings({0, 0, roll}, 1e-5);
  REQUIRE(rolled.size() == 1);
  const double centre = (nominal - across) * std::sin(roll);  // of the arc, from the axle's middle
  CHECK_THAT(rolled[0].rail.y, WithinAbs(rail * centre / (across + rail), 3e-5));
}

TEST_CASE("pieces that come near each other grow as those of two arcs do") {
  const ProfileContact profiles = arcs(0.46, 0.2, 0.3);
  const double relative = 1 / (1 / 0.2 + 1 / 0.3), reach = std::sqrt(2 * relative * 1e-4);
  const NearPieces pieces = profiles.near({0, 0, 0}, 1e-4);
  CHECK_THAT(pieces.wheel[0], WithinRel(-reach, 0.01));
  CHECK_THAT(pieces.wheel[1], WithinRel(reach, 0.01));
  CHECK_THAT(pieces.rail[1], WithinRel(reach, 0.01));
}

TEST_CASE("S1002 on 54E1 at 1:40 meets near the tape circle, and by its flange at 70 degrees") {
  scene::Scene scene = wheel_on_rail(-0.7553 + 0.75);  // 1435 mm of gauge, flange backs 1360 mm apart
  scene.contacts[0].zone_lateral_end = 7 * mm;
  const auto lines = place_contact_zones(scene);
  REQUIRE(lines.size() >= 5);
  CHECK_THAT(lines.front(), ContainsSubstring("the profiles meet at -9.9 mm from its tape circle"));
  CHECK_THAT(lines[lines.size() - 3], ContainsSubstring("contact angle 70.0 deg"));
  CHECK(wheel_of(scene).zone == scene::ZoneBand::given);
  // The flange's straight face lies 38.4 to 39.8 mm from the tape circle, the gauge corner's end 37.9 mm from the
  // rail's middle; the margin is beyond, but of the field side nothing.
  const auto [wheel_first, wheel_last] = ends_across(scene.meshes[0], "tread");
  CHECK(wheel_first < -0.0398);
  CHECK(wheel_last < 0.016);
  const auto [rail_first, rail_last] = ends_across(scene.meshes[1], "head");
  CHECK(rail_first < -0.0377);
  CHECK(rail_last < 0.011);
}

TEST_CASE("a band without lateral motion is the patch and the margin, and moves with the wheel") {
  double before = 1;
  for (double lateral : {-8 * mm, -5.3 * mm, -3 * mm}) {
    scene::Scene scene = wheel_on_rail(lateral);
    place_contact_zones(scene);
    CHECK(rail_of(scene).zone_width < 0.045);
    CHECK(rail_of(scene).zone_centre < before);  // the wheel's way outwards brings the rail's inner side nearer
    before = rail_of(scene).zone_centre;
  }
}

TEST_CASE("the mirrored scene has the same bands") {
  scene::Scene left = wheel_on_rail(-3 * mm), right = left;
  left.contacts[0].zone_lateral_end = 6 * mm;
  right.contacts[0].zone_lateral_end = -6 * mm;
  for (scene::Part& part : right.parts) part.mirror = true, part.position[1] *= -1;
  place_contact_zones(left);
  place_contact_zones(right);
  CHECK_THAT(wheel_of(right).zone_centre, WithinAbs(wheel_of(left).zone_centre, 1e-9));
  CHECK_THAT(wheel_of(right).zone_width, WithinAbs(wheel_of(left).zone_width, 1e-9));
  CHECK_THAT(rail_of(right).zone_centre, WithinAbs(rail_of(left).zone_centre, 1e-9));
}

TEST_CASE("a wheelset's two wheels find their own rails") {
  scene::Scene scene = wheel_on_rail(0);
  scene.meshes[0].type = scene::MeshType::wheelset;
  scene.meshes[0].wheelset.zone = scene::ZoneBand::contact;
  scene::Part other = scene.parts[1];
  scene.parts[1].position[1] = 0.7553;
  other.name = "other";
  other.position[1] = -0.7553;
  other.mirror = true;
  scene.parts.push_back(other);
  scene.contacts[0].master = {"rail.head", "other.head"};
  scene::Scene half = scene;
  half.meshes[0].wheelset.half = true;
  half.contacts[0].master = "rail.head";
  place_contact_zones(scene);
  place_contact_zones(half);
  CHECK_THAT(scene.meshes[0].wheelset.zone_centre, WithinAbs(half.meshes[0].wheelset.zone_centre, 1e-9));
  CHECK_THAT(scene.meshes[0].wheelset.zone_width, WithinAbs(half.meshes[0].wheelset.zone_width, 1e-9));
  // Moved aside, the one wheel comes nearer to its gauge corner and the other goes away from it: both count.
  scene::Scene aside = scene;
  aside.meshes[0].wheelset.zone = scene::ZoneBand::contact;
  aside.contacts[0].zone_lateral_start = aside.contacts[0].zone_lateral_end = 4 * mm;
  place_contact_zones(aside);
  CHECK(aside.meshes[0].wheelset.zone_width > scene.meshes[0].wheelset.zone_width);
}

TEST_CASE("a zone by contact is refused where there is nothing to find") {
  const auto complaint = [](scene::Scene scene) {
    try {
      place_contact_zones(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  scene::Scene none = wheel_on_rail(0);
  none.contacts.clear();
  CHECK_THAT(complaint(none), ContainsSubstring("case.toml:3: [meshes.wheel] zone = \"contact\" needs a contact"));
  CHECK_THAT(complaint(wheel_on_rail(0.5)),
             ContainsSubstring("case.toml:5: [contacts.tread] zone = \"contact\" finds no"));
  scene::Scene given = wheel_on_rail(0);
  given.meshes[0].wheel.zone = given.meshes[1].rail.zone = scene::ZoneBand::given;
  CHECK(complaint(given).empty());
  given.contacts[0].zone_roll = 0.01;
  CHECK_THAT(complaint(given), ContainsSubstring("have no effect"));
}
