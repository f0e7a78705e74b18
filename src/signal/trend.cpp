#include "signal/trend.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"

namespace railwave {

Trend trend_named(const std::string& name) {
  static const std::vector<std::string> names = {"none", "mean", "line"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(fmt::format("there is no trend '{}' to take out; {}", name, suggestion(name, names)));
  return static_cast<Trend>(found - names.begin());
}

std::vector<double> without_trend(const std::vector<double>& values, Trend trend) {
  if (trend == Trend::none || values.empty()) return values;
  const double count = static_cast<double>(values.size()), middle = 0.5 * (count - 1);
  double mean = 0, moment = 0, spread = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double from_middle = static_cast<double>(n) - middle;
    mean += values[n] / count;
    moment += from_middle * values[n];
    spread += from_middle * from_middle;
  }
  const double slope = trend == Trend::line && spread > 0 ? moment / spread : 0;
  std::vector<double> rest(values.size());
  for (std::size_t n = 0; n < values.size(); ++n)
    rest[n] = values[n] - mean - slope * (static_cast<double>(n) - middle);
  return rest;
}

}  // namespace railwave
