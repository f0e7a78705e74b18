#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace railwave {

/// Who waits for whom among nodes 0, 1, ...: the second for the first.
using GraphEdges = std::vector<std::pair<int, int>>;

/// The same order among the nodes that do something, with as few edges as it takes: nodes that are there only so that
/// one waits for several have none, and nobody waits for what another of those that he waits for has waited for.
/// @param edges of a graph without circles
/// @param empty of each node, whether it does nothing
/// @return ascending
GraphEdges fewest_edges(const GraphEdges& edges, const std::vector<bool>& empty);

}  // namespace railwave
