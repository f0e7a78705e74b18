#pragma once

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "mesh/hexahedron.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// What the faces of a mesh say about it: a conforming solid has no face in more than two elements, and its outside is
/// one closed surface with each edge in two faces. A crack or a hanging node changes components or Euler number.
struct Topology {
  int crowded_faces = 0;  ///< in more than two elements
  int open_edges = 0;     ///< of the outside, not in exactly two of its faces
  int components = 0;     ///< of the outside
  int euler = 0;          ///< of the outside: 2 for a ball, 0 for a ring
  int unused_nodes = 0;
  double largest_size_ratio = 0;  ///< of V / A_max across faces
};

inline Topology topology(const Mesh& mesh) {
  Topology result;
  std::map<std::array<int, 4>, std::vector<Face>> faces;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      auto key = mesh.face_nodes({e, side});
      std::sort(key.begin(), key.end());
      faces[key].push_back({e, side});
    }
  std::vector<double> size;
  for (const auto& element : mesh.elements) size.push_back(hexahedron_length(corners_of(mesh.nodes, element)));
  std::map<std::pair<int, int>, int> edges;
  std::vector<int> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  std::set<int> nodes;
  int outside = 0;
  for (const auto& [key, users] : faces) {
    if (users.size() > 2) ++result.crowded_faces;
    if (users.size() == 2) {
      const double a = size[users[0].element], b = size[users[1].element];
      result.largest_size_ratio = std::max(result.largest_size_ratio, std::max(a / b, b / a));
    }
    if (users.size() != 1) continue;
    ++outside;
    const auto corners = mesh.face_nodes(users[0]);
    for (int i = 0; i < 4; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 4];
      ++edges[{std::min(a, b), std::max(a, b)}];
      nodes.insert(a);
      root[find(a)] = find(b);
    }
  }
  for (const auto& [edge, count] : edges)
    if (count != 2) ++result.open_edges;
  std::set<int> roots;
  for (int n : nodes) roots.insert(find(n));
  result.components = static_cast<int>(roots.size());
  result.euler = static_cast<int>(nodes.size()) - static_cast<int>(edges.size()) + outside;
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const auto& element : mesh.elements)
    for (int n : element) used[n] = 1;
  result.unused_nodes = static_cast<int>(std::count(used.begin(), used.end(), 0));
  return result;
}

/// Half the vector product of a face's diagonals: outwards, as long as its area, m2.
inline Vec3 area_vector(const Mesh& mesh, const Face& face) {
  const auto n = mesh.face_nodes(face);
  Vec3 p, q;
  for (int i = 0; i < 3; ++i) {
    p[i] = mesh.nodes[n[2]][i] - mesh.nodes[n[0]][i];
    q[i] = mesh.nodes[n[3]][i] - mesh.nodes[n[1]][i];
  }
  return {0.5 * (p[1] * q[2] - p[2] * q[1]), 0.5 * (p[2] * q[0] - p[0] * q[2]), 0.5 * (p[0] * q[1] - p[1] * q[0])};
}

/// The sum of these over a surface: zero where it is closed.
inline Vec3 area_vector(const Mesh& mesh, const std::vector<Face>& surface) {
  Vec3 sum{0, 0, 0};
  for (const Face& face : surface) {
    const Vec3 area = area_vector(mesh, face);
    for (int i = 0; i < 3; ++i) sum[i] += area[i];
  }
  return sum;
}

/// Shortest and longest edge of some elements, m.
inline std::pair<double, double> edge_range(const Mesh& mesh, const std::vector<int>& elements) {
  std::pair<double, double> range{1e300, 0};
  for (int e : elements)
    for (const auto& side : hexahedron_face_corners)
      for (int i = 0; i < 4; ++i) {
        const Vec3 &a = mesh.nodes[mesh.elements[e][side[i]]], &b = mesh.nodes[mesh.elements[e][side[(i + 1) % 4]]];
        const double length =
            std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
        range.first = std::min(range.first, length);
        range.second = std::max(range.second, length);
      }
  return range;
}

/// Whether a mesh is one conforming solid that uses all its nodes.
/// @param euler of its outside
inline void check_solid(const Topology& found, int euler) {
  CHECK(found.crowded_faces == 0);
  CHECK(found.open_edges == 0);
  CHECK(found.components == 1);
  CHECK(found.euler == euler);
  CHECK(found.unused_nodes == 0);
}

}  // namespace railwave
