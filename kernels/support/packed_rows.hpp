#pragma once

#include "kernels/support/spaces.hpp"

namespace railwave {

/// Values of an array at listed places, one behind the other, to be sent; and back to their places.
/// @tparam There true: from the array; false: to it
template <class T, bool There>
struct PackedValues {
  Array<T*> array;
  Array<const int*> place;
  int width;  ///< values at each place, which is counted in these
  Array<T*> packed;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const long at = static_cast<long>(place(i / width)) * width + i % width;
    if constexpr (There)
      packed(i) = array(at);
    else
      array(at) = packed(i);
  }
};

/// The same of rows, whatever the array's layout.
template <class T, int N, bool There>
struct PackedRows {
  Array<T* [N]> array;
  Array<const int*> place;
  Array<T*> packed;

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
