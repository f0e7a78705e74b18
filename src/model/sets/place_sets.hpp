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

}  // namespace railwave
