#include "post/facet.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {
namespace {

constexpr double rounding = 1e-9;

std::array<double, 4> shape_functions(double xi, double eta) {
  return {0.25 * (1 - xi) * (1 - eta), 0.25 * (1 + xi) * (1 - eta), 0.25 * (1 + xi) * (1 + eta),
          0.25 * (1 - xi) * (1 + eta)};
}

/// r(xi, eta) = middle + xi across + eta along + xi eta twist (eq. 2.24).
struct BilinearMap {
  Vector middle, across, along, twist;

  explicit BilinearMap(const FacetCorners& c)
      : middle(0.25 * (c[0] + c[1] + c[2] + c[3])),
        across(0.25 * (-c[0] + c[1] + c[2] - c[3])),
        along(0.25 * (-c[0] - c[1] + c[2] + c[3])),
        twist(0.25 * (c[0] - c[1] + c[2] - c[3])) {}
  Vector point(double xi, double eta) const { return middle + xi * (across + eta * twist) + eta * along; }
  Vector slope_xi(double eta) const { return across + eta * twist; }
  Vector slope_eta(double xi) const { return along + xi * twist; }
};

/// Gauss-Newton: the distance is small against the facet's size and warp, so what it leaves out is too.
void find_foot(const BilinearMap& map, const Vector& point, double& xi, double& eta) {
  for (int iteration = 0; iteration < 40; ++iteration) {
    const Vector miss = point - map.point(xi, eta), g = map.slope_xi(eta), h = map.slope_eta(xi);
    const double a = g.dot(g), b = g.dot(h), c = h.dot(h), determinant = a * c - b * b;
    if (!(determinant > 0)) return;
    const double step_xi = (c * g.dot(miss) - b * h.dot(miss)) / determinant;
    const double step_eta = (a * h.dot(miss) - b * g.dot(miss)) / determinant;
    // Beyond its sides the bilinear map folds over: a point far away must not run there.
    xi = std::clamp(xi + step_xi, -2.0, 2.0);
    eta = std::clamp(eta + step_eta, -2.0, 2.0);
    if (std::fabs(step_xi) + std::fabs(step_eta) < 1e-12) return;
  }
}

FacetPlace place_at(const BilinearMap& map, const Vector& point, double xi, double eta) {
  FacetPlace place;
  place.xi = xi;
  place.eta = eta;
  place.shares = shape_functions(xi, eta);
  place.distance = (point - map.point(xi, eta)).norm();
  return place;
}

FacetPlace nearest_on_sides(const FacetCorners& corners, const BilinearMap& map, const Vector& point) {
  constexpr double natural[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  FacetPlace nearest;
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    const Vector side = corners[next] - corners[k];
    const double square = side.squaredNorm();
    const double t = square > 0 ? std::clamp((point - corners[k]).dot(side) / square, 0.0, 1.0) : 0.0;
    const FacetPlace place = place_at(map, point, natural[k][0] + t * (natural[next][0] - natural[k][0]),
                                      natural[k][1] + t * (natural[next][1] - natural[k][1]));
    if (k == 0 || place.distance < nearest.distance) nearest = place;
  }
  return nearest;
}

}  // namespace

Vector FacetPlace::interpolate(const ContactSide& side, const std::vector<double>& vectors) const {
  Vector sum = Vector::Zero();
  for (int k = 0; k < 4; ++k) sum += shares[k] * entry(vectors, side.facets[facet][k]);
  return sum;
}

FacetPlace nearest_on_facet(const FacetCorners& corners, const Vector& point) {
  const BilinearMap map(corners);
  double xi = 0, eta = 0;
  find_foot(map, point, xi, eta);
  if (std::max(std::fabs(xi), std::fabs(eta)) > 1 + rounding) return nearest_on_sides(corners, map, point);
  FacetPlace place = place_at(map, point, std::clamp(xi, -1.0, 1.0), std::clamp(eta, -1.0, 1.0));
  place.inside = true;
  return place;
}

Vector facet_normal(const FacetCorners& corners, const FacetPlace& place) {
  const BilinearMap map(corners);
  return map.slope_xi(place.eta).cross(map.slope_eta(place.xi)).normalized();
}

FacetCorners facet_corners(const ContactSide& side, int facet) {
  FacetCorners corners;
  for (int k = 0; k < 4; ++k) corners[k] = entry(side.position, side.facets[facet][k]);
  return corners;
}

FacetStress facet_stress(const ContactSide& side, int facet, const std::vector<double>& pressure) {
  FacetStress stress;
  for (const int corner : side.facets[facet]) {
    if (!(pressure[corner] > 0)) continue;
    stress.pressure += 0.25 * pressure[corner];
    stress.shear += 0.25 / side.area[corner] * entry(side.tangential_force, corner);
  }
  return stress;
}

double facet_area(const ContactSide& side, int facet) {
  const auto& c = side.facets[facet];
  const Vector one = entry(side.position, c[2]) - entry(side.position, c[0]);
  const Vector other = entry(side.position, c[3]) - entry(side.position, c[1]);
  return 0.5 * one.cross(other).norm();
}

}  // namespace railwave
