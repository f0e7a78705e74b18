#include "model/time_step/tangent_springs.hpp"

#include <algorithm>

#include "kernels/beams/beam_tangent.hpp"
#include "model/beams/beams.hpp"
#include "model/host_copy.hpp"

namespace railwave {

void SpringCollector::add(int node, double weight, const Vec3& direction) {
  node_.push_back(node);
  share_.push_back({weight * direction[0], weight * direction[1], weight * direction[2]});
}

void SpringCollector::close(double stiffness, double damping) {
  first_.push_back(static_cast<int>(node_.size()));
  stiffness_.push_back(stiffness);
  damping_.push_back(damping);
}

void SpringCollector::add_end(const WeightedNodes& end, double sign, const Vec3& direction) {
  for (std::size_t k = 0; k < end.nodes.size(); ++k) add(end.nodes[k], sign * end.weight[k], direction);
}

void SpringCollector::add_connectors(const scene::Scene& scene, const std::vector<ConnectorCell>& cells) {
  for (const ConnectorCell& cell : cells) {
    const scene::Connector& connector = scene.connectors[cell.connector];
    for (int a = 0; a < 3; ++a) {
      if (connector.stiffness[a] == 0 && connector.damping[a] == 0) continue;
      add_end(cell.from, -1, connector.axes[a]);
      add_end(cell.to, 1, connector.axes[a]);
      close(cell.share * connector.stiffness[a], cell.share * connector.damping[a]);
    }
  }
}

void SpringCollector::add_beams(const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes, bool held) {
  if (!beams) return;
  const BeamArrays& arrays = beams->arrays;
  const BeamTangent tangent{
      arrays, nodes.position, held,
      unset_array<double * [BeamTangent::springs][BeamTangent::ends][3]>("beam tangent", arrays.count),
      unset_array<double * [BeamTangent::springs]>("beam tangent stiffness", arrays.count)};
  Kokkos::parallel_for("beam_tangent", Range(0, arrays.count), tangent);
  const auto share = to_host(tangent.share);
  const auto stiffness = to_host(tangent.stiffness);
  const auto end = to_host(arrays.end);
  const auto node = to_host(arrays.node);
  for (int e = 0; e < arrays.count; ++e)
    for (int s = 0; s < BeamTangent::springs; ++s) {
      if (!(stiffness(e, s) > 0)) continue;
      for (int k = 0; k < BeamTangent::ends; ++k) {
        const int b = end(e, k % 2);
        add(k < 2 ? node(b) : nodes.count + b, 1, {share(e, s, k, 0), share(e, s, k, 1), share(e, s, k, 2)});
      }
      close(stiffness(e, s), 0);
    }
}

void SpringCollector::add_contact(const std::vector<ContactSpring>& springs, bool friction) {
  constexpr Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const ContactSpring& spring : springs)
    for (int corner = 0; corner < 4; ++corner) {
      if (spring.share[corner] == 0) continue;
      // A normal and two tangential springs of one stiffness are three springs along any axes.
      for (int a = 0; a < (friction ? 3 : 1); ++a) {
        const Vec3& direction = friction ? axes[a] : spring.normal;
        add(spring.slave_node, 1, direction);
        add(spring.master_nodes[corner], -1, direction);
        close(spring.share[corner] * spring.stiffness, 0);
      }
      if (spring.damping == 0) continue;
      add(spring.slave_node, 1, spring.normal);
      add(spring.master_nodes[corner], -1, spring.normal);
      close(0, spring.share[corner] * spring.damping);
    }
}

void SpringCollector::add_ground(int node, double stiffness, double damping) {
  for (int i = 0; i < 3; ++i) {
    Vec3 direction{};
    direction[i] = 1;
    add(node, 1, direction);
    close(stiffness, damping);
  }
}

void SpringCollector::add_spring(const std::vector<int>& nodes, const std::vector<double>& weights,
                                 const Vec3& direction, double stiffness) {
  for (std::size_t k = 0; k < nodes.size(); ++k) add(nodes[k], weights[k], direction);
  close(stiffness, 0);
}

TangentSprings SpringCollector::on_device() const {
  TangentSprings springs;
  springs.count = static_cast<int>(stiffness_.size());
  std::vector<int> nodes = node_;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const auto place_of = [&](int n) { return std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin(); };
  std::vector<int> first(nodes.size() + 1, 0);
  for (int n : node_) ++first[place_of(n) + 1];
  for (std::size_t k = 0; k < nodes.size(); ++k) first[k + 1] += first[k];
  std::vector<int> filled(first.begin(), first.end() - 1), spring(node_.size());
  std::vector<Vec3> share(node_.size());
  for (int s = 0; s < springs.count; ++s)
    for (int k = first_[s]; k < first_[s + 1]; ++k) {
      const int at = filled[place_of(node_[k])]++;
      spring[at] = s;
      share[at] = share_[k];
    }
  springs.first = to_device("tangent spring first", first_);
  springs.node = to_device("tangent spring node", node_);
  springs.share = to_device("tangent spring share", share_);
  springs.stiffness = to_device("tangent spring stiffness", stiffness_);
  springs.damping = to_device("tangent spring damping", damping_);
  springs.force = Array<double*>("tangent spring force", springs.count);
  springs.node_count = static_cast<int>(nodes.size());
  springs.with_springs = to_device("nodes with tangent springs", nodes);
  springs.first_of_node = to_device("tangent springs of node, first", first);
  springs.spring_of_node = to_device("tangent springs of node", spring);
  springs.share_of_node = to_device("tangent spring share of node", share);
  return springs;
}

}  // namespace railwave
