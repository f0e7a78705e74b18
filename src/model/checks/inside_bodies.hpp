#pragma once

#include <array>
#include <map>
#include <vector>

#include "model/assembly.hpp"

namespace railwave {

/// Which faces of the elements are on the outside of a body: those that belong to one element only.
class OutsideFaces {
 public:
  explicit OutsideFaces(const Assembly& assembly);
  bool has(const Face& face) const;

 private:
  const Assembly& assembly_;
  std::map<std::array<int, 4>, int> owners_;  ///< by sorted nodes: elements; only of faces that lie in a named surface
};

/// Two parts of which one lies inside the other.
struct PartOverlap {
  std::size_t first = 0, second = 0;  ///< positions in assembly.parts
  int inside = 0;                     ///< nodes of the smaller part that lie well inside elements of the other
  int nodes = 0;                      ///< of the smaller part
  Vec3 place{0, 0, 0};                ///< m, of the first of them
  bool coincident = false;            ///< the parts have the same nodes, within a millionth of their size
};

/// Pairs of parts that overlap, undeformed, after close_gap. A node counts as inside an element only nine tenths of its
/// half edges from its middle, so that surfaces that touch, or that curved meshes let cut a little into each other, do
/// not count.
std::vector<PartOverlap> part_overlaps(const Assembly& assembly);

}  // namespace railwave
