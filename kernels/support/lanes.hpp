#pragma once

#include <cstdint>

#include "kernels/support/spaces.hpp"

#ifndef RAILWAVE_DEVICE
#define RAILWAVE_SIMD_LANES
#include <experimental/simd>
#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif
#endif

/// The number types that the element kernels are written in: a SIMD pack on a host (one element a lane), a plain number
/// on a GPU (one element a thread). A batch is what one call of an element kernel works on: `lane_count<S>` elements.
namespace railwave {

#ifdef RAILWAVE_SIMD_LANES
template <class S>
using Pack = std::experimental::native_simd<S>;
template <class S>
inline constexpr int lane_count = static_cast<int>(Pack<S>::size());
template <class S>
inline constexpr int tile_width = lane_count<S>;
#else
template <class S>
using Pack = S;
template <class S>
inline constexpr int lane_count = 1;
template <class S>
inline constexpr int tile_width = 32;
#endif

/// Element data lie in tiles: value k of K of slot s is at ((s / width) * K + k) * width + s % width, where the width
/// is that of a pack on a host and of coalesced access on a GPU.
template <class S>
KOKKOS_INLINE_FUNCTION constexpr long tiled_slot(int slot, int values, int value) {
  return (static_cast<long>(slot / tile_width<S>) * values + value) * tile_width<S> + slot % tile_width<S>;
}

/// Where value k of K of a batch's first lane lies.
template <class S>
KOKKOS_INLINE_FUNCTION constexpr long tiled(int batch, int values, int value) {
  return tiled_slot<S>(batch * lane_count<S>, values, value);
}

template <class S>
KOKKOS_FORCEINLINE_FUNCTION Pack<S> load(const S* p) {
#ifdef RAILWAVE_SIMD_LANES
  return Pack<S>(p, std::experimental::element_aligned);
#else
  return *p;
#endif
}

template <class S>
KOKKOS_FORCEINLINE_FUNCTION void store(S* p, const Pack<S>& value) {
#ifdef RAILWAVE_SIMD_LANES
  value.copy_to(p, std::experimental::element_aligned);
#else
  *p = value;
#endif
}

#ifdef RAILWAVE_SIMD_LANES
/// Asks memory for what will be read. Whatever calls it must be inlined by force as well, because g++ 12 takes a
/// function that only prefetches for one without effect and leaves its calls out.
KOKKOS_FORCEINLINE_FUNCTION void prefetch(const void* place) { __builtin_prefetch(place); }

/// So many nodes later what a host's core asks of memory now has come; 12 and 24 are as good.
inline constexpr int prefetch_ahead = 12;

/// Places in an array, one for each lane, and the values there: the processor's own gather is a good deal faster than
/// lane by lane. (The forms with a mask, because g++ 12 warns of the others.)
template <class S, class Index>
struct LanePlaces {
  const Index* place;
  explicit LanePlaces(const Index* places) : place(places) {}
  Pack<S> gather(const S* values) const {
    return Pack<S>([&](auto lane) { return values[place[lane]]; });
  }
};
#if defined(__AVX512F__)
template <class Index>
struct LanePlaces<double, Index> {
  __m256i place;
  explicit LanePlaces(const std::uint8_t* p) : place(_mm256_cvtepu8_epi32(_mm_loadu_si64(p))) {}
  explicit LanePlaces(const std::uint16_t* p)
      : place(_mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)))) {}
  Pack<double> gather(const double* values) const {
    return Pack<double>(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, place, values, 8));
  }
};
template <class Index>
struct LanePlaces<float, Index> {
  __m512i place;
  explicit LanePlaces(const std::uint8_t* p)
      : place(_mm512_maskz_cvtepu8_epi32(0xffff, _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)))) {}
  explicit LanePlaces(const std::uint16_t* p)
      : place(_mm512_maskz_cvtepu16_epi32(0xffff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)))) {}
  Pack<float> gather(const float* values) const {
    return Pack<float>(_mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, place, values, 4));
  }
};
#elif defined(__AVX2__)
// With a mask of all lanes: without one g++ 12 warns of the register that a gather begins with.
template <class Index>
struct LanePlaces<double, Index> {
  __m128i place;
  explicit LanePlaces(const std::uint8_t* p) : place(_mm_cvtepu8_epi32(_mm_loadu_si32(p))) {}
  explicit LanePlaces(const std::uint16_t* p) : place(_mm_cvtepu16_epi32(_mm_loadu_si64(p))) {}
  Pack<double> gather(const double* values) const {
    const __m256d none = _mm256_setzero_pd(), all = _mm256_cmp_pd(none, none, _CMP_EQ_OQ);
    return Pack<double>(_mm256_mask_i32gather_pd(none, values, place, all, 8));
  }
};
template <class Index>
struct LanePlaces<float, Index> {
  __m256i place;
  explicit LanePlaces(const std::uint8_t* p) : place(_mm256_cvtepu8_epi32(_mm_loadu_si64(p))) {}
  explicit LanePlaces(const std::uint16_t* p)
      : place(_mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)))) {}
  Pack<float> gather(const float* values) const {
    const __m256 none = _mm256_setzero_ps(), all = _mm256_cmp_ps(none, none, _CMP_EQ_OQ);
    return Pack<float>(_mm256_mask_i32gather_ps(none, values, place, all, 4));
  }
};
#endif
#endif

/// The values at a pack's places.
template <class S, class Index>
KOKKOS_FORCEINLINE_FUNCTION Pack<S> gather(const S* values, const Index* places) {
#ifdef RAILWAVE_SIMD_LANES
  return LanePlaces<S, Index>(places).gather(values);
#else
  return values[*places];
#endif
}

/// The eight corners of a batch's elements as places in their block's list of nodes (below 256).
/// Stored corner by corner, a pack's lanes together; on a GPU an element's eight bytes are one load.
template <class S>
struct BatchCorners {
#ifdef RAILWAVE_SIMD_LANES
  const std::uint8_t* bytes;
  explicit BatchCorners(const std::uint8_t* bytes_) : bytes(bytes_) {}
  /// values[corner N of each lane]
  Pack<S> gather(const S* values, int N) const { return railwave::gather(values, bytes + N * lane_count<S>); }
#else
  std::uint64_t corners;

  KOKKOS_INLINE_FUNCTION explicit BatchCorners(const std::uint8_t* bytes)
      : corners(*reinterpret_cast<const std::uint64_t*>(bytes)) {}
  KOKKOS_INLINE_FUNCTION S gather(const S* values, int N) const { return values[(corners >> (8 * N)) & 255]; }
#endif
};

/// a b + c, fused where the machine can: written out so that it is rounded the same way wherever it is inlined.
KOKKOS_INLINE_FUNCTION double multiply_add(double a, double b, double c) {
#if defined(RAILWAVE_DEVICE_CODE) || defined(FP_FAST_FMA) || defined(__FMA__)
  return fma(a, b, c);
#else
  return a * b + c;
#endif
}
KOKKOS_INLINE_FUNCTION float multiply_add(float a, float b, float c) {
#if defined(RAILWAVE_DEVICE_CODE) || defined(FP_FAST_FMAF) || defined(__FMA__)
  return fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

}  // namespace railwave
