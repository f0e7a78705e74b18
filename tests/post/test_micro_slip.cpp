// Micro-slip by eq. 3.4 and 3.5, between surfaces whose nodes do not match.

#include <catch2/catch_test_macros.hpp>

#include "post/micro_slip.hpp"
#include "tests/post/made_up_surfaces.hpp"

using namespace railwave;

namespace {

std::vector<int> all_nodes(const ContactSide& side) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < side.nodes.size(); ++i) nodes.push_back(static_cast<int>(i));
  return nodes;
}

std::vector<RelativeMotion> motion_of(const ContactSide& slave, const ContactSide& master) {
  const FacetsAroundNodes around(master);
  return relative_motion(slave, all_nodes(slave), master, SurfaceSearch(master, around));
}

}  // namespace

TEST_CASE("linear velocity fields are interpolated exactly on skewed, graded facets of another size") {
  ContactSide master = made_up_side(
      21, 19, true, [](int i, int j) { return Vector(skewed_place(i, j, 1.3e-3) - Vector(4e-3, 4e-3, 0)); });
  ContactSide slave = made_up_side(
      14, 11, false, [](int i, int j) { return Vector(skewed_place(i, j, 0.8e-3) + Vector(2e-3, 0.5e-3, -3e-6)); });
  const auto of_master = [](const Vector& p) {
    return Vector(0.2 + 30 * p[0] - 8 * p[1], -0.1 + 5 * p[1] + 11 * p[0], 2 * p[0]);
  };
  const auto of_slave = [](const Vector& p) { return Vector(-0.3 + 7 * p[1], 12 * p[0], 0.05 - 9 * p[1]); };
  set_vectors(master, master.velocity, of_master);
  set_vectors(slave, slave.velocity, of_slave);
  const std::vector<RelativeMotion> motion = motion_of(slave, master);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    REQUIRE(motion[i].known);
    const Vector place = entry(slave.position, i), exact = of_slave(place) - of_master(Vector(place[0], place[1], 0));
    CHECK((motion[i].slip - Vector(exact[0], exact[1], 0)).norm() < 1e-10);
    CHECK(std::fabs(motion[i].parting - exact[2]) < 1e-10);
  }
}

TEST_CASE("two bodies that move as one do not slip, on a curved surface either") {
  const auto tunnel = [](double x, double y, double depth) {
    return Vector(x, (0.1 + depth) * std::sin(y / 0.1), (0.1 + depth) * std::cos(y / 0.1));
  };
  ContactSide master = made_up_side(20, 20, true, [&](int i, int j) { return tunnel(1.1e-3 * i, 1e-3 * (j - 10), 0); });
  ContactSide slave =
      made_up_side(9, 9, false, [&](int i, int j) { return tunnel(5e-3 + 0.9e-3 * i, 1.2e-3 * (j - 4.3), -2e-6); });
  const auto rigid = [](const Vector& p) { return Vector(Vector(3, -1, 2) + Vector(10, 20, -30).cross(p)); };
  set_vectors(master, master.velocity, rigid);
  set_vectors(slave, slave.velocity, rigid);
  for (const RelativeMotion& motion : motion_of(slave, master)) {
    REQUIRE(motion.known);
    CHECK(motion.slip.norm() < 1e-3);  // 22 rad/s times the gap and the chords' sagitta, 1.25 um
    CHECK(std::fabs(motion.parting) < 1e-3);
  }
}

TEST_CASE("a node beside the master has no micro-slip to tell") {
  const ContactSide master = made_up_side(5, 5, true, [](int i, int j) { return Vector(1e-3 * i, 1e-3 * j, 0); });
  const ContactSide slave =
      made_up_side(2, 2, false, [](int i, int j) { return Vector(3.5e-3 + 1e-3 * i, 1e-3 + 1e-3 * j, 0); });
  const std::vector<RelativeMotion> motion = motion_of(slave, master);
  CHECK(motion[0].known);
  CHECK_FALSE(motion[1].known);
}

TEST_CASE("both criteria of eq. 3.6, and by how much they agree") {
  ContactSide slave = made_up_side(6, 1, false, [](int i, int) { return Vector(1e-3 * i, 0, 0); });
  ContactState state = made_up_state(slave, slave, 0.5);
  const std::vector<double> shear = {1.0,  0.4999, 0.4985,
                                     0.49, 0.2,    0.0};  // over a bound of 1, 0.5, 0.5, ...; tolerance 0.003
  for (int i = 0; i < 6; ++i) {
    state.slave.normal_force[3 * i + 2] = i == 0 ? 2 : 1;
    state.slave.tangential_force[3 * i] = shear[i];
    state.slipping[i] = i < 2 ? 2 : 1;
  }
  const SlipRegions regions = slip_regions(state, {0, 1, 2, 3, 4, 5}, {0.3, 0.06, 0.04, 0.051, std::nan(""), 0});
  CHECK(regions.by_force == std::vector<bool>{true, true, true, false, false, false});
  CHECK(regions.by_velocity == std::vector<bool>{true, true, false, true, false, false});
  CHECK(regions.by_solver == std::vector<bool>{true, true, false, false, false, false});
  CHECK(agreement(regions.by_force, regions.by_velocity) == 4.0 / 6);
  CHECK(agreement(regions.by_force, regions.by_solver) == 5.0 / 6);
  CHECK(agreement({}, {}) == 1);

  state.friction = 0;
  for (double& force : state.slave.tangential_force) force = 0;
  CHECK(count_of(slip_regions(state, {0, 1}, {0.0, 0.0}).by_force) == 2);  // without friction all slips
}
