// The contact solution of a Hertzian patch against its exact area, peaks and forces.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "post/contact_patch.hpp"
#include "post/patch_shape.hpp"
#include "tests/post/hertz_contact.hpp"
#include "tests/post/made_up_surfaces.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

HertzGrid shifted_grid(double fraction_x, double fraction_y) {
  HertzGrid grid;
  grid.x0 += fraction_x * grid.dx;
  grid.y0 += fraction_y * grid.dy;
  return grid;
}

}  // namespace

TEST_CASE("a Hertzian patch of 13 x 10 mm on 1 mm cells, wherever the nodes lie") {
  const double shift_x = GENERATE(0.0, 0.2, 0.4, 0.6, 0.8), shift_y = GENERATE(0.05, 0.35, 0.65, 0.95);
  const HertzContact hertz;
  const ContactState state = hertz_contact_state(hertz, shifted_grid(shift_x, shift_y), HertzForces::sampled);
  const ContactSolution solution = contact_solution(state);
  REQUIRE(solution.patches.size() == 1);
  const ContactPatch& s = solution.patches[0];
  CHECK_THAT(s.area,
             WithinRel(hertz.area(), 0.007));  // the polygon lies inside the ellipse: 0.45 % too small on average
  CHECK_THAT(s.area_by_count, WithinRel(hertz.area(), 0.045));
  CHECK_THAT(s.peak_nodal_pressure, WithinRel(hertz.p0, 0.01));
  CHECK(s.peak_nodal_pressure <= hertz.p0);
  CHECK_THAT(s.peak_facet_pressure, WithinRel(hertz.p0, 0.02));
  CHECK_THAT(s.normal_force, WithinRel(hertz.normal_force(), 0.013));
  CHECK_THAT(s.creep_force, WithinRel(hertz.creep_force(), 0.015));
  CHECK_THAT(s.lateral_force, WithinAbs(0, 1e-9 * hertz.normal_force()));
  CHECK_THAT(s.traction_coefficient, WithinRel(s.creep_force / s.normal_force, 1e-12));
  CHECK_THAT(s.frame.centre[0], WithinAbs(hertz.centre_x, 0.1e-3));
  CHECK_THAT(s.frame.normal[2], WithinAbs(1, 1e-12));
  CHECK_THAT(s.ellipse.semi_axis_along,
             WithinRel(hertz.a, 0.021));  // the rim between the last nodes and the edge is not seen
  CHECK_THAT(s.ellipse.semi_axis_across, WithinRel(hertz.b, 0.021));
}

TEST_CASE("consistent nodal forces carry the whole force") {
  const HertzContact hertz;
  const ContactPatch s =
      contact_solution(hertz_contact_state(hertz, shifted_grid(0.3, 0.1), HertzForces::consistent)).whole;
  CHECK_THAT(s.normal_force, WithinRel(hertz.normal_force(), 1e-4));
  CHECK_THAT(s.creep_force, WithinRel(hertz.creep_force(), 1e-4));
  CHECK_THAT(s.traction_coefficient, WithinRel(hertz.creep_force() / hertz.normal_force(), 1e-4));
}

TEST_CASE("nodes slip by their force and by their velocity alike") {
  const HertzContact hertz;
  const ContactState state = hertz_contact_state(hertz, shifted_grid(0.3, 0.1), HertzForces::sampled);
  const ContactPatch s = contact_solution(state).whole;
  int expected = 0;
  for (const int slipping : state.slipping) expected += slipping == 2;
  REQUIRE(expected > 20);
  REQUIRE(expected < static_cast<int>(s.touching.size()));
  CHECK(count_of(s.regions.by_solver) == expected);
  CHECK(count_of(s.regions.by_velocity) == expected);
  CHECK(count_of(s.regions.by_force) == expected);
}

TEST_CASE("forces below the threshold are no contact") {
  HertzContact hertz;
  hertz.p0 = 500;  // 0.0005 N on a node of 1 mm2
  const ContactPatch s = contact_solution(hertz_contact_state(hertz, {}, HertzForces::sampled)).whole;
  CHECK(s.touching.empty());
  CHECK(s.area == 0);
  CHECK(s.traction_coefficient == 0);
}

TEST_CASE("the tangent plane turns with the patch") {
  // The whole contact turned by 60 degrees about x, as on a flange.
  ContactState state = hertz_contact_state(HertzContact{}, {}, HertzForces::sampled);
  const double c = 0.5, s = std::sqrt(0.75);
  for (auto* vectors :
       {&state.slave.position, &state.slave.normal, &state.slave.normal_force, &state.slave.tangential_force})
    for (std::size_t i = 0; i + 2 < vectors->size(); i += 3) {
      const double y = (*vectors)[i + 1], z = (*vectors)[i + 2];
      (*vectors)[i + 1] = c * y - s * z;
      (*vectors)[i + 2] = s * y + c * z;
    }
  const ContactPatch flat = contact_solution(hertz_contact_state(HertzContact{}, {}, HertzForces::sampled)).whole;
  const ContactPatch turned = contact_solution(state).whole;
  CHECK_THAT(turned.normal_force, WithinRel(flat.normal_force, 1e-12));
  CHECK_THAT(turned.creep_force, WithinRel(flat.creep_force, 1e-12));
  CHECK_THAT(turned.lateral_force, WithinAbs(0, 1e-9 * flat.normal_force));
  CHECK_THAT(turned.area, WithinRel(flat.area, 1e-12));
}

TEST_CASE("two patches of their own sizes and directions are told apart") {
  HertzContact tread, flange;
  flange.a = 4e-3;
  flange.b = 2e-3;
  flange.centre_x = 5e-3;
  flange.p0 = 1.4e9;
  // The surface turns by 60 degrees at y = 8 mm, beyond which y is measured along it.
  const auto place = [](int i, int j) {
    const double x = 0.5e-3 * (i - 20), s = 0.5e-3 * (j - 13);
    return s < 8e-3 ? Vector(x, s, 0) : Vector(x, 8e-3 + 0.5 * (s - 8e-3), std::sqrt(0.75) * (s - 8e-3));
  };
  ContactSide slave = made_up_side(45, 50, false, place), master = made_up_side(45, 50, true, place);
  press(
      slave,
      [&](const Vector& p) {
        return p[2] > 0 ? flange.pressure(p[0], 2 * (p[1] - 8e-3) - 4e-3) : tread.pressure(p[0], p[1]);
      },
      [&](const Vector& p) { return p[2] > 0 ? Vector(0, 0, 1e8) : Vector(tread.shear(p[0], p[1]), 0, 0); });
  const ContactSolution solution = contact_solution(made_up_state(std::move(slave), std::move(master), tread.friction));
  REQUIRE(solution.patches.size() == 2);
  const ContactPatch &first = solution.patches[0], &second = solution.patches[1];
  CHECK_THAT(first.normal_force, WithinRel(tread.normal_force(), 0.01));
  CHECK_THAT(second.normal_force, WithinRel(flange.normal_force(), 0.03));
  CHECK_THAT(first.area, WithinRel(tread.area(), 0.007));
  CHECK_THAT(second.area, WithinRel(flange.area(), 0.02));
  CHECK_THAT(second.ellipse.semi_axis_along, WithinRel(flange.a, 0.03));
  CHECK_THAT(second.ellipse.semi_axis_across, WithinRel(flange.b, 0.03));
  CHECK_THAT(first.frame.normal[2], WithinAbs(1, 1e-9));
  CHECK_THAT(second.frame.normal[1], WithinAbs(-std::sqrt(0.75), 1e-9));
  CHECK_THAT(second.frame.across[2], WithinAbs(std::sqrt(0.75), 1e-9));
  CHECK_THAT(second.frame.centre[0], WithinAbs(flange.centre_x, 0.1e-3));
  CHECK(solution.stray_nodes == 0);
}

TEST_CASE("the zero line on a graded and skewed mesh") {
  // Cells from 0.6 to 1.2 mm, mesh lines that meet at 70 degrees: straight lines still, so only the polygon errs.
  const HertzContact hertz;
  HertzGrid grid;
  grid.nx = 31;
  grid.ny = 25;
  ContactSide side = hertz_contact_state(hertz, grid, HertzForces::sampled).slave;
  std::vector<double> pressure;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const double u = (i - 15.3) / 15, v = (j - 12.4) / 12;
      const double along = 9e-3 * u * (1 + 0.3 * u * u), across = 8e-3 * v * (1 + 0.3 * v * v);
      const std::size_t node = static_cast<std::size_t>(j) * grid.nx + i;
      side.position[3 * node] = along + across * std::cos(1.2217);
      side.position[3 * node + 1] = across * std::sin(1.2217);
      pressure.push_back(hertz.pressure(side.position[3 * node], side.position[3 * node + 1]));
    }
  CHECK_THAT(patch_area(side, FacetsAroundNodes(side), pressure), WithinRel(hertz.area(), 0.006));
}

TEST_CASE("a single node in contact counts as half a cell each way") {
  const ContactSide side =
      hertz_contact_state(HertzContact{}, HertzGrid{0, 0, 1e-3, 1e-3, 5, 5}, HertzForces::sampled).slave;
  std::vector<double> pressure(25, 0.0);
  pressure[12] = 1e8;
  CHECK_THAT(patch_area(side, FacetsAroundNodes(side), pressure),
             WithinRel(0.5e-6, 1e-12));  // the square that joins the four mid-points
}
