#include "mesh/files/numbered_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"
#include "mesh/face_table.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"

namespace railwave {
namespace {

// Triple product of a corner's edges over the product of their lengths: 1 at a right angle, 0 when they lie in a plane
// or their lengths can't be computed in a double.
double corner_volume(const HexahedronCorners& x, int corner) {
  Vec3 edge[3];
  double lengths = 1;
  for (int e = 0; e < 3; ++e) {
    edge[e] = difference(x[hexahedron_corner_neighbours[corner][e]], x[corner]);
    lengths *= length(edge[e]);
  }
  const double volume = dot(edge[0], cross(edge[1], edge[2]));
  return lengths > 0 && std::isfinite(volume / lengths) ? volume / lengths : 0;
}

template <typename Set>
void drop_empty(std::map<std::string, Set>& sets, const char* kind, std::vector<std::string>& notes) {
  for (auto set = sets.begin(); set != sets.end();) {
    if (set->second.empty()) {
      notes.push_back(fmt::format("{} '{}' is empty and was left out", kind, set->first));
      set = sets.erase(set);
    } else {
      ++set;
    }
  }
}

void add_implied_node_sets(Mesh& mesh) {
  for (const auto& [name, faces] : mesh.surfaces) {
    if (mesh.node_sets.count(name)) continue;
    auto& set = mesh.node_sets[name];
    for (const Face& face : faces)
      for (int node : mesh.face_nodes(face)) set.push_back(node);
    sort_unique(set);
  }
  for (const auto& [name, elements] : mesh.element_sets) {
    if (mesh.node_sets.count(name)) continue;
    auto& set = mesh.node_sets[name];
    for (int element : elements) set.insert(set.end(), mesh.elements[element].begin(), mesh.elements[element].end());
    sort_unique(set);
  }
}

std::string and_more(std::size_t others) { return others == 0 ? "" : fmt::format(" (and {} more like it)", others); }

}  // namespace

std::string NumberedMesh::where(const FilePlace& place) const {
  const auto format = binary ? "{}: byte {}:" : "{}:{}:";
  return fmt::format(fmt::runtime(format), files[place.file], place.position);
}

void NumberedMesh::add_node(std::int64_t number, const Vec3& position, const FilePlace& place) {
  const auto [entry, is_new] = node_positions_.try_emplace(number, static_cast<int>(node_numbers_.size()));
  if (!is_new)
    throw InputError(fmt::format("{} node {} is defined again (first at {}); give each node its own number",
                                 where(place), number, where(node_places_[entry->second])));
  node_numbers_.push_back(number);
  nodes_.push_back(position);
  node_places_.push_back(place);
}

void NumberedMesh::add_element(std::int64_t number, const std::array<std::int64_t, 8>& nodes, const FilePlace& place) {
  const auto [entry, is_new] = element_positions_.try_emplace(number, static_cast<int>(element_numbers_.size()));
  if (!is_new)
    throw InputError(fmt::format("{} element {} is defined again (first at {}); give each element its own number",
                                 where(place), number, where(element_places_[entry->second])));
  element_numbers_.push_back(number);
  elements_.push_back(nodes);
  element_places_.push_back(place);
}

std::optional<int> NumberedMesh::find_node(std::int64_t number) const {
  const auto entry = node_positions_.find(number);
  return entry == node_positions_.end() ? std::nullopt : std::optional<int>(entry->second);
}

std::optional<int> NumberedMesh::find_element(std::int64_t number) const {
  const auto entry = element_positions_.find(number);
  return entry == element_positions_.end() ? std::nullopt : std::optional<int>(entry->second);
}

Mesh NumberedMesh::connect() const {
  if (elements_.empty())
    throw InputError(
        fmt::format("{}: there are no 8-node hexahedra in this file; export the volume mesh too", files.front()));
  Mesh mesh;
  mesh.nodes = nodes_;
  mesh.elements.resize(elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto number = elements_[e][corner];
      const auto node = find_node(number);
      if (!node)
        throw InputError(
            fmt::format("{} element {} names node {}, which the file doesn't define; define it or mend the "
                        "element",
                        where(element_places_[e]), element_numbers_[e], number));
      for (int before = 0; before < corner; ++before)
        if (mesh.elements[e][before] == *node)
          throw InputError(
              fmt::format("{} element {} names node {} twice; a hexahedron needs eight different nodes, "
                          "collapsed ones (wedges) aren't read",
                          where(element_places_[e]), element_numbers_[e], number));
      mesh.elements[e][corner] = *node;
    }
  }
  return mesh;
}

void NumberedMesh::complete(Mesh& mesh, std::vector<std::string>& notes) const {
  check_shapes(mesh);
  const FaceTable faces(mesh);
  check_overlap(faces.overlapping(mesh));
  drop_unused_nodes(mesh, notes);
  for (auto& [name, set] : mesh.node_sets) sort_unique(set);
  for (auto& [name, set] : mesh.element_sets) sort_unique(set);
  for (auto& [name, set] : mesh.surfaces) sort_unique(set);
  drop_empty(mesh.node_sets, "node set", notes);
  drop_empty(mesh.element_sets, "element set", notes);
  drop_empty(mesh.surfaces, "surface", notes);
  if (!mesh.surfaces.count("exterior")) mesh.surfaces["exterior"] = faces.exterior();
  add_implied_node_sets(mesh);
}

void NumberedMesh::check_shapes(const Mesh& mesh) const {
  // Corners this close to lying in a plane can't be distinguished from inverted ones in rounding.
  constexpr double flat = 1e-10;
  std::optional<std::size_t> first_mirrored, first_bad;
  std::size_t mirrored = 0, bad = 0;
  int bad_corner = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const HexahedronCorners x = corners_of(mesh.nodes, mesh.elements[e]);
    int negative = 0, worst_corner = 0;
    double worst = 2;
    for (int corner = 0; corner < 8; ++corner) {
      const double volume = corner_volume(x, corner);
      if (volume < -flat) ++negative;
      if (volume < worst) {
        worst = volume;
        worst_corner = corner;
      }
    }
    if (worst > flat) continue;
    if (negative == 8) {
      if (mirrored++ == 0) first_mirrored = e;
    } else if (bad++ == 0) {
      first_bad = e;
      bad_corner = worst_corner;
    }
  }
  std::vector<std::string> complaints;
  if (first_mirrored)
    complaints.push_back(fmt::format(
        "{} element {} is mirrored{}: its nodes 1-2-3-4 must run counter-clockwise seen from nodes 5-6-7-8; exchange "
        "the first four with the last four, or mirror the mesh back where it was made",
        where(element_places_[*first_mirrored]), element_numbers_[*first_mirrored], and_more(mirrored - 1)));
  if (first_bad)
    complaints.push_back(
        fmt::format("{} element {} is flat or turned inside out at its corner {}, node {}{}; mend the order of its "
                    "nodes or the mesh "
                    "there",
                    where(element_places_[*first_bad]), element_numbers_[*first_bad], bad_corner + 1,
                    elements_[*first_bad][bad_corner], and_more(bad - 1)));
  if (!complaints.empty()) throw InputError(complaints);
}

void NumberedMesh::check_overlap(const std::vector<Face>& faces) const {
  if (faces.empty()) return;
  std::vector<std::int64_t> numbers;
  for (const Face& face : faces) numbers.push_back(element_numbers_[face.element]);
  throw InputError(fmt::format("{} elements {} share one face: they lie on one another; delete the doubles",
                               where(element_places_[faces.front().element]), fmt::join(numbers, ", ")));
}

void NumberedMesh::drop_unused_nodes(Mesh& mesh, std::vector<std::string>& notes) const {
  std::vector<int> renumbered(mesh.nodes.size(), -1);
  for (const auto& element : mesh.elements)
    for (int node : element) renumbered[node] = 0;
  std::vector<Vec3> kept;
  std::optional<std::int64_t> first_dropped;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (renumbered[node] < 0) {
      if (!first_dropped) first_dropped = node_numbers_[node];
    } else {
      renumbered[node] = static_cast<int>(kept.size());
      kept.push_back(mesh.nodes[node]);
    }
  }
  if (!first_dropped) return;
  notes.push_back(fmt::format("{}: {} nodes that belong to no hexahedron were left out, the first is node {}",
                              files.front(), mesh.nodes.size() - kept.size(), *first_dropped));
  mesh.nodes = std::move(kept);
  for (auto& element : mesh.elements)
    for (int& node : element) node = renumbered[node];
  for (auto& [name, set] : mesh.node_sets) {
    for (int& node : set) node = renumbered[node];
    set.erase(std::remove(set.begin(), set.end(), -1), set.end());
  }
}

}  // namespace railwave
