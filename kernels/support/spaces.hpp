#pragma once

#include <Kokkos_Core.hpp>
#include <string>

/// RAILWAVE_DEVICE: kernels run on a GPU. RAILWAVE_DEVICE_CODE: the compiler is at the GPU's own code, not the host's.
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(KOKKOS_ENABLE_SYCL)
#define RAILWAVE_DEVICE
#endif
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__) || defined(__SYCL_DEVICE_ONLY__)
#define RAILWAVE_DEVICE_CODE
#endif

namespace railwave {

#ifdef RAILWAVE_DEVICE
inline constexpr bool on_device = true;
#else
inline constexpr bool on_device = false;
#endif

/// Where everything runs: on the GPU where there is one, else on all processors. RAILWAVE_SERIAL, for comparison, is
/// one processor without any threading library.
#ifdef RAILWAVE_SERIAL
using ExecutionSpace = Kokkos::Serial;
#else
using ExecutionSpace = Kokkos::DefaultExecutionSpace;
#endif
using MemorySpace = ExecutionSpace::memory_space;

/// A device array. The layout is Kokkos' own choice for the space: rows together on a host (a node's three components
/// in one cache line), columns together on a GPU (coalesced).
template <class T>
using Array = Kokkos::View<T, MemorySpace>;

/// Host memory that a GPU copies to by itself, without a detour.
#if defined(RAILWAVE_DEVICE) && KOKKOS_VERSION >= 40000
using PinnedSpace = Kokkos::SharedHostPinnedSpace;
#elif defined(KOKKOS_ENABLE_HIP)
using PinnedSpace = Kokkos::Experimental::HIPHostPinnedSpace;
#else
using PinnedSpace = Kokkos::HostSpace;
#endif

/// A host array of a device array's layout.
template <class T>
using PinnedArray = Kokkos::View<T, typename Array<T>::array_layout, PinnedSpace>;

/// In a policy: the functor goes to a GPU as a kernel argument. A large one Kokkos would else copy to constant memory,
/// and each launch would wait for the copy before.
using AsArgument = Kokkos::Experimental::WorkItemProperty::HintLightWeight_t;

using Range = Kokkos::RangePolicy<ExecutionSpace, AsArgument>;

/// For few threads: few of them a block, so that all of a GPU's multiprocessors share the work.
using SpreadRange = Kokkos::RangePolicy<ExecutionSpace, Kokkos::LaunchBounds<32>, AsArgument>;

/// An uninitialised array; for arrays that a kernel or a copy fills whole.
template <class T, class... Extents>
Array<T> unset_array(const char* label, Extents... extents) {
  return Array<T>(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), extents...);
}

/// What a kernel is given of a step's time, such as the value of a curve: with its launch, or, where launches are
/// recorded once for many steps, at a place on the device that is filled before each step.
template <class Value>
struct StepValue {
  Value given{};
  const Value* recorded = nullptr;

  KOKKOS_INLINE_FUNCTION const Value& operator()() const { return recorded != nullptr ? *recorded : given; }
};

}  // namespace railwave
