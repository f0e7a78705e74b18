#include "solve/monitor/force_swing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace railwave {
namespace {

constexpr std::size_t least_samples = 20;

}  // namespace

void ForceSwing::add(double time, const Vec3& normal_force) {
  time_.push_back(time);
  force_.push_back(std::sqrt(normal_force[0] * normal_force[0] + normal_force[1] * normal_force[1] +
                             normal_force[2] * normal_force[2]));
}

double ForceSwing::static_value() const {
  double sum = 0, span = 0;
  for (std::size_t k = 1; k < time_.size(); ++k) {
    if (time_[k - 1] < 0.5 * time_.back()) continue;
    sum += 0.5 * (force_[k] + force_[k - 1]) * (time_[k] - time_[k - 1]);
    span += time_[k] - time_[k - 1];
  }
  return span > 0 ? sum / span : 0;
}

double ForceSwing::swing(double from, double to) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < time_.size(); ++k) {
    if (time_[k] < from * time_.back() || time_[k] > to * time_.back()) continue;
    low = std::min(low, force_[k]);
    high = std::max(high, force_[k]);
  }
  return high >= low ? 0.5 * (high - low) / static_value() : 0;
}

double ForceSwing::quiet_from() const {
  const double mean = static_value();
  std::size_t k = time_.size();
  while (k > 0 && std::fabs(force_[k - 1] - mean) <= quiet * mean) --k;
  return k < time_.size() ? time_[k] : std::numeric_limits<double>::infinity();
}

std::string ForceSwing::summary(const std::string& contact) const {
  if (time_.size() < least_samples || !(static_value() > 0)) return {};
  const double from = quiet_from();
  const std::string when =
      std::isfinite(from)
          ? fmt::format("from t = {:.4g} ms on it stays within {:.0f} % of that", 1e3 * from, 100 * quiet)
          : fmt::format("to the end it does not stay within {:.0f} % of that", 100 * quiet);
  return fmt::format(
      "contact {}: the run began unsettled; the normal force swung by {:.3g} % of its mean over the second half "
      "({:.4g} kN) in the first tenth of the run, by {:.3g} % in the last; {}",
      contact, 100 * swing(0, 0.1), 1e-3 * static_value(), 100 * swing(0.9, 1), when);
}

}  // namespace railwave
