#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace railwave {

using Vec3 = std::array<double, 3>;

/// One face of a hexahedron. `side` is 0..5, corners in `hexahedron_face_corners`.
struct Face {
  int element;
  int side;
};

/// Corner numbers of the six faces of a hexahedron, each turned so that its normal (right-hand rule) points out of the
/// element. Corner order of the element itself: corners 0-3 counter-clockwise seen from inside (bottom), 4-7 above them
/// (Abaqus C3D8, Gmsh type 5, VTK_HEXAHEDRON).
inline constexpr int hexahedron_face_corners[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                      {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// The nodes at a hexahedron's corners, in the order above.
using CornerNodes = std::array<int, 8>;

/// A mesh of 8-node hexahedra on the host, in metres. Node and element numbers are positions in the vectors, from 0.
/// Every name of a set is usable in a case file as `part.name`.
struct Mesh {
  std::vector<Vec3> nodes;
  std::vector<CornerNodes> elements;
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> element_sets;
  std::map<std::string, std::vector<Face>> surfaces;

  /// The four node numbers of a face, turned outwards.
  std::array<int, 4> face_nodes(const Face& face) const {
    std::array<int, 4> result{};
    for (int i = 0; i < 4; ++i) result[i] = elements[face.element][hexahedron_face_corners[face.side][i]];
    return result;
  }
};

/// Mirrors a mesh in the plane y = 0. Elements stay right-handed and faces look outwards: an element's first four
/// corners become its last. Sets keep their names.
inline void mirror(Mesh& mesh) {
  for (Vec3& x : mesh.nodes) x[1] = -x[1];
  for (auto& corners : mesh.elements)
    for (int i = 0; i < 4; ++i) std::swap(corners[i], corners[i + 4]);
  for (auto& [name, faces] : mesh.surfaces)
    for (Face& face : faces)
      if (face.side < 2) face.side = 1 - face.side;
}

}  // namespace railwave
