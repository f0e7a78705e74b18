#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Members of a set, ascending without repeats.
inline void sort_unique(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

inline void sort_unique(std::vector<Face>& faces) {
  const auto place = [](const Face& face) { return std::make_tuple(face.element, face.side); };
  std::sort(faces.begin(), faces.end(), [&](const Face& a, const Face& b) { return place(a) < place(b); });
  faces.erase(
      std::unique(faces.begin(), faces.end(), [&](const Face& a, const Face& b) { return place(a) == place(b); }),
      faces.end());
}

}  // namespace railwave
