#pragma once

#include <cstring>

#include "kernels/support/spaces.hpp"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace railwave {

/// Zeros in memory of this process's own. Whole pages go back to the system, which hands out zeros where they are
/// touched again: what a process never touches of its arrays takes no memory.
inline void set_zero_on_host(void* data, std::size_t bytes) {
#ifdef __linux__
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  constexpr std::size_t few_pages = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(data), end = begin + bytes;
  const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
  if (last > first + few_pages * page && madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED) == 0) {
    std::memset(data, 0, first - begin);
    std::memset(reinterpret_cast<void*>(last), 0, end - last);
    return;
  }
#endif
  std::memset(data, 0, bytes);
}

/// Gives whole pages within these bytes back to the system, if it takes them: what they held is lost. They take memory
/// again where they are touched.
inline void give_pages_back([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (begin + page - 1) / page * page, last = (begin + bytes) / page * page;
  if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
#endif
}

/// Sets all bytes of an array to zero.
template <class View>
void set_zero(const View& view) {
  const std::size_t bytes = view.span() * sizeof(typename View::value_type);
  if (bytes == 0) return;
  if constexpr (std::is_same_v<typename View::memory_space, Kokkos::HostSpace>) {
    ExecutionSpace().fence();
    set_zero_on_host(view.data(), bytes);
  } else {
    const Kokkos::View<unsigned char*, typename View::memory_space, Kokkos::MemoryTraits<Kokkos::Unmanaged>> plain(
        reinterpret_cast<unsigned char*>(view.data()), bytes);
    Kokkos::deep_copy(plain, static_cast<unsigned char>(0));
  }
}

}  // namespace railwave
