#include "model/tangent_springs.hpp"

#include <algorithm>

#include "model/host_copy.hpp"

namespace railwave {

void SpringCollector::close(const Vec3& direction, double stiffness, double damping) {
  first_.push_back(static_cast<int>(node_.size()));
  direction_.push_back(direction);
  stiffness_.push_back(stiffness);
  damping_.push_back(damping);
}

void SpringCollector::add_end(const WeightedNodes& end, double sign) {
  node_.insert(node_.end(), end.nodes.begin(), end.nodes.end());
  for (double weight : end.weight) weight_.push_back(sign * weight);
}

void SpringCollector::add_connectors() {
  for (const ConnectorCell& cell : model_.connectors.cells) {
    const scene::Connector& connector = model_.scene.connectors[cell.connector];
    for (int a = 0; a < 3; ++a) {
      if (connector.stiffness[a] == 0 && connector.damping[a] == 0) continue;
      add_end(cell.from, -1);
      add_end(cell.to, 1);
      close(connector.axes[a], cell.share * connector.stiffness[a], cell.share * connector.damping[a]);
    }
  }
}

void SpringCollector::add_contact(const std::vector<ContactSpring>& springs, bool friction) {
  constexpr Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const ContactSpring& spring : springs)
    for (int corner = 0; corner < 4; ++corner) {
      if (spring.share[corner] == 0) continue;
      // A normal and two tangential springs of one stiffness are three springs along any axes.
      for (int a = 0; a < (friction ? 3 : 1); ++a) {
        node_.insert(node_.end(), {spring.slave_node, spring.master_nodes[corner]});
        weight_.insert(weight_.end(), {1.0, -1.0});
        close(friction ? axes[a] : spring.normal, spring.share[corner] * spring.stiffness, 0);
      }
      if (spring.damping == 0) continue;
      node_.insert(node_.end(), {spring.slave_node, spring.master_nodes[corner]});
      weight_.insert(weight_.end(), {1.0, -1.0});
      close(spring.normal, 0, spring.share[corner] * spring.damping);
    }
}

void SpringCollector::add_spring(const std::vector<int>& nodes, const std::vector<double>& weights, const Vec3& direction,
                                 double stiffness) {
  node_.insert(node_.end(), nodes.begin(), nodes.end());
  weight_.insert(weight_.end(), weights.begin(), weights.end());
  close(direction, stiffness, 0);
}

TangentSprings SpringCollector::on_device() const {
  TangentSprings springs;
  springs.count = static_cast<int>(direction_.size());
  std::vector<int> nodes = node_;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto place_of = [&](int n) { return std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin(); };
  std::vector<int> first(nodes.size() + 1, 0);
  for (int n : node_) ++first[place_of(n) + 1];
  for (std::size_t k = 0; k < nodes.size(); ++k) first[k + 1] += first[k];
  std::vector<int> filled(first.begin(), first.end() - 1), spring(node_.size());
  std::vector<double> weight(node_.size());
  for (int s = 0; s < springs.count; ++s)
    for (int k = first_[s]; k < first_[s + 1]; ++k) {
      const int at = filled[place_of(node_[k])]++;
      spring[at] = s;
      weight[at] = weight_[k];
    }
  springs.first = to_device("tangent spring first", first_);
  springs.node = to_device("tangent spring node", node_);
  springs.weight = to_device("tangent spring weight", weight_);
  springs.direction = to_device("tangent spring direction", direction_);
  springs.stiffness = to_device("tangent spring stiffness", stiffness_);
  springs.damping = to_device("tangent spring damping", damping_);
  springs.force = Array<double*>("tangent spring force", springs.count);
  springs.node_count = static_cast<int>(nodes.size());
  springs.with_springs = to_device("nodes with tangent springs", nodes);
  springs.first_of_node = to_device("tangent springs of node, first", first);
  springs.spring_of_node = to_device("tangent springs of node", spring);
  springs.weight_of_node = to_device("tangent spring weight of node", weight);
  return springs;
}

}  // namespace railwave
