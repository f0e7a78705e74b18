#pragma once

#include <vector>

#include "kernels/support/spaces.hpp"

/// Copies between std::vector and device arrays.
namespace railwave {

template <class T>
Array<T*> to_device(const char* label, const std::vector<T>& values) {
  auto device = unset_array<T*>(label, values.size());
  const auto host = Kokkos::create_mirror_view(device);
  for (std::size_t i = 0; i < values.size(); ++i) host(i) = values[i];
  Kokkos::deep_copy(device, host);
  return device;
}

/// Rows of N values.
template <class T, std::size_t N>
Array<T* [N]> to_device(const char* label, const std::vector<std::array<T, N>>& rows) {
  auto device = unset_array<T* [N]>(label, rows.size());
  const auto host = Kokkos::create_mirror_view(device);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) host(i, k) = rows[i][k];
  Kokkos::deep_copy(device, host);
  return device;
}

/// A host mirror holding the array's present values.
template <class View>
typename View::HostMirror to_host(const View& device) {
  const auto host = Kokkos::create_mirror_view(device);
  Kokkos::deep_copy(host, device);
  return host;
}

/// The array's present values as plain data, by one copy.
template <class T>
std::vector<T> to_vector(const Array<T*>& device) {
  std::vector<T> values(device.extent(0));
  using Plain = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  Kokkos::deep_copy(Plain(values.data(), values.size()), device);
  return values;
}

}  // namespace railwave
