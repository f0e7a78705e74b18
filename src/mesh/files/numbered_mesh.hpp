#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// Where in a mesh file something stands: a line, or a byte of a binary file.
struct FilePlace {
  int file = 0;               ///< position in NumberedMesh::files
  std::int64_t position = 0;  ///< line from 1, or byte from 0
};

/// A mesh as a file gives it: nodes and hexahedra under the file's own numbers, each with its place for messages.
/// A reader fills it, calls connect(), makes the sets, and hands both to complete().
class NumberedMesh {
 public:
  std::vector<std::string> files;  ///< paths for messages
  bool binary = false;             ///< places are bytes

  /// "path:line:" or "path: byte N:".
  std::string where(const FilePlace& place) const;

  /// Throw InputError when the number is taken already.
  void add_node(std::int64_t number, const Vec3& position, const FilePlace& place);
  void add_element(std::int64_t number, const std::array<std::int64_t, 8>& nodes, const FilePlace& place);

  std::size_t node_count() const { return node_numbers_.size(); }
  std::size_t element_count() const { return element_numbers_.size(); }
  const std::vector<std::int64_t>& node_numbers() const { return node_numbers_; }
  const std::vector<std::int64_t>& element_numbers() const { return element_numbers_; }

  const FilePlace& place_of_element(int element) const { return element_places_[element]; }
  const std::vector<Vec3>& nodes() const { return nodes_; }

  /// Puts each node where `moved(position of the node, its place)` says.
  template <class Moved>
  void move_nodes(const Moved& moved) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i] = moved(i, nodes_[i]);
  }

  /// Position of a node or element number, nothing if the file doesn't define it.
  std::optional<int> find_node(std::int64_t number) const;
  std::optional<int> find_element(std::int64_t number) const;

  /// All nodes and elements by position, without sets. Throws InputError when an element names a node that the file
  /// doesn't define or names one twice, or there are no elements.
  Mesh connect() const;

  /// Makes a connected mesh with sets ready for use:
  /// - nodes of no hexahedron are dropped, also from the sets; sets left empty are dropped; notes say so;
  /// - surface `exterior` holds all outside faces, unless the file names one so;
  /// - each surface and element set gives its nodes as a node set of the same name, unless there is one; the node set
  ///   of the file goes before the surface's, and that before the element set's;
  /// - sets are ascending without repeats.
  /// Throws InputError for elements that are mirrored, turned inside out, flat, or overlap.
  void complete(Mesh& mesh, std::vector<std::string>& notes) const;

 private:
  void check_shapes(const Mesh& mesh) const;
  void check_overlap(const std::vector<Face>& faces) const;
  void drop_unused_nodes(Mesh& mesh, std::vector<std::string>& notes) const;

  std::vector<std::int64_t> node_numbers_;
  std::vector<Vec3> nodes_;
  std::vector<FilePlace> node_places_;
  std::unordered_map<std::int64_t, int> node_positions_;

  std::vector<std::int64_t> element_numbers_;
  std::vector<std::array<std::int64_t, 8>> elements_;
  std::vector<FilePlace> element_places_;
  std::unordered_map<std::int64_t, int> element_positions_;
};

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
