// Creepages from the motion of both bodies: rigid bodies of known motion give their exact creepages.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "post/contact_tables.hpp"
#include "post/patch_ways.hpp"
#include "tests/post/hertz_contact.hpp"
#include "tests/post/made_up_surfaces.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double radius = 0.46, speed = 30;

/// A wheel of 0.46 m over x = `travelled` that rolls along +x with `rotation` on a rail that yields with `rail`: only
/// rigid motions.
ContactState rolling(double travelled, const Vector& wheel_velocity, const Vector& rotation, const Vector& rail) {
  const Vector axle(travelled, 0, radius);
  ContactSide wheel = made_up_side(60, 40, false, [&](int i, int j) {
    const double angle = 1e-3 * (i - 29.7) / radius;
    return Vector(axle + Vector(radius * std::sin(angle), 1.1e-3 * (j - 19.6), -radius * std::cos(angle)));
  });
  ContactSide track = made_up_side(
      70, 44, true, [&](int i, int j) { return Vector(travelled + 1e-3 * (i - 33.4), 1e-3 * (j - 21.2), 0); });
  set_vectors(wheel, wheel.velocity,
              [&](const Vector& p) { return Vector(wheel_velocity + rotation.cross(p - axle)); });
  set_vectors(track, track.velocity, [&](const Vector&) { return rail; });
  HertzContact hertz;
  hertz.centre_x = travelled;
  press(
      wheel, [&](const Vector& p) { return hertz.pressure(p[0], p[1]); },
      [](const Vector&) { return Vector(Vector::Zero()); });
  return made_up_state(std::move(wheel), std::move(track), 0.4);
}

}  // namespace

TEST_CASE("creepages of a rigid wheel: slip of the wheel on the rail over the rolling velocity, as CONTACT's") {
  const double longitudinal = GENERATE(-3e-3, 0.0, 5e-3), lateral = GENERATE(0.0, 2e-3), spin = 0.5;
  // At the rail's top the wheel moves with axle velocity - rotation x radius: a faster rotation slips it backwards.
  const Vector wheel_velocity(speed, lateral * speed, 0), rail(0.1, -0.02, 0.03);
  const Vector rotation(0, speed / radius * (1 - longitudinal), spin * speed);
  ContactTables tables;
  std::vector<PatchInstant> instants;
  for (int i = 0; i < 5; ++i) {
    const ContactState state = rolling(6e-3 * i, wheel_velocity, rotation, rail);
    const ContactSolution solution = contact_solution(state);
    REQUIRE(solution.patches.size() == 1);
    tables.add(6e-3 * i / speed, state, solution);
    instants.push_back({6e-3 * i / speed, true, solution.whole.frame.centre, 6.5e-3});
  }
  const std::vector<Vector> travel = patch_velocity(instants);
  for (const Vector& velocity : travel) CHECK_THAT(velocity[0], WithinRel(speed, 1e-9));
  tables.set_patch_velocity(travel);
  for (std::size_t row = 0; row < tables.patches.row_count(); ++row) {
    const auto vector_of = [&](const std::string& name) {
      return Vector(tables.patches.at(row, name + "_x"), tables.patches.at(row, name + "_y"),
                    tables.patches.at(row, name + "_z"));
    };
    const double rolling_velocity = tables.patches.at(row, "rolling_velocity");
    const Vector axle(6e-3 * (row / 2), 0, radius);
    const Vector slip = wheel_velocity + rotation.cross(vector_of("centre") - axle) - rail;
    CHECK((slip - Vector(longitudinal * speed - rail[0], lateral * speed - rail[1], -rail[2])).norm() <
          2e-2);  // centre: 0.1 mm high
    // Both surfaces move a little: so much less passes through the patch.
    CHECK_THAT(rolling_velocity, WithinRel(speed - (0.5 * slip + rail).dot(vector_of("along")), 1e-9));
    CHECK_THAT(tables.patches.at(row, "longitudinal_creepage") * rolling_velocity,
               WithinAbs(slip.dot(vector_of("along")), 1e-9));
    CHECK_THAT(tables.patches.at(row, "lateral_creepage") * rolling_velocity,
               WithinAbs(slip.dot(vector_of("across")), 1e-9));
    CHECK_THAT(tables.patches.at(row, "spin_creepage") * rolling_velocity, WithinAbs(spin * speed, 1e-6));
    CHECK_THAT(tables.patches.at(row, "longitudinal_creepage_spread"), WithinAbs(0, 1e-10));
    CHECK_THAT(tables.patches.at(row, "spin_creepage_spread"), WithinAbs(0, 1e-8));
  }
}

TEST_CASE("turned about the vertical the same contact has the same creepages") {
  ContactState state = rolling(0, Vector(speed, 0.06, 0), Vector(0, 65, 10), Vector::Zero());
  const RigidSlip before = contact_solution(state).patches.at(0).rigid_slip;
  const Eigen::AngleAxisd turn(M_PI, Vector::UnitZ());
  for (ContactSide* side : {&state.slave, &state.master})
    for (auto* vectors :
         {&side->position, &side->velocity, &side->normal, &side->normal_force, &side->tangential_force})
      for (std::size_t i = 0; i < side->nodes.size(); ++i) {
        const Vector turned = turn * entry(*vectors, i);
        for (int c = 0; c < 3; ++c) (*vectors)[3 * i + c] = turned[c];
      }
  PatchOptions options;
  options.rolling = -Vector::UnitX();
  const RigidSlip after = contact_solution(state, options).patches.at(0).rigid_slip;
  REQUIRE(std::fabs(before.along) > 0.1);
  CHECK_THAT(after.along, WithinRel(before.along, 1e-9));
  CHECK_THAT(after.across, WithinRel(before.across, 1e-9));
  CHECK_THAT(after.spin, WithinRel(before.spin, 1e-9));
}

TEST_CASE("a ring without nodes gives no creepage") {
  const ContactState state = rolling(0, Vector(speed, 0, 0), Vector(0, 65, 0), Vector::Zero());
  PatchOptions options;
  options.ring = {20, 30};
  const ContactSolution solution = contact_solution(state, options);
  CHECK_FALSE(solution.whole.rigid_slip.known);
  ContactTables tables;
  tables.add(0, state, solution);
  tables.set_rolling_velocity(speed);
  CHECK(std::isnan(tables.patches.at(0, "longitudinal_creepage")));
}

TEST_CASE("a least-squares motion: exact for a rigid body, residual otherwise, unknown on a line") {
  ContactSide side = made_up_side(9, 7, true, [](int i, int j) { return skewed_place(i, j, 2e-3); });
  const std::vector<int> ring = nodes_in_ring(side, Vector(8e-3, 6e-3, 0), 3e-3, 9e-3);
  REQUIRE(ring.size() > 10);
  for (const int node : ring) {
    const double distance = (entry(side.position, node) - Vector(8e-3, 6e-3, 0)).norm();
    CHECK((distance >= 3e-3 && distance <= 9e-3));
  }
  const Vector about(1, 2, 3), velocity(-4, 5, 6), rotation(70, -80, 90);
  set_vectors(side, side.velocity, [&](const Vector& p) { return Vector(velocity + rotation.cross(p - about)); });
  const RigidMotion motion = fit_rigid_motion(side, ring, about + Vector(-1, -2, -3));
  CHECK((motion.velocity - (velocity + rotation.cross(Vector(-1, -2, -3)))).norm() < 1e-9);
  CHECK((motion.rotation - rotation).norm() < 1e-7);
  CHECK(motion.residual < 1e-9);
  set_vectors(side, side.velocity, [&](const Vector& p) { return Vector(100 * (p[0] - 8e-3), 0, 0); });  // stretches
  CHECK(fit_rigid_motion(side, ring, Vector(8e-3, 6e-3, 0)).residual > 0.1);
  CHECK(fit_rigid_motion(side, {0}, about).nodes == 0);
  ContactSide line = made_up_side(9, 2, true, [](int i, int j) { return Vector(1e-3 * i, 1e-3 * j, 0); });
  CHECK(fit_rigid_motion(line, {0, 1, 2, 3, 4, 5, 6, 7, 8}, Vector::Zero()).nodes == 0);
}

TEST_CASE("the velocity of a patch from its travel") {
  std::vector<PatchInstant> instants;
  for (int i = 0; i < 40; ++i)
    instants.push_back({1e-5 * i, i != 7, Vector(20 * 1e-5 * i + 1e-5 * std::sin(2.0 * i), 0, 0), 5e-4});
  const std::vector<Vector> velocity = patch_velocity(instants);
  CHECK(std::isnan(velocity[7][0]));
  for (const int i : {3, 12, 20, 39})
    CHECK_THAT(velocity[i][0], WithinAbs(20, 0.4));  // the centres shift by 1 % of the way
  for (PatchInstant& instant : instants) instant.centre = Vector(1e-4 * std::sin(1e5 * instant.time), 0, 0);
  for (const Vector& v : patch_velocity(instants)) CHECK(std::isnan(v[0]));
}
