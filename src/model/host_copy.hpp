#pragma once

#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "kernels/support/meanwhile.hpp"

/// Copies between std::vector and device arrays, and work of the host on what is copied.
namespace railwave {

/// A copy from the host to the device, or from there, in the default order of launches: one without an order would wait
/// for all that other runs have launched in theirs.
template <class To, class From>
void copy_in_order(const To& to, const From& from) {
  Kokkos::deep_copy(ExecutionSpace(), to, from);
  wait_for(ExecutionSpace());
}

/// Into the first rows of an array; what lies behind them has no meaning afterwards.
template <class T>
void bring(const std::vector<T>& values, const Array<T*>& device) {
  using Plain = Kokkos::View<const T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  copy_in_order(Kokkos::subview(device, std::make_pair(std::size_t{0}, values.size())),
                Plain(values.data(), values.size()));
}

/// Rows of N values.
template <class T, std::size_t N>
void bring(const std::vector<std::array<T, N>>& rows, const Array<T* [N]>& device) {
  const auto host = Kokkos::create_mirror_view(device);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) host(i, k) = rows[i][k];
  copy_in_order(device, host);
}

template <class T>
Array<T*> to_device(const char* label, const std::vector<T>& values) {
  const auto device = unset_array<T*>(label, values.size());
  bring(values, device);
  return device;
}

/// Rows of N values.
template <class T, std::size_t N>
Array<T* [N]> to_device(const char* label, const std::vector<std::array<T, N>>& rows) {
  const auto device = unset_array<T* [N]>(label, rows.size());
  bring(rows, device);
  return device;
}

/// A host mirror holding the array's present values.
template <class View>
typename View::HostMirror to_host(const View& device) {
  const auto host = Kokkos::create_mirror_view(device);
  copy_in_order(host, device);
  return host;
}

/// The array's present values as plain data, by one copy.
template <class T>
std::vector<T> to_vector(const Array<T*>& device) {
  std::vector<T> values(device.extent(0));
  using Plain = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;
  copy_in_order(Plain(values.data(), values.size()), device);
  return values;
}

/// Calls of the host's threads; the first exception is kept.
template <class Act>
struct HostCalls {
  const Act& act;
  std::mutex& mutex;
  std::exception_ptr& thrown;
  void operator()(const int i) const {
    try {
      act(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
  }
};

/// Calls act(i) for each i below count, on all threads of the host: what one call does must not depend on others.
/// Throws what one of them has thrown, when all are done.
template <class Act>
void on_host_threads(int count, const Act& act) {
#ifdef RAILWAVE_SERIAL
  using Space = Kokkos::Serial;
#else
  using Space = Kokkos::DefaultHostExecutionSpace;
#endif
  std::mutex mutex;
  std::exception_ptr thrown;
  Kokkos::parallel_for("on_host_threads", Kokkos::RangePolicy<Space>(0, count), HostCalls<Act>{act, mutex, thrown});
  Space().fence();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace railwave
