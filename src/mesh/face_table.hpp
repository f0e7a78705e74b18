#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// The faces of a mesh's hexahedra, found by their four nodes: which are on the outside, and which face a quadrangle
/// is.
class FaceTable {
 public:
  explicit FaceTable(const Mesh& mesh);

  /// Faces that belong to one element only, by element, then side.
  std::vector<Face> exterior() const;

  /// All element faces with these four nodes, in any order: none, one (outside) or two (between two elements).
  std::vector<Face> find(std::array<int, 4> nodes) const;

  /// Faces at the same four nodes whose elements can't lie on either side of them (three or more elements, or two on
  /// the same side): the first such place, empty in a sound mesh. `mesh` is the one that the table was made from.
  std::vector<Face> overlapping(const Mesh& mesh) const;

 private:
  struct Entry {
    std::array<int, 4> nodes;  // ascending
    Face face;
  };
  std::vector<std::ptrdiff_t> first_;  // of each node: the first entry whose lowest node it is
  std::vector<Entry> entries_;         // ascending by nodes, then element and side
};

/// Number of separate bodies in a mesh. Elements are connected by common faces only: a common edge or node is a hinge.
int connected_bodies(const Mesh& mesh);

}  // namespace railwave
