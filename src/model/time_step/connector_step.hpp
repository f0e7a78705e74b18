#pragma once

#include <vector>

#include "case/scene.hpp"
#include "model/loads/connector_cells.hpp"

namespace railwave {

/// 2/step of the connectors alone, 1/s: the stable step of springs and dashpots on their ends' masses.
/// @param mass kg, by node
double connector_frequency(const scene::Scene& scene, const std::vector<ConnectorCell>& cells,
                           const std::vector<double>& mass);

}  // namespace railwave
