#include <algorithm>
#include <cmath>

#include "model/model.hpp"

namespace railwave {

double curve_value(const scene::Curve* curve, double time) {
  if (curve == nullptr) return 1;
  switch (curve->type) {
    case scene::CurveType::constant: return 1;
    case scene::CurveType::cosine_ramp: {  // thesis eq. 3.2
      if (time <= curve->start) return 0;
      if (time >= curve->start + curve->duration) return 1;
      return 0.5 * (1 - std::cos(M_PI * (time - curve->start) / curve->duration));
    }
    case scene::CurveType::table: {
      const auto& points = curve->points;
      const auto after = std::upper_bound(points.begin(), points.end(), time,
                                          [](double t, const std::array<double, 2>& point) { return t < point[0]; });
      if (after == points.begin()) return points.front()[1];
      if (after == points.end()) return points.back()[1];
      const auto& a = *(after - 1);
      const auto& b = *after;
      return a[1] + (b[1] - a[1]) * (time - a[0]) / (b[0] - a[0]);
    }
  }
  return 1;
}

}  // namespace railwave
