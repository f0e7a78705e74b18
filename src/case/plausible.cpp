#include "case/plausible.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "case/read_value.hpp"

namespace railwave::case_file {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Another unit in which people have the quantity, and what one of it is in ours.
struct OtherUnit {
  const char* name;
  double factor;
};

/// Sizes of a quantity: `least` holds for keys whose values are above 0, `most` for either sign.
struct UnitSizes {
  const char* unit;
  double least, most;  ///< refused beyond
  double usual_most;   ///< warned of beyond
  std::vector<OtherUnit> others;
};

const std::vector<UnitSizes>& sizes_by_unit() {
  static const std::vector<UnitSizes> all = {
      {"m", 1e-9, 1e5, 1e3, {{"mm", 1e-3}, {"um", 1e-6}}},
      {"s", 1e-15, 1e9, 10, {{"ms", 1e-3}, {"us", 1e-6}}},
      {"kg", 1e-12, 1e12, 1e6, {{"g", 1e-3}}},
      {"Pa", 1e-6, 1e16, 1.5e12, {{"GPa", 1e9}, {"MPa", 1e6}, {"kPa", 1e3}}},
      {"kg/m3", 1e-6, 1e9, 25e3, {{"t/m3 or g/cm3", 1e3}, {"t/mm3", 1e12}, {"kg/mm3", 1e9}}},
      {"m/s", 1e-12, 1e5, 1e3, {{"km/h", 1 / 3.6}, {"mm/s", 1e-3}}},
      {"m/s2", 1e-12, 1e7, 100, {{"mm/s2", 1e-3}}},
      {"rad", 1e-12, 1e3, 10, {{"degrees", 0.017453292519943295}}},
      {"rad/s", 1e-12, 1e6, 1e3, {{"turns per minute", 0.10471975511965977}, {"degrees/s", 0.017453292519943295}}},
      {"N", 1e-12, 1e15, 1e9, {{"kN", 1e3}, {"mN", 1e-3}}},
      {"N m", 1e-12, 1e15, 1e9, {{"kN m", 1e3}, {"N mm", 1e-3}}},
      {"N/m", 1e-12, 1e18, 1e13, {{"MN/m or kN/mm", 1e6}, {"kN/m or N/mm", 1e3}}},
      {"N s/m", 1e-12, 1e15, 1e10, {{"kN s/m", 1e3}, {"MN s/m", 1e6}}},
      {"1/s", 1e-12, 1e9, 1e6, {}},
      {"s/m", 1e-12, 1e9, 1e6, {}},
  };
  return all;
}

const UnitSizes* sizes_of(const Key& key) {
  for (const UnitSizes& one : sizes_by_unit())
    if (key.unit == one.unit) return &one;
  return nullptr;
}

bool only_positive(const Range& range) { return range.low > 0 || (range.low == 0 && range.low_open); }

}  // namespace

Range allowed_range(const Key& key) {
  Range range = key.range;
  const UnitSizes* sizes = sizes_of(key);
  if (!sizes || key.any_size) return range;
  if (range.low == 0 && range.low_open) range.low = sizes->least, range.low_open = false;
  if (range.low < -sizes->most) range.low = -sizes->most, range.low_open = false;
  if (range.high > sizes->most) range.high = sizes->most, range.high_open = false;
  return range;
}

Range usual_range(const Key& key) {
  if (key.usual) return *key.usual;
  const UnitSizes* sizes = sizes_of(key);
  if (!sizes || key.any_size) return {};
  // A range of the key's own says better than its unit what is usual.
  const double high = key.range.high < infinite ? infinite : sizes->usual_most;
  return {only_positive(key.range)    ? 0
          : key.range.low > -infinite ? -infinite
                                      : -sizes->usual_most,
          high, false, false};
}

bool is_usual(const Key& key, double number) { return number == 0 || usual_range(key).has(number); }

double least_beside_zero(const Key& key) {
  const UnitSizes* sizes = sizes_of(key);
  return sizes && !key.any_size && key.range.low == 0 && !key.range.low_open ? sizes->least : 0;
}

std::string unit_hint(const Key& key, double number) {
  const UnitSizes* sizes = sizes_of(key);
  if (!sizes || !std::isfinite(number) || number == 0 || is_usual(key, number)) return "";
  for (const OtherUnit& other : sizes->others) {
    const double meant = number * other.factor;
    if (is_usual(key, meant) && allowed_range(key).has(meant))
      return fmt::format("; {} are expected: {:.4g}, if it is in {}", key.unit, meant, other.name);
  }
  return "";
}

std::string oddity(const Key& key, double number) {
  const auto unit = key.unit.empty() ? "" : " " + key.unit;
  const std::string hint = unit_hint(key, number);
  return fmt::format("is {}{}, which is unusual: mostly it is {}{}{}", number, unit, range_text(usual_range(key)), unit,
                     hint.empty() ? "; see whether that is meant, and the unit right" : hint);
}

std::string unit_limits_markdown() {
  std::string text = "| unit | smallest, where above 0 is asked for | largest, with either sign |\n|---|---|---|\n";
  for (const UnitSizes& one : sizes_by_unit()) text += fmt::format("| {} | {} | {} |\n", one.unit, one.least, one.most);
  return text;
}

}  // namespace railwave::case_file
