#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "model/assembly.hpp"

namespace railwave {

/// Numbers from first to last.
struct NumberRange {
  int first = 0, last = -1;
  int count() const { return last - first + 1; }
  void include(int number) {
    if (count() == 0) first = last = number;
    first = std::min(first, number);
    last = std::max(last, number);
  }
};

/// The numbers of elements[begin, end), and of their nodes.
inline NumberRange element_range(const std::vector<int>& elements, int begin, int end) {
  NumberRange range;
  for (int k = begin; k < end; ++k) range.include(elements[k]);
  return range;
}

inline NumberRange node_range(const std::vector<CornerNodes>& corners, const std::vector<int>& elements, int begin,
                              int end) {
  NumberRange range;
  for (int k = begin; k < end; ++k)
    for (int n : corners[elements[k]]) range.include(n);
  return range;
}

/// Values by number, of a part's elements or nodes alone: a scene has many parts.
template <class T>
class ValuesOfRange {
 public:
  ValuesOfRange(const NumberRange& range, const T& value) : first_(range.first), values_(range.count(), value) {}
  T& operator[](int number) { return values_[number - first_]; }
  const T& operator[](int number) const { return values_[number - first_]; }

 private:
  int first_;
  std::vector<T> values_;
};

}  // namespace railwave
