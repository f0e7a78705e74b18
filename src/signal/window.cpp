#include "signal/window.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/suggest.hpp"
#include "signal/fourier.hpp"

namespace railwave {
namespace {

/// Sum of (-1)^j a_j cos(2 pi j n / N).
double cosines(double share, std::initializer_list<double> factors) {
  double sum = 0, sign = 1, j = 0;
  for (const double a : factors) {
    sum += sign * a * std::cos(2 * M_PI * j * share);
    sign = -sign;
    ++j;
  }
  return sum;
}

/// @param share n/N
double value(WindowType type, double share, double parameter) {
  switch (type) {
    case WindowType::rectangular:
      return 1;
    case WindowType::hann:
      return cosines(share, {0.5, 0.5});
    case WindowType::hamming:
      return cosines(share, {0.54, 0.46});
    case WindowType::flat_top:
      return cosines(share, {0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368});
    case WindowType::tukey: {
      const double from_end = std::min(share, 1 - share);
      return from_end >= parameter / 2 ? 1 : 0.5 * (1 - std::cos(2 * M_PI * from_end / parameter));
    }
    case WindowType::exponential:
      return std::pow(parameter, share);
  }
  return 1;
}

}  // namespace

const std::vector<std::string>& window_names() {
  static const std::vector<std::string> names = {"rectangular", "hann", "hamming", "flat_top", "tukey", "exponential"};
  return names;
}

WindowType window_named(const std::string& name) {
  const auto& names = window_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(fmt::format("there is no window '{}'; {}", name, suggestion(name, names)));
  return static_cast<WindowType>(found - names.begin());
}

std::vector<double> window(WindowType type, std::size_t length, double parameter) {
  std::vector<double> values(length);
  for (std::size_t n = 0; n < length; ++n)
    values[n] = value(type, static_cast<double>(n) / static_cast<double>(length), parameter);
  return values;
}

}  // namespace railwave
