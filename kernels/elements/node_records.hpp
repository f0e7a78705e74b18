#pragma once

#include "kernels/elements/element_blocks.hpp"

/// A block's nodes in double precision on a host. A gather instruction costs a processor two cycles a lane and more,
/// and an element needs 72 values of its nodes. So a node's values lie together, in pairs of 16 bytes: a load for each
/// pair and lane and a shuffle for each value make a pack. Corner forces are added to the nodes' sums at once, as rows
/// of four, because stored by corner they would need the caches and a gather once more.
namespace railwave {

#ifdef RAILWAVE_SIMD_LANES

/// Packs of the pair of values at `pair` from each lane's record.
KOKKOS_FORCEINLINE_FUNCTION void load_pair(const double* const (&record)[lane_count<double>], int pair,
                                           Pack<double>& first, Pack<double>& second) {
  const int k = 2 * pair;
#if defined(__AVX512F__) || defined(__AVX2__)
  const auto two_lanes = [&](int lane) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(record[lane] + k)),
                                _mm_load_pd(record[lane + 2] + k), 1);
  };
#endif
#if defined(__AVX512F__)
  const auto four_lanes = [&](int lane) {
    return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(two_lanes(lane)), two_lanes(lane + 4), 1);
  };
  const __m512d even = four_lanes(0), odd = four_lanes(1);
  first = Pack<double>(_mm512_maskz_unpacklo_pd(0xff, even, odd));
  second = Pack<double>(_mm512_maskz_unpackhi_pd(0xff, even, odd));
#elif defined(__AVX2__)
  const __m256d even = two_lanes(0), odd = two_lanes(1);
  first = Pack<double>(_mm256_unpacklo_pd(even, odd));
  second = Pack<double>(_mm256_unpackhi_pd(even, odd));
#else
  first = Pack<double>([&](auto lane) { return record[lane][k]; });
  second = Pack<double>([&](auto lane) { return record[lane][k + 1]; });
#endif
}

/// Subtracts the components of the first `lanes` lanes from the rows of four at places[lane].
KOKKOS_FORCEINLINE_FUNCTION void subtract_rows(double* rows, const std::uint8_t* places, int lanes,
                                               const Pack<double> (&component)[3]) {
#if defined(__AVX2__)
  const __m256d none = _mm256_setzero_pd();
  const auto subtract = [&](int lane, __m256d force) {
    if (lane >= lanes) return;
    double* row = rows + 4 * places[lane];
    _mm256_storeu_pd(row, _mm256_sub_pd(_mm256_loadu_pd(row), force));
  };
  for (int lane = 0; lane < lane_count<double>; lane += 4) {
    __m256d c[3];
    for (int i = 0; i < 3; ++i) c[i] = _mm256_loadu_pd(reinterpret_cast<const double*>(&component[i]) + lane);
    const __m256d xy_even = _mm256_unpacklo_pd(c[0], c[1]), z_even = _mm256_unpacklo_pd(c[2], none);
    const __m256d xy_odd = _mm256_unpackhi_pd(c[0], c[1]), z_odd = _mm256_unpackhi_pd(c[2], none);
    subtract(lane, _mm256_insertf128_pd(xy_even, _mm256_castpd256_pd128(z_even), 1));
    subtract(lane + 1, _mm256_insertf128_pd(xy_odd, _mm256_castpd256_pd128(z_odd), 1));
    subtract(lane + 2, _mm256_permute2f128_pd(xy_even, z_even, 0x31));
    subtract(lane + 3, _mm256_permute2f128_pd(xy_odd, z_odd, 0x31));
  }
#else
  for (int lane = 0; lane < lanes && lane < lane_count<double>; ++lane)
    for (int i = 0; i < 3; ++i) rows[4 * places[lane] + i] -= component[i][lane];
#endif
}

/// What lies in a record, x the position, u the displacement, v the velocity: x0 x1, u0 u1, x2 u2, then v0 v1, v2 mass
/// or nothing and the mass.
template <bool WithVelocity>
struct NodeRecords {
  static constexpr int values = WithVelocity ? 10 : 8, mass_place = values - 1;
  static constexpr int position_value(int i) { return i < 2 ? i : 4; }
  static constexpr int displacement_value(int i) { return i < 2 ? 2 + i : 5; }
  static constexpr int velocity_value(int i) { return 6 + i; }
  /// Elements whose corners are loaded, computed and added up together: as many whatever the lanes of a pack, so that
  /// sums have the same order on any processor.
  static constexpr int group = elements_of_group;
  static_assert(group % lane_count<double> == 0 && elements_of_block % group == 0);

  double* record;
  double* sum;  ///< forces, N, in rows of four, the last of which is zero

  static std::size_t scratch_size(int stride) {
    return sizeof(double) * (values + 4) * static_cast<std::size_t>(stride) + 2 * cache_line;
  }

  template <class Member>
  NodeRecords(const Member& team, int stride)
      : record(scratch_values<double>(team, static_cast<std::size_t>(values) * stride, cache_line)),
        sum(scratch_values<double>(team, std::size_t(4) * stride, cache_line)) {}

  /// @param number of the block's nodes
  void bring(const NodeArrays& nodes, const int* number, int count) const {
    for (int l = 0; l < count; ++l) {
      const int n = number[l] & ~advance_bit;
      put(record + values * l, &nodes.position(n, 0), &nodes.reference(n, 0), &nodes.velocity(n, 0), nodes.mass(n));
    }
    for (int k = 0; k < 4 * count; ++k) sum[k] = 0;
  }

  static void put(double* r, const double* x, const double* X, [[maybe_unused]] const double* v, double mass) {
#if defined(__SSE2__)
    // In the order of memory, two at once.
    const __m128d now = _mm_loadu_pd(x), last = _mm_load_sd(x + 2);
    _mm_store_pd(r, now);
    _mm_store_pd(r + 2, _mm_sub_pd(now, _mm_loadu_pd(X)));
    _mm_store_pd(r + 4, _mm_unpacklo_pd(last, _mm_sub_sd(last, _mm_load_sd(X + 2))));
    if constexpr (WithVelocity) _mm_store_pd(r + 6, _mm_loadu_pd(v));
#else
    r[0] = x[0], r[1] = x[1], r[2] = x[0] - X[0], r[3] = x[1] - X[1], r[4] = x[2], r[5] = x[2] - X[2];
    if constexpr (WithVelocity) r[6] = v[0], r[7] = v[1];
#endif
    if constexpr (WithVelocity) r[8] = v[2];
    r[mass_place] = mass;
  }

  /// What an element kernel asks of a batch's corners, and where it puts their forces.
  struct Batch {
    using T = Pack<double>;
    T value[values][8];
    T force[8][3];  ///< N, with their sign turned

    /// @param places of the corners, corner by corner
    void load(const NodeRecords& nodes, const std::uint8_t* places) {
      for (int N = 0; N < 8; ++N) {
        const double* of_lane[lane_count<double>];
        for (int lane = 0; lane < lane_count<double>; ++lane)
          of_lane[lane] = nodes.record + values * places[N * lane_count<double> + lane];
        for (int pair = 0; pair < values / 2; ++pair)
          load_pair(of_lane, pair, value[2 * pair][N], value[2 * pair + 1][N]);
      }
    }
    void position(int i, T (&m)[7]) const { modes_of(value[position_value(i)], m); }
    void displacement(int i, T (&m)[7]) const { modes_of(value[displacement_value(i)], m); }
    void velocity(int i, T (&m)[7]) const { modes_of(value[velocity_value(i)], m); }
    void put_force(int i, const T (&m)[7]) {
      T f[8];
      corners_of(m, f);
      for (int N = 0; N < 8; ++N) force[N][i] = f[N];
    }
  };

  /// Takes the forces of a group's batches from the sums.
  /// @param elements of the group; slots beyond them are left out
  void subtract(const Batch* batch, const std::uint8_t* places, int elements) const {
    constexpr int lanes = lane_count<double>;
    for (int N = 0; N < 8; ++N)
      for (int k = 0; k < group / lanes; ++k) {
        const std::uint8_t* of_lane = places + (8 * k + N) * lanes;
        if (elements >= group)
          subtract_rows(sum, of_lane, lanes, batch[k].force[N]);
        else
          subtract_rows(sum, of_lane, elements - k * lanes, batch[k].force[N]);
      }
  }

  /// Moves node n, at place l of the block.
  void advance(const NodeAdvance& nodes, int n, int l) const {
    const double* r = record + values * l;
    nodes.move_under(n, 1.0 / r[mass_place], sum + 4 * l, r, r[4], WithVelocity ? r + 6 : &nodes.nodes.velocity(n, 0));
  }

  /// Asks memory for nodes that are soon needed: their rows lie wherever the mesh has them, and no processor foresees
  /// that.
  KOKKOS_FORCEINLINE_FUNCTION static void prefetch_nodes(const NodeArrays& nodes, const int* number, int begin,
                                                         int end) {
    for (int l = begin; l < end; ++l) {
      const int n = number[l] & ~advance_bit;
      prefetch(&nodes.position(n, 0));
      prefetch(&nodes.reference(n, 0));
      prefetch(&nodes.velocity(n, 0));
      prefetch(&nodes.mass(n));
    }
  }
};
#endif

}  // namespace railwave
