#pragma once

#include "kernels/spaces.hpp"

#if !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP) && !defined(KOKKOS_ENABLE_SYCL)
#define RAILWAVE_SIMD_LANES
#include <experimental/simd>
#endif

/// The number type that the element kernels are written in: a SIMD pack on a host (one element a lane), a plain number on
/// a GPU (one element a thread). Element data lie in tiles of `tile_width` elements:
/// value k of K of element e is at ((e / tile_width) * K + k) * tile_width + e % tile_width.
namespace railwave {

#ifdef RAILWAVE_SIMD_LANES
using Real = std::experimental::native_simd<double>;
inline constexpr int lane_count = static_cast<int>(Real::size());
inline constexpr int tile_width = lane_count;
#else
using Real = double;
inline constexpr int lane_count = 1;
inline constexpr int tile_width = 32;
#endif

/// How many batches (calls of an element kernel) a number of tiles makes.
inline constexpr int batches_per_tile = tile_width / lane_count;

/// Where value k of K of the batch's first lane lies in a tiled array.
KOKKOS_INLINE_FUNCTION constexpr long tiled(int batch, int values, int value) {
  const int tile = batch / batches_per_tile;
  const int lane = (batch % batches_per_tile) * lane_count;
  return (static_cast<long>(tile) * values + value) * tile_width + lane;
}

KOKKOS_INLINE_FUNCTION Real load(const double* p) {
#ifdef RAILWAVE_SIMD_LANES
  return Real(p, std::experimental::element_aligned);
#else
  return *p;
#endif
}

KOKKOS_INLINE_FUNCTION void store(double* p, const Real& value) {
#ifdef RAILWAVE_SIMD_LANES
  value.copy_to(p, std::experimental::element_aligned);
#else
  *p = value;
#endif
}

/// Component `component` of a node array at the lanes' nodes.
template <class NodeArray>
KOKKOS_INLINE_FUNCTION Real gather(const NodeArray& values, const int* nodes, int component) {
#ifdef RAILWAVE_SIMD_LANES
  return Real([&](auto lane) { return values(nodes[lane], component); });
#else
  return values(*nodes, component);
#endif
}

}  // namespace railwave
