// The interpolation of thesis 3.4.2: on rectangles eq. 3.4, on other facets exact for linear fields.

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "post/facet.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

namespace {

const FacetCorners rectangle{Vector(0, 0, 0), Vector(2, 0, 0), Vector(2, 1, 0), Vector(0, 1, 0)};
const FacetCorners warped{Vector(0.1, -0.2, 0.02), Vector(2.2, 0.1, -0.03), Vector(1.7, 1.3, 0.05),
                          Vector(-0.2, 0.9, -0.01)};

Vector point_of(const FacetCorners& corners, const FacetPlace& place) {
  Vector sum = Vector::Zero();
  for (int k = 0; k < 4; ++k) sum += place.shares[k] * corners[k];
  return sum;
}

}  // namespace

TEST_CASE("on a rectangle the shares are the products of distances to its sides") {
  const double x = GENERATE(0.0, 0.3, 1.1, 2.0), y = GENERATE(0.0, 0.45, 0.9);
  const FacetPlace place = nearest_on_facet(rectangle, Vector(x, y, 0.01));
  // Eq. 3.4 with l1 = x, l2 = 2 - x, l3 = y, l4 = 1 - y for corners in the order low left, low right, high left, high
  // right.
  const double expected[4] = {(2 - x) * (1 - y) / 2, x * (1 - y) / 2, x * y / 2, (2 - x) * y / 2};
  for (int k = 0; k < 4; ++k) CHECK_THAT(place.shares[k], WithinAbs(expected[k], 1e-12));
  CHECK(place.inside);
  CHECK_THAT(place.distance, WithinAbs(0.01, 1e-12));
}

TEST_CASE("a point above a warped facet finds its foot") {
  const double xi = GENERATE(-0.9, -0.2, 0.5, 1.0), eta = GENERATE(-1.0, 0.1, 0.8);
  FacetPlace exact;
  exact.xi = xi;
  exact.eta = eta;
  exact.shares = {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta), 0.25 * (1 + xi) * (1 + eta),
                  0.25 * (1 - xi) * (1 + eta)};
  const Vector normal = facet_normal(warped, exact);
  const FacetPlace place = nearest_on_facet(warped, point_of(warped, exact) - 0.02 * normal);
  CHECK(place.inside);
  CHECK_THAT(place.xi, WithinAbs(xi, 1e-10));
  CHECK_THAT(place.eta, WithinAbs(eta, 1e-10));
  CHECK_THAT(place.distance, WithinAbs(0.02, 1e-10));
}

TEST_CASE("beyond a side the nearest place is on it") {
  const FacetPlace beside = nearest_on_facet(rectangle, Vector(0.5, 1.5, 0));
  CHECK_FALSE(beside.inside);
  CHECK((point_of(rectangle, beside) - Vector(0.5, 1, 0)).norm() < 1e-12);
  CHECK_THAT(beside.distance, WithinAbs(0.5, 1e-12));
  const FacetPlace corner = nearest_on_facet(warped, Vector(5, 5, 0));
  CHECK((point_of(warped, corner) - warped[2]).norm() < 1e-12);
}
