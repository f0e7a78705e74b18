#pragma once

#include "kernels/support/vector3.hpp"

namespace railwave {

/// A few nodes of a set, summed by one thread: the sums' order, and so their last bit, is the same for any team.
struct alignas(16) SetChunk {
  static constexpr int size = 8;
  int set, begin, end, unused;
};

/// Node sets with weights (fractions of the set's mass, summing to one). The first `moving` are those whose mean motion
/// connectors and torques need at each step.
struct NodeSets {
  static constexpr int values = 12;

  int count = 0, moving = 0;
  Array<int*> first;  ///< count + 1
  Array<int*> nodes;
  Array<double*> weight;
  Array<int*> first_chunk;  ///< moving + 1
  Array<SetChunk*> chunks;
  Array<double* [values]> partial;  ///< by chunk
  Array<double* [values]> sums;  ///< by set: weighted r (3, m), velocity (3, m/s), r r: xx, yy, zz, yz, zx, xy (m2); r
                                 ///< is the position less that of the set's first node
};

/// Sums over node sets in two passes, between which a team waits, and what follows from them.
struct SetMotion {
  NodeSets sets;
  Array<const double*[3]> position, velocity;

  /// First pass.
  KOKKOS_INLINE_FUNCTION void sum_chunk(int c) const {
    const SetChunk chunk = sets.chunks(c);
    const Vector3 origin = first_node(chunk.set);
    double sum[NodeSets::values] = {};
    for (int k = chunk.begin; k < chunk.end; ++k) {
      const int n = sets.nodes(k);
      const double w = sets.weight(k);
      const Vector3 r = row(position, n) - origin, v = row(velocity, n);
      for (int i = 0; i < 3; ++i) {
        sum[i] += w * r[i];
        sum[3 + i] += w * v[i];
        sum[6 + i] += w * r[i] * r[i];
        sum[9 + i] += w * r[(i + 1) % 3] * r[(i + 2) % 3];
      }
    }
    for (int i = 0; i < NodeSets::values; ++i) sets.partial(c, i) = sum[i];
  }

  /// Second pass: one of `moving` times `values` sums.
  KOKKOS_INLINE_FUNCTION void add_chunks(int k) const {
    const int set = k / NodeSets::values, value = k % NodeSets::values;
    double sum = 0;
    const int end = sets.first_chunk(set + 1);
    for (int c = sets.first_chunk(set); c < end; ++c) sum += sets.partial(c, value);
    sets.sums(set, value) = sum;
  }

  KOKKOS_INLINE_FUNCTION Vector3 first_node(int set) const { return row(position, sets.nodes(sets.first(set))); }

  KOKKOS_INLINE_FUNCTION Vector3 mean_position(int set) const {
    return first_node(set) + Vector3{{sets.sums(set, 0), sets.sums(set, 1), sets.sums(set, 2)}};
  }

  KOKKOS_INLINE_FUNCTION Vector3 mean_velocity(int set) const {
    return {{sets.sums(set, 3), sets.sums(set, 4), sets.sums(set, 5)}};
  }

  /// Weighted sum of the squared distances from an axis (unit vector) through the mean position, m2.
  KOKKOS_INLINE_FUNCTION double squared_arm(int set, const Vector3& axis) const {
    double trace = 0, along = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double square = sets.sums(set, 6 + i) - sets.sums(set, i) * sets.sums(set, i);
      const double mixed = sets.sums(set, 9 + i) - sets.sums(set, j) * sets.sums(set, k);
      trace += square;
      along += axis[i] * axis[i] * square + 2 * axis[j] * axis[k] * mixed;
    }
    return trace - along;
  }
};

}  // namespace railwave
