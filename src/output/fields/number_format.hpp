#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "case/scene_run.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {

/// A number with so many bits of its mantissa: the nearest, ties to even. What is no number, or infinite, stays.
inline double with_mantissa_bits(double value, int bits) {
  if (!std::isfinite(value)) return value;
  std::uint64_t pattern;
  std::memcpy(&pattern, &value, sizeof pattern);
  const int dropped = 52 - bits;
  const std::uint64_t last = std::uint64_t{1} << dropped;
  pattern += (last >> 1) - 1 + ((pattern >> dropped) & 1);
  pattern &= ~(last - 1);
  double rounded;
  std::memcpy(&rounded, &pattern, sizeof rounded);
  return std::isfinite(rounded) ? rounded : value;
}

/// How numbers of fields and contacts are written: output.precision and output.significant_digits.
struct NumberFormat {
  bool in_single = false;
  int digits = 15;  ///< 15: all

  explicit NumberFormat(const scene::Output& output = {})
      : in_single(output.precision == scene::ResultsPrecision::single),
        digits(output.significant_digits.value_or(15)) {}

  /// A growing dataset of such numbers.
  hdf5::Dataset make_growing(const hdf5::Group& group, const std::string& name, const hdf5::Shape& shape,
                             const hdf5::Storage& storage) const {
    return in_single ? group.create_growing<float>(name, shape, storage)
                     : group.create_growing<double>(name, shape, storage);
  }

  std::size_t bytes() const { return in_single ? sizeof(float) : sizeof(double); }

  /// Rounds the values of a field to the digits, in binary: of their mantissas as many bits are kept as these need, so
  /// that the file's compression finds the others zero [Kouznetsov 2021]. Places keep all, since it is their
  /// differences that matter.
  /// @param field  name of case/field_table.hpp
  /// @param values in SI units, all components of all entries
  void round(const std::string& field, std::vector<double>& values) const {
    if (digits >= 15 || field == "displacement" || field == "position") return;
    const int bits = static_cast<int>(std::ceil(digits * std::log2(10.0)));
    for (double& value : values) value = with_mantissa_bits(value, bits);
  }
};

}  // namespace railwave
