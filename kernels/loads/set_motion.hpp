#pragma once

#include "kernels/support/spaces.hpp"
#include "kernels/support/vector3.hpp"

namespace railwave {

/// A few nodes of a set, summed by one thread: the sums' order, and so their last bit, is the same for any team.
struct alignas(16) SetChunk {
  static constexpr int size = 8;
  int origin;  ///< NodeSets::origin of its set
  int begin, end, unused;
};

/// A set whose sums a team finds, and its chunks.
struct alignas(16) SummedSet {
  int set, first_chunk, end_chunk, unused;
};

/// Node sets with weights (fractions of the set's mass, summing to one). The first `moving` are those whose mean motion
/// connectors and torques need at each step.
struct NodeSets {
  static constexpr int values = 12;

  int moving = 0;
  Array<int*> nodes;
  Array<double*> weight;
  Array<int*> origin;        ///< moving; a set's first node, from which its others are measured
  Array<SummedSet*> summed;  ///< moving; these and the chunks in the order of the teams that sum them
  Array<SetChunk*> chunks;
  Array<double* [values]> sums;  ///< by set: weighted r (3, m), velocity (3, m/s), r r: xx, yy, zz, yz, zx, xy (m2); r
                                 ///< is the position less that of the origin
};

/// Sums over node sets in two passes, between which a team waits, and what follows from them.
struct SetMotion {
  NodeSets sets;
  Array<const double*[3]> position, velocity;

  /// First pass.
  /// @tparam nodes_at_once asked of memory: on a GPU a thread does little but wait
  /// @param sums the chunk's, NodeSets::values
  template <int nodes_at_once>
  KOKKOS_INLINE_FUNCTION void sum_chunk(int c, double* sums) const {
    const SetChunk chunk = sets.chunks(c);
    const Vector3 origin = row(position, chunk.origin);
    double sum[NodeSets::values] = {};
    for (int first = chunk.begin; first < chunk.end; first += nodes_at_once) {
      int n[nodes_at_once];
      double w[nodes_at_once];
      Vector3 x[nodes_at_once], v[nodes_at_once];
      for (int j = 0; j < nodes_at_once; ++j) {
        const int k = first + j < chunk.end ? first + j : first;
        n[j] = sets.nodes(k);
        w[j] = sets.weight(k);
      }
      for (int j = 0; j < nodes_at_once; ++j) {
        x[j] = row(position, n[j]);
        v[j] = row(velocity, n[j]);
      }
      for (int j = 0; j < nodes_at_once; ++j) {
        if (first + j >= chunk.end) break;
        const Vector3 r = x[j] - origin;
        for (int i = 0; i < 3; ++i) {
          sum[i] += w[j] * r[i];
          sum[3 + i] += w[j] * v[j][i];
          sum[6 + i] += w[j] * r[i] * r[i];
          sum[9 + i] += w[j] * r[(i + 1) % 3] * r[(i + 2) % 3];
        }
      }
    }
    for (int i = 0; i < NodeSets::values; ++i) sums[i] = sum[i];
  }

  /// Second pass: adds chunks from `first` to `end`, as far as they are the set's, to one of its sums.
  /// @param k number of a sum: NodeSets::values for each of NodeSets::summed
  /// @param summed set of this sum
  /// @param partial sums of these chunks, one chunk's behind the other
  KOKKOS_INLINE_FUNCTION void add_chunks(int k, const SummedSet& summed, int first, int end,
                                         const double* partial) const {
    const int value = k % NodeSets::values;
    const int begin = summed.first_chunk > first ? summed.first_chunk : first;
    if (summed.end_chunk < end) end = summed.end_chunk;
    if (begin >= end) return;
    double sum = begin == summed.first_chunk ? 0 : sets.sums(summed.set, value);
    for (int c = begin; c < end; ++c) sum += partial[(c - first) * NodeSets::values + value];
    sets.sums(summed.set, value) = sum;
  }

  KOKKOS_INLINE_FUNCTION SummedSet summed_by(int k) const { return sets.summed(k / NodeSets::values); }

  /// A set and where its origin is, which is known before its sums are.
  struct Placed {
    int set = -1;  ///< -1: none
    Vector3 origin{{0, 0, 0}};
  };

  KOKKOS_INLINE_FUNCTION Placed placed(int set) const {
    return set < 0 ? Placed{} : Placed{set, row(position, sets.origin(set))};
  }

  KOKKOS_INLINE_FUNCTION Vector3 mean_position(const Placed& of) const {
    return of.origin + Vector3{{sets.sums(of.set, 0), sets.sums(of.set, 1), sets.sums(of.set, 2)}};
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
