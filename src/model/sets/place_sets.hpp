#pragma once

#include "model/assembly.hpp"

namespace railwave {

/// Adds the scene's [node_sets.NAME] to the assembly, as `part.NAME`: the nodes in a box, or those near a position and
/// the nearest one in any case; of a surface also those of its faces that have all their nodes in the set, as a surface
/// of that name. Throws InputError for a box without nodes, telling the nearest one, and for a name that the part's
/// mesh has already.
void add_node_sets(const scene::Scene& scene, Assembly& assembly);

/// Where a set that was asked for by position came to lie.
struct PlacedSet {
  const scene::NodeSet* set = nullptr;
  int count = 0;        ///< nodes
  int nearest = 0;      ///< node
  double distance = 0;  ///< m, from there to the position
  std::string warning;  ///< empty unless it is farther away than radius and element size, or a hammer's patch is too
                        ///< small for the mesh
};

/// One for each of the scene's node sets that has a position, in their order; hammers and probes are such sets.
std::vector<PlacedSet> placed_sets(const scene::Scene& scene, const Assembly& assembly);

/// Adds the scene's [element_sets.NAME], and those of probes that record stress or strain, to the assembly as
/// `part.NAME`: elements whose centre is in a box; or the element in which a position lies (that with the nearest
/// centre where it lies in none), and those whose centre is within the radius of it. Throws InputError for a box
/// without elements, naming the nearest one, and for a name that the part has already.
void add_element_sets(const scene::Scene& scene, Assembly& assembly);

/// Where an element set that was asked for by position came to lie.
struct PlacedElements {
  const scene::ElementSet* set = nullptr;
  int count = 0;        ///< elements
  int element = 0;      ///< in which the position lies, or the nearest
  Vec3 centre{};        ///< m, of that element: where its stress and strain hold
  double distance = 0;  ///< m, from there to the position
  std::string warning;  ///< empty where the position lies in the element
};

/// One for each of the scene's element sets that has a position, in their order; probes of stress and strain are such
/// sets.
std::vector<PlacedElements> placed_element_sets(const scene::Scene& scene, const Assembly& assembly);

/// Mean of an element's corners, m.
Vec3 element_centre(const Assembly& assembly, int element);

/// Natural coordinates (-1 to 1 inside) of a place in a trilinear hexahedron: Newton's method on x(xi) = sum N_k(xi)
/// x_k; infinite where the map can't be inverted there.
Vec3 natural_coordinates(const std::array<Vec3, 8>& corners, const Vec3& place);

/// The largest of their sizes: at most 1 inside.
double largest_natural_coordinate(const std::array<Vec3, 8>& corners, const Vec3& place);

}  // namespace railwave
