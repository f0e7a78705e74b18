#pragma once

#include "kernels/support/spaces.hpp"

namespace railwave {

/// A piece of packed values, wherever it lies.
struct PackedPiece {
  unsigned char* memory;  ///< aligned for its values
  long second;            ///< bytes to its second buffer
  int first;              ///< of its values, among those of all pieces
};

/// Packed values in pieces, one for each message. Every second exchange takes the second buffers.
template <class T>
struct PackedPieces {
  Array<const PackedPiece*> pieces;
  const unsigned long long* exchanges;  ///< so many are over; null: there are no second buffers
  unsigned long long over;              ///< when the first buffers were used first

  KOKKOS_INLINE_FUNCTION T& operator()(int i) const {
    int k = 0;
    while (k + 1 < static_cast<int>(pieces.extent(0)) && pieces(k + 1).first <= i) ++k;
    const PackedPiece piece = pieces(k);
    const bool second = exchanges != nullptr && ((*exchanges - over) & 1) != 0;
    return reinterpret_cast<T*>(piece.memory + (second ? piece.second : 0))[i - piece.first];
  }
};

/// Values of an array at listed places, one behind the other, to be sent; and back to their places.
/// @tparam There true: from the array; false: to it
template <class T, bool There, class Packed = Array<T*>>
struct PackedValues {
  Array<T*> array;
  Array<const int*> place;
  int width;  ///< values at each place, which is counted in these
  Packed packed;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const long at = static_cast<long>(place(i / width)) * width + i % width;
    if constexpr (There)
      packed(i) = array(at);
    else
      array(at) = packed(i);
  }
};

/// The same of rows, whatever the array's layout.
template <class T, int N, bool There, class Packed = Array<T*>>
struct PackedRows {
  Array<T* [N]> array;
  Array<const int*> place;
  Packed packed;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int n = place(i);
    for (int k = 0; k < N; ++k)
      if constexpr (There)
        packed(i * N + k) = array(n, k);
      else
        array(n, k) = packed(i * N + k);
  }
};

/// Two kernels in one launch.
template <class First, class Second>
struct OneAfterOther {
  First first;
  Second second;
  int count_of_first;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (i < count_of_first)
      first(i);
    else
      second(i - count_of_first);
  }
};

}  // namespace railwave
