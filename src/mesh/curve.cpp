#include "mesh/curve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace railwave {

double norm(Point2 a) { return std::hypot(a.y, a.z); }

Point2 Curve::left_normal(double arc) const {
  const double step = 1e-6;
  const Point2 tangent = at(std::min(arc + step, length)) - at(std::max(arc - step, 0.0));
  const double size = norm(tangent);
  return {-tangent.z / size, tangent.y / size};
}

Curve line(Point2 from, Point2 to) {
  const double length = norm(to - from);
  const Point2 direction = (1 / length) * (to - from);
  return {length, [=](double s) { return from + s * direction; }};
}

Curve arc(Point2 from, Point2 to, double radius) {
  const Point2 chord = to - from;
  const double half = norm(chord) / 2;
  const double size = std::abs(radius);
  const double turn = radius > 0 ? 1 : -1;
  const double rise = std::sqrt(std::max(0.0, size * size - half * half));
  const Point2 left = {-chord.z / (2 * half), chord.y / (2 * half)};
  const Point2 centre = from + 0.5 * chord + turn * rise * left;
  const double opening = 2 * std::asin(std::min(1.0, half / size));
  const double first = std::atan2(from.z - centre.z, from.y - centre.y);
  return {size * opening, [=](double s) {
            const double angle = first + turn * s / size;
            return Point2{centre.y + size * std::cos(angle), centre.z + size * std::sin(angle)};
          }};
}

namespace {

/// Arc length of a graph, tabulated so that the inverse needs only a short Newton iteration.
struct GraphLength {
  double from, step;
  std::vector<double> length;  // at from + i * step
  std::function<double(double)> slope;

  double between(double a, double b) const {  // 4-point Gauss
    static const double x[2] = {0.8611363115940526, 0.3399810435848563};
    static const double w[2] = {0.3478548451374538, 0.6521451548625461};
    const double middle = (a + b) / 2, half = (b - a) / 2;
    double sum = 0;
    for (int i = 0; i < 2; ++i)
      for (int side = -1; side <= 1; side += 2) sum += w[i] * std::hypot(1.0, slope(middle + side * half * x[i]));
    return sum * std::abs(half);
  }

  double position(double arc) const {
    auto next = std::upper_bound(length.begin(), length.end(), arc);
    const auto last = static_cast<long>(length.size()) - 2;
    const long i = std::clamp<long>(next - length.begin() - 1, 0, last);
    const double start = from + static_cast<double>(i) * step;
    const double direction = step > 0 ? 1 : -1;
    double s = start + step * (arc - length[i]) / (length[i + 1] - length[i]);
    for (int iteration = 0; iteration < 4; ++iteration) {
      const double excess = (s - start) * direction >= 0 ? between(start, s) : -between(start, s);
      s -= direction * (length[i] + excess - arc) / std::hypot(1.0, slope(s));
    }
    return s;
  }
};

}  // namespace

Curve graph(double from, double to, std::function<double(double)> height, std::function<double(double)> slope) {
  const int cells = std::max(16, static_cast<int>(std::ceil(std::abs(to - from) / 2e-4)));
  auto table = std::make_shared<GraphLength>();
  table->from = from;
  table->step = (to - from) / cells;
  table->slope = std::move(slope);
  table->length.assign(1, 0.0);
  for (int i = 0; i < cells; ++i) {
    const double a = from + i * table->step;
    table->length.push_back(table->length.back() + table->between(a, a + table->step));
  }
  return {table->length.back(), [table, height = std::move(height)](double arc) {
            const double s = table->position(arc);
            return Point2{s, height(s)};
          }};
}

Curve reversed(Curve curve) {
  return {curve.length, [curve](double s) { return curve.at(curve.length - s); }};
}

Curve mirrored(Curve curve) {
  return {curve.length, [curve](double s) {
            const Point2 p = curve.at(s);
            return Point2{-p.y, p.z};
          }};
}

Curve part(Curve curve, double from, double to) {
  return {to - from, [curve, from](double s) { return curve.at(from + s); }};
}

Curve joined(std::vector<Curve> curves) {
  double total = 0;
  for (const auto& curve : curves) total += curve.length;
  return {total, [curves = std::move(curves)](double s) {
            std::size_t i = 0;
            while (i + 1 < curves.size() && s > curves[i].length) s -= curves[i++].length;
            return curves[i].at(s);
          }};
}

}  // namespace railwave
