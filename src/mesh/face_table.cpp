#include "mesh/face_table.hpp"

#include <algorithm>
#include <tuple>

namespace railwave {
namespace {

// Whether the second quadrangle runs round the same nodes the other way.
bool opposed(const std::array<int, 4>& a, const std::array<int, 4>& b) {
  for (int start = 0; start < 4; ++start)
    if (b[start] == a[0]) return b[(start + 3) % 4] == a[1] && b[(start + 2) % 4] == a[2];
  return false;
}

}  // namespace

FaceTable::FaceTable(const Mesh& mesh) {
  entries_.reserve(6 * mesh.elements.size());
  for (int element = 0; element < static_cast<int>(mesh.elements.size()); ++element)
    for (int side = 0; side < 6; ++side) {
      const Face face{element, side};
      auto nodes = mesh.face_nodes(face);
      std::sort(nodes.begin(), nodes.end());
      entries_.push_back({nodes, face});
    }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.nodes, a.face.element, a.face.side) < std::tie(b.nodes, b.face.element, b.face.side);
  });
}

std::vector<Face> FaceTable::exterior() const {
  std::vector<Face> faces;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const bool as_before = i > 0 && entries_[i - 1].nodes == entries_[i].nodes;
    const bool as_after = i + 1 < entries_.size() && entries_[i + 1].nodes == entries_[i].nodes;
    if (!as_before && !as_after) faces.push_back(entries_[i].face);
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return std::tie(a.element, a.side) < std::tie(b.element, b.side); });
  return faces;
}

std::vector<Face> FaceTable::find(std::array<int, 4> nodes) const {
  std::sort(nodes.begin(), nodes.end());
  auto entry = std::lower_bound(entries_.begin(), entries_.end(), nodes,
                                [](const Entry& a, const std::array<int, 4>& b) { return a.nodes < b; });
  std::vector<Face> faces;
  for (; entry != entries_.end() && entry->nodes == nodes; ++entry) faces.push_back(entry->face);
  return faces;
}

std::vector<Face> FaceTable::overlapping(const Mesh& mesh) const {
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    if (entries_[i - 1].nodes != entries_[i].nodes) continue;
    const bool third = i > 1 && entries_[i - 2].nodes == entries_[i].nodes;
    if (third || !opposed(mesh.face_nodes(entries_[i - 1].face), mesh.face_nodes(entries_[i].face)))
      return find(entries_[i].nodes);
  }
  return {};
}

}  // namespace railwave
