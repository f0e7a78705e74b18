#pragma once

#include "kernels/elements/node_records.hpp"

namespace railwave {

#ifdef RAILWAVE_SIMD_LANES

/// Values of a block's edges in double precision on a host. Of an element's corner values the kernels need sums and
/// differences over its edges along xi first, and neighbours across eta and zeta have the same. So these are computed
/// once for each edge and lie as packs: edge groups (see ElementBlocks) need neither gathers nor shuffles when elements
/// read them. Corner forces go the same way back: their half sums and half differences over an edge are added up for
/// all its elements, and to its nodes at the end.
template <bool WithVelocity>
struct EdgeRecords {
  using Nodes = NodeRecords<WithVelocity>;
  static constexpr int lanes = lane_count<double>, width = Nodes::group;
  /// Of a node's record, in its order; without the mass.
  static constexpr int values = WithVelocity ? 9 : 6;
  /// A group's record: sums and differences of each value, then half sums and half differences of three force
  /// components.
  static constexpr int difference = width, next_value = 2 * width, force = values * next_value,
                       size = force + 3 * next_value;

  double* record;

  static std::size_t scratch_size(int edge_groups) {
    return sizeof(double) * size * static_cast<std::size_t>(edge_groups) + cache_line;
  }

  template <class Member>
  EdgeRecords(const Member& team, int edge_groups)
      : record(scratch_values<double>(team, static_cast<std::size_t>(size) * edge_groups, cache_line)) {}

  /// @param node of each edge, those of lower xi first
  void make(const Nodes& nodes, const std::uint8_t* node, double* edge) const {
    for (int first = 0; first < width; first += lanes) {
      const double *low[lanes], *high[lanes];
      for (int lane = 0; lane < lanes; ++lane) {
        low[lane] = nodes.record + Nodes::values * node[first + lane];
        high[lane] = nodes.record + Nodes::values * node[width + first + lane];
      }
      for (int pair = 0; 2 * pair < values; ++pair) {
        Pack<double> a[2], b[2];
        load_pair(low, pair, a[0], a[1]);
        load_pair(high, pair, b[0], b[1]);
        for (int k = 0; k < 2 && 2 * pair + k < values; ++k) {
          double* to = edge + (2 * pair + k) * next_value + first;
          store(to, Pack<double>(a[k] + b[k]));
          store(to + difference, Pack<double>(b[k] - a[k]));
        }
      }
      for (int k = 0; k < 6; ++k) store(edge + force + k * width + first, Pack<double>(0.0));
    }
  }

  /// Takes the forces of an edge group's elements from the nodes' sums.
  void subtract(const Nodes& nodes, const std::uint8_t* node, const double* edge) const {
    for (int first = 0; first < width; first += lanes) {
      Pack<double> low[3], high[3];
      for (int i = 0; i < 3; ++i) {
        const double* of_component = edge + force + i * next_value + first;
        const Pack<double> sum = load(of_component), half_difference = load(of_component + difference);
        low[i] = sum - half_difference;
        high[i] = sum + half_difference;
      }
      subtract_rows(nodes.sum, node + first, lanes, low);
      subtract_rows(nodes.sum, node + width + first, lanes, high);
    }
  }

  /// What an element kernel asks of a batch's corners, and where it puts their forces.
  struct Batch {
    using T = Pack<double>;
    double* edge[4];  ///< at the batch's first lane: of corners 0 and 1, 3 and 2, 4 and 5, 7 and 6

    void modes(int value, T (&m)[7]) const {
      T sum[4], change[4];
      for (int k = 0; k < 4; ++k) {
        sum[k] = load(edge[k] + value * next_value);
        change[k] = load(edge[k] + value * next_value + difference);
      }
      modes_of_edges(sum, change, m);
    }
    void position(int i, T (&m)[7]) const { modes(Nodes::position_value(i), m); }
    void displacement(int i, T (&m)[7]) const { modes(Nodes::displacement_value(i), m); }
    void velocity(int i, T (&m)[7]) const { modes(Nodes::velocity_value(i), m); }

    void put_force(int i, const T (&m)[7]) const {
      T sum[4], change[4];
      edges_of(m, sum, change);
      for (int k = 0; k < 4; ++k) {
        add(edge[k] + force + i * next_value, sum[k]);
        add(edge[k] + force + i * next_value + difference, change[k]);
      }
    }

    static void add(double* to, const T& value) { store(to, T(load(to) + value)); }
  };
};
#endif

}  // namespace railwave
