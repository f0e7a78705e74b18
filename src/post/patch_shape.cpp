#include "post/patch_shape.hpp"

#include <algorithm>
#include <cmath>

#include "post/field_vectors.hpp"

namespace railwave {
namespace {

class Surface {
 public:
  Surface(const ContactSide& side, const FacetsAroundNodes& around, const std::vector<double>& pressure)
      : side_(side), around_(around), pressure_(pressure) {}

  bool inside(int node) const { return pressure_[node] > 0; }
  Vector position(int node) const { return entry(side_.position, node); }

  /// Where the zero line crosses the edge from `in` to `out`.
  Vector crossing(int in, int out) const {
    const Vector start = position(in), edge = position(out) - start;
    const double length = edge.norm();
    return length > 0 ? Vector(start + zero_distance(in, out, length) / length * edge) : start;
  }

 private:
  bool has(int facet, int node) const {
    const auto& corners = side_.facets[facet];
    return std::find(corners.begin(), corners.end(), node) != corners.end();
  }

  /// The next node after `to` on the mesh line that comes from `from`, or -1: joined to `to` by an edge, but with no
  /// facet in common with the edge from-to, and straight ahead within 45 degrees.
  int straight_on(int from, int to) const {
    const Vector ahead = (position(to) - position(from)).normalized();
    int best = -1;
    double best_cosine = std::sqrt(0.5);
    for (const int facet : around_[to]) {
      if (has(facet, from)) continue;
      const auto& corners = side_.facets[facet];
      const auto here = std::find(corners.begin(), corners.end(), to) - corners.begin();
      for (const int candidate : {corners[(here + 1) % 4], corners[(here + 3) % 4]}) {
        const double cosine = ahead.dot((position(candidate) - position(to)).normalized());
        if (cosine > best_cosine && !beside(candidate, from, to)) {
          best = candidate;
          best_cosine = cosine;
        }
      }
    }
    return best;
  }

  bool beside(int candidate, int from, int to) const {
    for (const int facet : around_[to])
      if (has(facet, from) && has(facet, candidate)) return true;
    return false;
  }

  double zero_distance(int in, int out, double length) const {
    const int second = straight_on(out, in);
    if (second < 0 || !inside(second)) return 0.5 * length;
    const auto square = [&](int node) { return pressure_[node] * pressure_[node]; };
    const double s1 = (position(second) - position(in)).norm();
    const double value = square(in), slope = (value - square(second)) / s1;
    const int third = straight_on(in, second);
    double bend = 0;  // second divided difference
    if (third >= 0 && inside(third)) {
      const double s2 = (position(third) - position(second)).norm();
      bend = (slope - (square(second) - square(third)) / s2) / (s1 + s2);
    }
    // value + (slope + bend s1) s + bend s^2 = 0, in the form that is stable for small bend
    const double linear = slope + bend * s1;
    const double discriminant = linear * linear - 4 * bend * value;
    if (discriminant < 0) return length;
    const double denominator = -linear + std::sqrt(discriminant);
    const double root = denominator > 0 ? 2 * value / denominator : length;
    return std::clamp(root, 0.0, length);
  }

  const ContactSide& side_;
  const FacetsAroundNodes& around_;
  const std::vector<double>& pressure_;
};

double polygon_area(const std::vector<Vector>& corners) {
  Vector twice = Vector::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  return 0.5 * twice.norm();
}

}  // namespace

double patch_area(const ContactSide& side, const FacetsAroundNodes& around, const std::vector<double>& pressure) {
  const Surface surface(side, around, pressure);
  double area = 0;
  std::vector<Vector> polygon;
  for (const auto& facet : side.facets) {
    polygon.clear();
    for (int i = 0; i < 4; ++i) {
      const int here = facet[i], next = facet[(i + 1) % 4];
      if (surface.inside(here)) polygon.push_back(surface.position(here));
      if (surface.inside(here) && !surface.inside(next)) polygon.push_back(surface.crossing(here, next));
      if (!surface.inside(here) && surface.inside(next)) polygon.push_back(surface.crossing(next, here));
    }
    if (polygon.size() > 2) area += polygon_area(polygon);
  }
  return area;
}

EquivalentEllipse equivalent_ellipse(const ContactSide& side, const std::vector<int>& nodes,
                                     const std::vector<double>& forces, const LocalFrame& frame) {
  double sum = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Eigen::Vector2d place = frame.place(entry(side.position, nodes[i])).head<2>();
    sum += forces[i];
    mean += forces[i] * place;
    moments += forces[i] * place * place.transpose();
  }
  EquivalentEllipse ellipse;
  if (!(sum > 0)) return ellipse;
  mean /= sum;
  moments = moments / sum - mean * mean.transpose();
  // Half the angle at which the mixed moment vanishes, taken such that the first axis is the one nearer to
  // longitudinal.
  const double difference = moments(0, 0) - moments(1, 1), mixed = 2 * moments(0, 1);
  const double size = std::hypot(difference, mixed);
  const bool first_is_larger = difference >= 0;
  const double half_sum = 0.5 * (moments(0, 0) + moments(1, 1));
  // Of one node alone both are zero but for rounding.
  const double larger = std::max(0.0, half_sum + 0.5 * size), smaller = std::max(0.0, half_sum - 0.5 * size);
  ellipse.semi_axis_along = std::sqrt(5 * (first_is_larger ? larger : smaller));
  ellipse.semi_axis_across = std::sqrt(5 * (first_is_larger ? smaller : larger));
  if (size > 1e-12 * half_sum) ellipse.turn = 0.5 * std::atan2(first_is_larger ? mixed : -mixed, std::fabs(difference));
  return ellipse;
}

}  // namespace railwave
