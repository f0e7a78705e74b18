#include <algorithm>
#include <numeric>
#include <utility>

#include "mesh/face_table.hpp"

namespace railwave {
namespace {

/// Root of an element's tree in a disjoint-set forest (union-find): the lowest element of its body so far.
int first_of(std::vector<int>& parent, int element) {
  while (parent[element] != element) element = parent[element] = parent[parent[element]];
  return element;
}

}  // namespace

int connected_bodies(const Mesh& mesh) {
  std::vector<std::pair<std::array<int, 4>, int>> faces;
  faces.reserve(6 * mesh.elements.size());
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      auto nodes = mesh.face_nodes({e, side});
      std::sort(nodes.begin(), nodes.end());
      faces.emplace_back(nodes, e);
    }
  std::sort(faces.begin(), faces.end());
  std::vector<int> parent(mesh.elements.size());
  std::iota(parent.begin(), parent.end(), 0);
  int bodies = static_cast<int>(parent.size());
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].first != faces[i - 1].first) continue;
    const int a = first_of(parent, faces[i - 1].second), b = first_of(parent, faces[i].second);
    if (a == b) continue;
    parent[std::max(a, b)] = std::min(a, b);
    --bodies;
  }
  return bodies;
}

}  // namespace railwave
