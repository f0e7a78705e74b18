#include "model/loads/connector_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "case/error.hpp"
#include "model/contact/facing_area.hpp"

namespace railwave {
namespace {

/// Places along each side of a cell at which the surfaces' motions are taken for their means.
constexpr int samples = 4;

/// Nodes of a set by their mass.
WeightedNodes by_mass(const scene::Scene& scene, const Assembly& assembly, const scene::Connector& connector,
                      const char* key, const std::string& name, const std::vector<double>& mass) {
  WeightedNodes end;
  if (name == "ground") return end;
  end.set = name;
  end.nodes = find_node_set(scene, assembly, connector, key, name);
  end.weight = shares_by_mass(end.nodes, mass);
  return end;
}

/// Nodes each once, ascending, their weights made to sum to 1.
WeightedNodes gathered(std::vector<std::pair<int, double>> weights) {
  std::stable_sort(weights.begin(), weights.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  WeightedNodes end;
  double sum = 0;
  for (const auto& [node, weight] : weights) {
    if (end.nodes.empty() || end.nodes.back() != node) {
      end.nodes.push_back(node);
      end.weight.push_back(0);
    }
    end.weight.back() += weight;
    sum += weight;
  }
  for (double& weight : end.weight) weight /= sum;
  return end;
}

class Spreader {
 public:
  Spreader(const scene::Scene& scene, const Assembly& assembly, const scene::Connector& connector)
      : scene_(scene), assembly_(assembly), connector_(connector) {
    from_ = surface("from", connector.from);
    to_ = surface("to", connector.to);
    find_area();
  }

  void add_cells(int number, std::vector<ConnectorCell>& cells) const {
    const auto [along, across] = connector_.spread;
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j) {
        ConnectorCell cell;
        cell.connector = number;
        cell.share = 1.0 / (along * across);
        fill(cell, {i, j});
        cells.push_back(std::move(cell));
      }
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: [connectors.{}] {}", scene_.path, connector_.line, connector_.name, what));
  }

  std::optional<ProjectedSurface> surface(const char* key, const std::string& name) const {
    if (name == "ground") return std::nullopt;
    find_node_set(scene_, assembly_, connector_, key, name);
    if (assembly_.surfaces.find(name) == assembly_.surfaces.end())
      refuse(fmt::format("{}: '{}' is a set of nodes without faces; a connector with spread needs a surface there", key,
                         name));
    const scene::Box* box = connector_.area ? &*connector_.area : nullptr;
    ProjectedSurface seen(assembly_, assembly_.surfaces.at(name), connector_.axes, box);
    if (seen.empty())
      refuse(fmt::format("area: has no face of '{}' in it along the third of the axes; make it higher", name));
    return seen;
  }

  void find_area() {
    low_ = {-1e300, -1e300};
    high_ = {1e300, 1e300};
    for (const auto* side : {&from_, &to_})
      for (int i = 0; *side && i < 2; ++i) {
        low_[i] = std::max(low_[i], (*side)->low()[i]);
        high_[i] = std::min(high_[i], (*side)->high()[i]);
      }
    for (int i = 0; i < 2 && connector_.area; ++i) {
      double least = 1e300, most = -1e300;
      for (int corner = 0; corner < 8; ++corner) {
        double place = 0;
        for (int k = 0; k < 3; ++k) place += connector_.axes[i][k] * (*connector_.area)[(corner >> k) & 1][k];
        least = std::min(least, place);
        most = std::max(most, place);
      }
      low_[i] = std::max(low_[i], least);
      high_[i] = std::min(high_[i], most);
    }
    if (!(high_[0] > low_[0]) || !(high_[1] > low_[1]))
      refuse(fmt::format("spread: '{}' and '{}' do not face each other along the third of the axes{}", connector_.from,
                         connector_.to, connector_.area ? ", or not within the area" : ""));
  }

  /// Means over the cell of both surfaces' motion, at the same places of both.
  void fill(ConnectorCell& cell, std::array<int, 2> at) const {
    std::vector<std::pair<int, double>> from, to;
    for (int k = 0; k < samples * samples; ++k) {
      const std::array<int, 2> sample{k / samples, k % samples};
      PlanePoint point{};
      for (int i = 0; i < 2; ++i)
        point[i] = low_[i] + (high_[i] - low_[i]) * (at[i] + (sample[i] + 0.5) / samples) / connector_.spread[i];
      std::vector<std::pair<int, double>> here, there;
      if ((from_ && !from_->add_weights(point, 1, here)) || (to_ && !to_->add_weights(point, 1, there))) continue;
      from.insert(from.end(), here.begin(), here.end());
      to.insert(to.end(), there.begin(), there.end());
    }
    if (from.empty() && to.empty())
      refuse(
          fmt::format("spread: cell {}, {} of {} x {} has no faces of both ends in it; use fewer cells, or an area "
                      "that the surfaces fill",
                      at[0] + 1, at[1] + 1, connector_.spread[0], connector_.spread[1]));
    if (from_) cell.from = gathered(std::move(from));
    if (to_) cell.to = gathered(std::move(to));
  }

  const scene::Scene& scene_;
  const Assembly& assembly_;
  const scene::Connector& connector_;
  std::optional<ProjectedSurface> from_, to_;
  PlanePoint low_{}, high_{};
};

}  // namespace

std::vector<ConnectorCell> connector_cells(const scene::Scene& scene, const Assembly& assembly,
                                           const std::vector<double>& mass) {
  std::vector<ConnectorCell> cells;
  for (std::size_t c = 0; c < scene.connectors.size(); ++c) {
    const scene::Connector& connector = scene.connectors[c];
    if (connector.spread[0] > 0) {
      Spreader(scene, assembly, connector).add_cells(static_cast<int>(c), cells);
      continue;
    }
    ConnectorCell cell;
    cell.connector = static_cast<int>(c);
    cell.from = by_mass(scene, assembly, connector, "from", connector.from, mass);
    cell.to = by_mass(scene, assembly, connector, "to", connector.to, mass);
    cells.push_back(std::move(cell));
  }
  return cells;
}

std::vector<double> shares_by_mass(const std::vector<int>& nodes, const std::vector<double>& mass) {
  double total = 0;
  for (int n : nodes) total += mass[n];
  std::vector<double> share;
  for (int n : nodes) share.push_back(mass[n] / total);
  return share;
}

Vec3 mean_place(const WeightedNodes& end, const std::vector<Vec3>& nodes) {
  Vec3 mean{0, 0, 0};
  for (std::size_t k = 0; k < end.nodes.size(); ++k)
    for (int i = 0; i < 3; ++i) mean[i] += end.weight[k] * nodes[end.nodes[k]][i];
  return mean;
}

}  // namespace railwave
