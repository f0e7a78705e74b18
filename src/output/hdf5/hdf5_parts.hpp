#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>

#include "output/hdf5/hdf5.hpp"

/// What the pieces of the wrapper share.
namespace railwave::hdf5 {

/// The most specific entry of HDF5's error stack, which is then empty.
std::string reason();

template <class Result>
Result check(Result result, const std::string& what) {
  if (result < 0) throw std::runtime_error(what + ": " + reason());
  return result;
}

/// The types of which arrays are read and written: expands `of_type(T)` for each.
#define RAILWAVE_EACH_VALUE_TYPE(of_type) \
  of_type(double) of_type(float) of_type(int) of_type(long) of_type(signed char) of_type(unsigned char)

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, float>)
    return H5T_NATIVE_FLOAT;
  else if constexpr (std::is_same_v<T, int>)
    return H5T_NATIVE_INT;
  else if constexpr (std::is_same_v<T, long>)
    return H5T_NATIVE_LONG;
  else if constexpr (std::is_same_v<T, unsigned char>)
    return H5T_NATIVE_UCHAR;
  else
    return H5T_NATIVE_SCHAR;
}

inline Handle text_type() {
  Handle type(check(H5Tcopy(H5T_C_S1), "making a text type"), H5Tclose);
  check(H5Tset_size(type.get(), H5T_VARIABLE), "making a text type");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "making a text type");
  return type;
}

inline Handle file_space(hid_t dataset, const std::string& name) {
  return {check(H5Dget_space(dataset), "asking for the shape of " + name), H5Sclose};
}

inline Handle space_of(const Shape& shape) {
  const hid_t id =
      shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  return {check(id, "describing a shape"), H5Sclose};
}

inline hsize_t count_of(const Shape& shape) {
  hsize_t count = 1;
  for (const hsize_t extent : shape) count *= extent;
  return count;
}

}  // namespace railwave::hdf5
