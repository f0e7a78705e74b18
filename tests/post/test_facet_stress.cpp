// Facet stresses of eq. 3.3 on facets of any size.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "output/fields/contact_section.hpp"
#include "post/facet.hpp"
#include "tests/post/hertz_contact.hpp"
#include "tests/post/made_up_surfaces.hpp"

using namespace railwave;
using Catch::Matchers::WithinRel;

TEST_CASE("stresses times areas of graded, skewed facets add up to the nodal forces") {
  const HertzContact hertz;
  ContactSide side = made_up_side(
      27, 24, false, [](int i, int j) { return Vector(skewed_place(i, j, 0.7e-3) - Vector(14e-3, 10e-3, 0)); });
  press(
      side, [&](const Vector& p) { return hertz.pressure(p[0], p[1]); },
      [&](const Vector& p) { return Vector(hertz.shear(p[0], p[1]), 0, 0); });
  const std::vector<double> pressure = nodal_pressure(side);
  double nodal = 0, nodal_shear_force = 0, facets = 0, shear_force = 0;
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    nodal += pressure[i] * side.area[i];
    nodal_shear_force += side.tangential_force[3 * i];
  }
  for (int f = 0; f < static_cast<int>(side.facets.size()); ++f) {
    const FacetStress stress = facet_stress(side, f, pressure);
    facets += stress.pressure * facet_area(side, f);
    shear_force += stress.shear[0] * facet_area(side, f);
  }
  REQUIRE(nodal > 5e4);
  CHECK_THAT(facets, WithinRel(nodal, 1e-12));
  CHECK_THAT(shear_force, WithinRel(nodal_shear_force, 1e-12));
}

TEST_CASE("on squares it is the sum of nodal forces over 4 l2") {
  ContactSide side = made_up_side(4, 4, false, [](int i, int j) { return Vector(1e-3 * i, 1e-3 * j, 0); });
  press(
      side, [](const Vector& p) { return 1e8 * (1 + 300 * p[0] + 500 * p[1]); },
      [](const Vector&) { return Vector(0, 2e7, 0); });
  const std::vector<double> pressure = nodal_pressure(side);
  const int middle = 4;  // its corners have whole squares all around
  double sum = 0;
  for (const int corner : side.facets[middle]) sum += side.normal_force[3 * corner + 2];
  const FacetStress stress = facet_stress(side, middle, pressure);
  CHECK_THAT(stress.pressure, WithinRel(sum / (4 * 1e-6), 1e-12));
  CHECK_THAT(stress.shear[1], WithinRel(2e7, 1e-12));
}

TEST_CASE("an even pressure is even on uneven facets, with the edge's nodes outside counted as none") {
  ContactSide side = made_up_side(9, 9, false, [](int i, int j) { return skewed_place(i, j, 1e-3); });
  press(
      side, [](const Vector&) { return 3e8; }, [](const Vector&) { return Vector(Vector::Zero()); });
  std::vector<double> pressure = nodal_pressure(side);
  for (int f = 0; f < static_cast<int>(side.facets.size()); ++f)
    CHECK_THAT(facet_stress(side, f, pressure).pressure, WithinRel(3e8, 1e-12));
  pressure[side.facets[0][0]] = 0;
  CHECK_THAT(facet_stress(side, 0, pressure).pressure, WithinRel(2.25e8, 1e-12));
}
