// Several patches of one contact: each keeps its number by its place, and has its own rolling velocity and creepages.

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

constexpr double speed = 30, interval = 0.2e-3;  // m/s, s: a way of 6 mm, about a semi-axis
constexpr int outputs = 9;

/// Two patches of a wheel that go with it over a rail at rest, one 20 mm ahead of the other and 24 mm beside; while
/// they go, the load passes from one to the other. The wheel turns about the vertical too, so that each slides
/// differently.
struct TwoPatches {
  double spin = 20;    ///< rad/s, about the vertical
  double slide = 0.1;  ///< share of the speed by which the wheel slides

  Vector place(int patch, double time) const {
    return {speed * time + (patch == 0 ? 0.0 : 20e-3), patch == 0 ? -12e-3 : 12e-3, 0};
  }
  double share(int patch, double time) const {
    const double first = 1 - 0.9 * time / (interval * (outputs - 1));
    return patch == 0 ? first : 1.1 - first;
  }
  Vector wheel_velocity(const Vector& p, double time) const {
    const Vector axle(speed * time, 0, 0.46), rotation(0, (1 - slide) * speed / 0.46, spin);
    return Vector(speed, 0, 0) + rotation.cross(p - axle);
  }
  /// @param there which of the two touch
  ContactState state(double time, std::array<bool, 2> there) const {
    const double begin = speed * time - 25e-3;
    ContactSide wheel = made_up_side(
        73, 62, false, [&](int i, int j) { return Vector(begin + 1e-3 * (i - 0.3), 1e-3 * (j - 30.6), 0); });
    ContactSide rail =
        made_up_side(73, 62, true, [&](int i, int j) { return Vector(begin + 1e-3 * i, 1e-3 * (j - 30.2), 0); });
    set_vectors(wheel, wheel.velocity, [&](const Vector& p) { return wheel_velocity(p, time); });
    press(
        wheel,
        [&](const Vector& p) {
          double sum = 0;
          for (int patch = 0; patch < 2; ++patch) {
            HertzContact hertz;
            hertz.centre_x = place(patch, time)[0];
            hertz.centre_y = place(patch, time)[1];
            if (there[patch]) sum += share(patch, time) * hertz.pressure(p[0], p[1]);
          }
          return sum;
        },
        [](const Vector&) { return Vector(Vector::Zero()); });
    return made_up_state(std::move(wheel), std::move(rail), 0.4);
  }
};

SeenPatch seen(double x, double y = 0, double size = 5e-3, bool small = false) {
  return {Vector(x, y, 0), size, small};
}

}  // namespace

TEST_CASE("two patches whose loads cross keep their numbers and have the creepages of the prescribed motion") {
  const TwoPatches scene;
  const int gone = GENERATE(-1, 2, 5);  // output at which the second does not touch
  ContactTables tables;
  PatchWays ways(Vector::UnitX());
  std::vector<double> times;
  for (int i = 0; i < outputs; ++i) {
    const double time = i * interval;
    const ContactState state = scene.state(time, {true, i != gone});
    const ContactSolution solution = contact_solution(state);
    REQUIRE(solution.patches.size() == (i == gone ? 1u : 2u));
    tables.add(time, state, solution, ways.add(time, solution));
  }
  tables.set_velocity_of_rows(ways.velocity_of_rows());
  bool crossed = false;
  int rows = 0;
  double force[2] = {};
  for (std::size_t row = 0; row < tables.patches.row_count(); ++row) {
    const auto value = [&](const char* column) { return tables.patches.at(row, column); };
    if (value("patch") == 0) continue;
    ++rows;
    const int patch = static_cast<int>(value("patch")) - 1;
    REQUIRE((patch == 0 || patch == 1));
    const double time = value("time");
    CHECK((Vector(value("centre_x"), value("centre_y"), 0) - scene.place(patch, time)).norm() < 0.3e-3);
    CHECK_THAT(value("normal_force"), WithinRel(scene.share(patch, time) * HertzContact{}.normal_force(), 0.03));
    force[patch] = value("normal_force");
    crossed = crossed || force[1] > force[0];
    // The patch goes over the rail with the wheel's axle: half of the wheel's slip passes through it the less.
    const Vector slip = scene.wheel_velocity(scene.place(patch, time), time);
    const double rolling = speed - 0.5 * slip[0];
    CHECK_THAT(value("rolling_velocity"), WithinRel(rolling, 0.01));
    CHECK_THAT(value("longitudinal_creepage"), WithinRel(slip[0] / rolling, 0.02));
    CHECK_THAT(value("lateral_creepage"), WithinRel(slip[1] / rolling, 0.02) || WithinAbs(0, 2e-4));
    CHECK_THAT(value("spin_creepage"), WithinRel(scene.spin / rolling, 0.02));
    CHECK(value("small") == 0);
  }
  CHECK(crossed);
  CHECK(rows == 2 * outputs - (gone < 0 ? 0 : 1));
}

TEST_CASE("patches that slide with the slave at speeds of their own have creepages of 2 each") {
  // Two feet in one contact, one at 30 m/s, one at 15 m/s: over a plate at rest each patch moves with its foot.
  ContactTables tables;
  PatchWays ways(Vector::UnitX());
  for (int i = 0; i < 6; ++i) {
    const double time = i * interval;
    const double velocity[2] = {30, 15}, y[2] = {-30e-3, 30e-3};
    ContactSide feet =
        made_up_side(71, 101, false, [&](int k, int j) { return Vector(1e-3 * k - 20e-3, 1e-3 * j - 50e-3, 0); });
    ContactSide plate =
        made_up_side(71, 101, true, [&](int k, int j) { return Vector(1e-3 * k - 20e-3, 1e-3 * j - 50e-3, 0); });
    set_vectors(feet, feet.velocity, [&](const Vector& p) { return Vector(velocity[p[1] > 0], 0, 0); });
    press(
        feet,
        [&](const Vector& p) {
          HertzContact one, other;
          one.centre_x = velocity[0] * time, one.centre_y = y[0];
          other.centre_x = velocity[1] * time, other.centre_y = y[1];
          return (5 - i) * one.pressure(p[0], p[1]) + (i + 0.5) * other.pressure(p[0], p[1]);
        },
        [](const Vector&) { return Vector(Vector::Zero()); });
    const ContactState state = made_up_state(std::move(feet), std::move(plate), 0.4);
    const ContactSolution solution = contact_solution(state);
    tables.add(time, state, solution, ways.add(time, solution));
  }
  tables.set_velocity_of_rows(ways.velocity_of_rows());
  int rows = 0;
  for (std::size_t row = 0; row < tables.patches.row_count(); ++row)
    if (const int patch = static_cast<int>(tables.patches.at(row, "patch")); patch > 0) {
      ++rows;
      CHECK_THAT(tables.patches.at(row, "rolling_velocity"), WithinRel(patch == 1 ? 15.0 : 7.5, 0.02));
      CHECK_THAT(tables.patches.at(row, "longitudinal_creepage"), WithinRel(2.0, 0.02));
    }
  CHECK(rows == 11);  // the last output has lost the first
}

TEST_CASE("numbers go by place: any order, loads aside, also over outputs without a patch") {
  PatchIdentities identities(Vector(2, 0, 0));
  CHECK(identities.numbers(0.0, {seen(0), seen(0, 0.04)}) == std::vector<int>{1, 2});
  // A way of 30 mm in which nothing is known of the speed yet; the order is turned.
  CHECK(identities.numbers(1e-3, {seen(0.03, 0.04), seen(0.03)}) == std::vector<int>{2, 1});
  CHECK(identities.numbers(2e-3, {seen(0.06)}) == std::vector<int>{1});
  CHECK(identities.numbers(3e-3, {seen(0.09, 0.04), seen(0.09)}) == std::vector<int>{2, 1});
  CHECK(identities.numbers(4e-3, {}).empty());
  CHECK(identities.numbers(5e-3, {seen(0.15, 0.04), seen(0.15)}) == std::vector<int>{2, 1});
}

TEST_CASE("a patch elsewhere is a new one, and an island at the edge takes no number away") {
  PatchIdentities identities(Vector::UnitX());
  CHECK(identities.numbers(0.0, {seen(0)}) == std::vector<int>{1});
  CHECK(identities.numbers(1e-4, {seen(0.003), seen(-0.003, 0, 0.5e-3, true)}) == std::vector<int>{1, 2});
  CHECK(identities.numbers(2e-4, {seen(0.006, 0.001), seen(0.006, 0.05)}) == std::vector<int>{1, 3});
  // Only the new one is left; the first comes back.
  CHECK(identities.numbers(3e-4, {seen(0.009, 0.05)}) == std::vector<int>{3});
  CHECK(identities.numbers(4e-4, {seen(0.012, 0.05), seen(0.012, 0.001)}) == std::vector<int>{3, 1});
}

TEST_CASE("a patch that shrinks to a node keeps its number") {
  PatchIdentities identities(Vector::UnitX());
  CHECK(identities.numbers(0.0, {seen(0), seen(0.02)}) == std::vector<int>{1, 2});
  CHECK(identities.numbers(1e-4, {seen(0.023), seen(0.003, 0, 0.6e-3, true)}) == std::vector<int>{2, 1});
  CHECK(identities.numbers(2e-4, {seen(0.006), seen(0.026)}) == std::vector<int>{1, 2});
}
