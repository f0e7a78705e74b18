#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// All parts of a scene put together on the host: one numbering of nodes and elements, sets under the names that a case
/// file uses (`part.set`; a part's own name means all of it). Point masses are nodes after those of the meshes, then
/// come the nodes inside beams.
struct Assembly {
  struct PartRange {
    std::string name;
    int first_node = 0, node_count = 0;
    int first_element = 0, element_count = 0;
    int material = 0;      ///< position in scene.materials
    Vec3 origin{0, 0, 0};  ///< m, where the mesh's origin lies, after close_gap: a point of a round part's axis
  };

  /// A beam's nodes, from end to end.
  struct BeamChain {
    int beam = 0;  ///< position in scene.beams
    std::vector<int> nodes;
  };

  std::vector<Vec3> nodes;  ///< as placed, undeformed, m
  std::vector<CornerNodes> elements;
  std::vector<PartRange> parts;
  std::vector<int> point_nodes;  ///< node of each of scene.points
  std::vector<BeamChain> beam_chains;
  std::vector<std::array<int, 2>> beam_nodes;  ///< by scene.beams: first, and how many, of the nodes inside its chains
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> element_sets;
  std::map<std::string, std::vector<Face>> surfaces;

  std::array<int, 4> face_nodes(const Face& face) const {
    std::array<int, 4> result{};
    for (int i = 0; i < 4; ++i) result[i] = elements[face.element][hexahedron_face_corners[face.side][i]];
    return result;
  }
};

/// Meshes every part of the scene and puts them together. Throws InputError for a set that no mesh has, and for
/// `close_gap` contacts that never meet.
Assembly assemble(const scene::Scene& scene);

/// The nodes of `part`, `part.node_set`, `part.surface` or a point mass. Throws InputError naming the entry and key of
/// the case file, its line, and the nearest valid name.
const std::vector<int>& find_node_set(const scene::Scene& scene, const Assembly& assembly, const scene::Place& entry,
                                      const std::string& key, const std::string& name);
const std::vector<Face>& find_surface(const scene::Scene& scene, const Assembly& assembly, const scene::Place& entry,
                                      const std::string& key, const std::string& name);

/// Faces of all of a contact's masters, in the order in which they are named. Throws InputError where one does not
/// exist, and where two have a face in common, which would press twice.
std::vector<Face> master_faces(const scene::Scene& scene, const Assembly& assembly, const scene::Contact& contact);

/// A vector turned by a part's angle of attack; by that of the part that a name `part` or `part.set` names, if it names
/// one.
Vec3 turned_with(const scene::Part& part, const Vec3& v);
Vec3 turned_with_part_of(const scene::Scene& scene, const std::string& name, const Vec3& v);

/// The part of a name `part` or `part.set`.
std::string part_of_name(const std::string& name);

/// "(x, y, z) m".
std::string place_text(const Vec3& x);

/// Nodes of a surface, ascending, each once.
std::vector<int> surface_nodes(const Assembly& assembly, const std::vector<Face>& surface);

/// Position in assembly.parts of the part that an element, or a node, belongs to; -1: none.
int part_of_element(const Assembly& assembly, int element);
int part_of_node(const Assembly& assembly, int node);

/// Message that a set does not exist, with the nearest of the known names.
std::string unknown_set(const scene::Scene& scene, const scene::Place& entry, const std::string& key,
                        const std::string& name, const std::vector<std::string>& known);

/// assemble(), with a line in `notes` about each thing of a mesh file that was left out or renamed.
Assembly assemble(const scene::Scene& scene, std::vector<std::string>& notes);

}  // namespace railwave
