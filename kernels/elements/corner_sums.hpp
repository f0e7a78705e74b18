#pragma once

#include "kernels/elements/element_blocks.hpp"

namespace railwave {

/// What a block's elements do to its nodes: corner forces, which lie in scratch memory component by component with
/// their sign turned, added up node by node in the order of the elements.
///
/// A host adds up a pack of nodes at a time: `first` says where each pack's places begin, its lanes together. A thread
/// of a device adds up a node, four corners at a time, so that it waits for memory as seldom as it can: first come the
/// places of every node's first four corners, then those of the next four for nodes that have more, and so on. Nodes
/// are in order of how many such rounds they take (see block_nodes.hpp), so `first` has the first node of each round
/// but the first.
struct CornerSums {
  const std::uint16_t* first;
  const std::uint16_t* place;
  int count;   ///< nodes
  int rounds;  ///< beyond the first, on a device

  KOKKOS_FORCEINLINE_FUNCTION CornerSums(const ElementBlocks& blocks, int p, int count_)
      : CornerSums(blocks, p, count_, blocks.place.data() + static_cast<long>(p) * blocks.place_stride) {}

  /// @param place_ a copy of the block's places
  KOKKOS_FORCEINLINE_FUNCTION CornerSums(const ElementBlocks& blocks, int p, int count_, const std::uint16_t* place_)
      : first(blocks.first_place.data() + static_cast<long>(p) * blocks.first_stride),
        place(place_),
        count(count_),
        rounds(blocks.first_stride) {}

  /// Forces at a pack of nodes, N.
  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION void add_up(int pack, const S* force, Pack<S> (&sum)[3]) const {
    for (auto& component : sum) component = S(0);
    if constexpr (on_device) {
      subtract_four(quad(pack), force, sum);
      int begin = count;
      for (int r = 0; r < rounds; ++r) {
        if (pack >= first[r]) subtract_four(quad(begin + pack - first[r]), force, sum);
        begin += count - first[r];
      }
    } else {
      for (int c = first[pack]; c < first[pack + 1]; c += lane_count<S>)
        for (int i = 0; i < 3; ++i) sum[i] -= gather(force + i * component_stride, place + c);
    }
  }

  /// Forces at a device's thread's two nodes, side by side, N.
  /// @param there whether there is such a node
  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION void add_up_pair(const int (&l)[2], const bool (&there)[2], const S* force,
                                               S (&sum)[2][3]) const {
    for (int k = 0; k < 2; ++k) {
      for (S& component : sum[k]) component = S(0);
      if (there[k]) subtract_four(quad(l[k]), force, sum[k]);
    }
    int begin = count;
    for (int r = 0; r < rounds; ++r) {
      const int from = first[r];
      for (int k = 0; k < 2; ++k)
        if (there[k] && l[k] >= from) subtract_four(quad(begin + l[k] - from), force, sum[k]);
      begin += count - from;
    }
  }

 private:
  /// Four places, the first lowest.
  KOKKOS_FORCEINLINE_FUNCTION std::uint64_t quad(int q) const {
    return reinterpret_cast<const std::uint64_t*>(place)[q];
  }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void subtract_four(std::uint64_t quad, const S* force, T (&sum)[3]) {
    S f[corners_at_once][3];
    for (int k = 0; k < corners_at_once; ++k)
      for (int i = 0; i < 3; ++i) f[k][i] = force[i * component_stride + ((quad >> (16 * k)) & 0xffff)];
    for (const auto& corner : f)
      for (int i = 0; i < 3; ++i) sum[i] -= corner[i];
  }
};

/// A thread's share of a block's list of places, on its way to scratch memory.
struct PlacesOnTheWay {
  static constexpr int shares = (most_places / places_at_once + elements_of_block - 1) / elements_of_block;
  Chunk chunk[shares];
  int from, step, count;

  template <class Member>
  KOKKOS_FORCEINLINE_FUNCTION PlacesOnTheWay(const Member& team, const ElementBlocks& blocks, int p)
      : from(team.team_rank()), step(team.team_size()), count(blocks.place_stride / places_at_once) {
    const auto* places =
        reinterpret_cast<const Chunk*>(blocks.place.data() + static_cast<long>(p) * blocks.place_stride);
    for (int k = 0; k < shares; ++k)
      if (from + k * step < count) chunk[k] = places[from + k * step];
  }

  KOKKOS_FORCEINLINE_FUNCTION void put(std::uint16_t* scratch) const {
    for (int k = 0; k < shares; ++k)
      if (from + k * step < count) reinterpret_cast<Chunk*>(scratch)[from + k * step] = chunk[k];
  }
};

}  // namespace railwave
