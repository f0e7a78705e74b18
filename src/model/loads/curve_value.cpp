#include <algorithm>
#include <cmath>

#include "model/loads/load_model.hpp"

namespace railwave {

const scene::Curve* curve_of(const scene::Scene& scene, const std::string& name) {
  return find_entry(scene.curves, name);
}

namespace {

using Points = std::vector<std::array<double, 2>>;

double table_value(const Points& points, double time) {
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double t, const std::array<double, 2>& point) { return t < point[0]; });
  if (after == points.begin()) return points.front()[1];
  if (after == points.end()) return points.back()[1];
  const auto& a = *(after - 1);
  const auto& b = *after;
  return a[1] + (b[1] - a[1]) * (time - a[0]) / (b[0] - a[0]);
}

/// From 0 on: a trapezoid for each straight piece, the first and the last value beyond. A jump is a piece of no length.
double table_integral(const Points& points, double time) {
  double sum = points.front()[1] * std::max(0.0, std::min(time, points.front()[0]));
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto &a = points[i - 1], &b = points[i];
    const double low = std::max(0.0, a[0]), high = std::min(time, b[0]);
    if (high <= low) continue;
    const double middle = a[1] + (b[1] - a[1]) * (0.5 * (low + high) - a[0]) / (b[0] - a[0]);
    sum += middle * (high - low);
  }
  return sum + points.back()[1] * std::max(0.0, time - std::max(0.0, points.back()[0]));
}

}  // namespace

double curve_value(const scene::Curve* curve, double time) {
  if (curve == nullptr) return 1;
  switch (curve->type) {
    case scene::CurveType::constant:
      return 1;
    case scene::CurveType::cosine_ramp: {  // thesis eq. 3.2
      if (time <= curve->start) return 0;
      if (time >= curve->start + curve->duration) return 1;
      return 0.5 * (1 - std::cos(M_PI * (time - curve->start) / curve->duration));
    }
    case scene::CurveType::table:
      return table_value(curve->points, time);
    case scene::CurveType::half_sine: {
      const double since = time - curve->start;
      return since <= 0 || since >= curve->duration ? 0.0 : std::sin(M_PI * since / curve->duration);
    }
  }
  return 1;
}

namespace {

/// A table is straight in each piece, so that its value goes on from within the piece.
CurveRates table_rates(const Points& points, double time, double before) {
  const double within = time - before;
  const auto after = std::upper_bound(points.begin(), points.end(), within,
                                      [](double t, const std::array<double, 2>& point) { return t < point[0]; });
  if (after == points.begin()) return {points.front()[1], 0, 0};
  if (after == points.end()) return {points.back()[1], 0, 0};
  const auto& a = *(after - 1);
  const auto& b = *after;
  const double slope = (b[1] - a[1]) / (b[0] - a[0]);
  return {a[1] + slope * (time - a[0]), slope, 0};
}

}  // namespace

CurveRates curve_rates(const scene::Curve* curve, double time, double before) {
  if (curve == nullptr || curve->type == scene::CurveType::constant) return {1, 0, 0};
  if (curve->type == scene::CurveType::table) return table_rates(curve->points, time, before);
  const double value = curve_value(curve, time), within = time - before - curve->start;
  if (within < 0 || within >= curve->duration) return {value, 0, 0};
  const double rate = M_PI / curve->duration, angle = rate * (time - curve->start);
  if (curve->type == scene::CurveType::half_sine)
    return {value, rate * std::cos(angle), -rate * rate * std::sin(angle)};
  return {value, 0.5 * rate * std::sin(angle), 0.5 * rate * rate * std::cos(angle)};
}

double curve_integral(const scene::Curve* curve, double time) {
  if (curve == nullptr) return time;
  switch (curve->type) {
    case scene::CurveType::constant:
      return time;
    case scene::CurveType::cosine_ramp: {
      const auto primitive = [&](double t) {
        const double since = t - curve->start;
        if (since <= 0) return 0.0;
        if (since >= curve->duration) return since - 0.5 * curve->duration;
        return 0.5 * (since - curve->duration / M_PI * std::sin(M_PI * since / curve->duration));
      };
      return primitive(time) - primitive(0);
    }
    case scene::CurveType::table:
      return table_integral(curve->points, time);
    case scene::CurveType::half_sine: {
      const auto primitive = [&](double t) {
        const double since = std::min(std::max(t - curve->start, 0.0), curve->duration);
        return curve->duration / M_PI * (1 - std::cos(M_PI * since / curve->duration));
      };
      return primitive(time) - primitive(0);
    }
  }
  return time;
}

double load_value(const LoadArrays& load, double time) {
  const double factor = curve_value(load.curve, time);
  switch (load.load->type) {
    case scene::LoadType::torque:
      return factor * load.load->moment;
    case scene::LoadType::pressure:
      return factor * load.load->pressure;
    default:
      return factor;
  }
}

}  // namespace railwave
