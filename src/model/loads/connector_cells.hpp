#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace railwave::scene {
struct Scene;
}

namespace railwave {

struct Assembly;

/// Nodes whose weighted mean motion an end of a connector follows, and among which it shares its force. No nodes: the
/// ground.
struct WeightedNodes {
  std::vector<int> nodes;      ///< each once
  std::vector<double> weight;  ///< of each, sum 1
  std::string set;             ///< the node set that these are by mass; empty: weights of their own
  bool ground() const { return nodes.empty(); }
};

/// One spring-dashpot: a connector, or one of the cells over which it is spread.
struct ConnectorCell {
  int connector = 0;  ///< its number in the scene
  double share = 1;   ///< of the connector's stiffness, damping and preload
  WeightedNodes from, to;
};

/// The cells of the scene's connectors, in order. A connector that is not spread is one cell between the means, by
/// mass, of its ends' node sets. A spread one has cells of equal size in the plane of its first two axes, which cover
/// the overlap of both ends (and of `area`); each follows the means of both surfaces' motion over the cell, so that
/// with n cells along a length L its stiffness against rotation is that of a bed, k L^2 / 12, less the part 1/n^2
/// within the cells.
/// @param mass kg, by node
/// Throws InputError for unknown sets, ends without faces, ends that do not face each other and cells without faces.
std::vector<ConnectorCell> connector_cells(const scene::Scene& scene, const Assembly& assembly,
                                           const std::vector<double>& mass);

/// Mass of each of the nodes over that of all.
/// @param mass kg, by node of the model
std::vector<double> shares_by_mass(const std::vector<int>& nodes, const std::vector<double>& mass);

/// Mean place of the nodes, m.
Vec3 mean_place(const WeightedNodes& end, const std::vector<Vec3>& nodes);

}  // namespace railwave
