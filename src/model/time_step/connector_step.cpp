#include "model/time_step/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace railwave {
namespace {

/// What one cell pulls at a node: its weight there.
struct Pull {
  int cell;
  double weight;
};

/// A point mass or a node of a body, by the cells that pull at it.
using Pulls = std::map<int, std::vector<Pull>>;

Pulls pulls_of(const std::vector<ConnectorCell>& cells) {
  Pulls pulls;
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const auto& [end, sign] : {std::pair{&cells[c].from, -1.0}, std::pair{&cells[c].to, 1.0}})
      for (std::size_t k = 0; k < end->nodes.size(); ++k)
        pulls[end->nodes[k]].push_back({static_cast<int>(c), sign * end->weight[k]});
  return pulls;
}

/// Largest row sum of the cells' matrix sqrt(s_c s_d) sum over the nodes of w_c w_d / m, which has the highest
/// eigenvalues that M^-1 sum s_c w_c w_c^T has: the cells of a bed pull at nodes of their own and share few.
double largest_eigenvalue(const std::vector<double>& strength, const Pulls& pulls, const std::vector<double>& mass,
                          std::size_t cells) {
  std::map<std::pair<int, int>, double> product;
  for (const auto& [node, at_node] : pulls)
    for (const Pull& a : at_node)
      for (const Pull& b : at_node) product[{a.cell, b.cell}] += a.weight * b.weight / mass[node];
  std::vector<double> row(cells, 0.0);
  for (const auto& [pair, value] : product)
    row[pair.first] += std::sqrt(strength[pair.first] * strength[pair.second]) * std::fabs(value);
  return row.empty() ? 0 : *std::max_element(row.begin(), row.end());
}

}  // namespace

/// Springs k and dashpots c on the reduced masses m of their ends make omega^2 = k/m and omega zeta = c/2m, and a
/// stable step 2/omega (sqrt(1 + zeta^2) - zeta). An end's nodes move together only in the mean, but the lightest
/// pattern that stretches the connector is theirs alone, so the elements beyond are not counted.
double connector_frequency(const scene::Scene& scene, const std::vector<ConnectorCell>& cells,
                           const std::vector<double>& mass) {
  const Pulls pulls = pulls_of(cells);
  std::vector<double> stiffness, damping;
  for (const ConnectorCell& cell : cells) {
    const scene::Connector& connector = scene.connectors[cell.connector];
    stiffness.push_back(cell.share * *std::max_element(connector.stiffness.begin(), connector.stiffness.end()));
    damping.push_back(cell.share * *std::max_element(connector.damping.begin(), connector.damping.end()));
  }
  const double squared = largest_eigenvalue(stiffness, pulls, mass, cells.size());
  const double half_rate = 0.5 * largest_eigenvalue(damping, pulls, mass, cells.size());
  return std::sqrt(squared + half_rate * half_rate) + half_rate;
}

}  // namespace railwave
