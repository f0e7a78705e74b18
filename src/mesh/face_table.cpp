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

FaceTable::FaceTable(const Mesh& mesh) : first_(mesh.nodes.size() + 1, 0), entries_(6 * mesh.elements.size()) {
  // Faces are put into buckets by their lowest node, a few in each: much faster than sorting them all.
  const auto sorted_nodes = [&](const Face& face) {
    auto nodes = mesh.face_nodes(face);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  const int element_count = static_cast<int>(mesh.elements.size());
  for (int element = 0; element < element_count; ++element)
    for (int side = 0; side < 6; ++side) ++first_[sorted_nodes({element, side})[0] + 1];
  for (std::size_t node = 1; node < first_.size(); ++node) first_[node] += first_[node - 1];

  auto next = first_;
  for (int element = 0; element < element_count; ++element)
    for (int side = 0; side < 6; ++side) {
      const auto nodes = sorted_nodes({element, side});
      entries_[next[nodes[0]]++] = {nodes, {element, side}};
    }
  for (std::size_t node = 0; node + 1 < first_.size(); ++node)
    std::sort(entries_.begin() + first_[node], entries_.begin() + first_[node + 1], [](const Entry& a, const Entry& b) {
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
  std::vector<Face> faces;
  for (auto i = first_[nodes[0]]; i < first_[nodes[0] + 1]; ++i)
    if (entries_[i].nodes == nodes) faces.push_back(entries_[i].face);
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
