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
  reserve(springs.size() * 4 * ((friction ? 3 : 1) + 1));
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

/// For so many springs more between two nodes each: memory that grows bit by bit takes a GPU's host longer than the
/// rest.
void SpringCollector::reserve(std::size_t springs) {
  node_.reserve(node_.size() + 2 * springs);
  share_.reserve(share_.size() + 2 * springs);
  first_.reserve(first_.size() + springs);
  stiffness_.reserve(stiffness_.size() + springs);
  damping_.reserve(damping_.size() + springs);
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

namespace {

/// Into the array that is there, or a longer one.
template <class T, class Row>
void bring_into(const char* label, const std::vector<Row>& rows, Array<T>& array) {
  if (array.extent(0) < rows.size()) array = unset_array<T>(label, rows.size() + rows.size() / 4);
  bring(rows, array);
}

/// Rows of a list by the nodes that they belong to.
struct RowsOfNodes {
  std::vector<int> nodes;  ///< that have rows, ascending
  std::vector<int> first;  ///< of each node's rows, and their end
  std::vector<int> rows;   ///< node after node, ascending

  explicit RowsOfNodes(const std::vector<int>& node_of_row) : first{0}, rows(node_of_row.size()) {
    if (rows.empty()) return;
    const auto [least, most] = std::minmax_element(node_of_row.begin(), node_of_row.end());
    const int lowest = *least;
    std::vector<int> next(*most - lowest + 1, 0);
    for (const int n : node_of_row) ++next[n - lowest];
    for (std::size_t n = 0; n < next.size(); ++n) {
      if (next[n] == 0) continue;
      nodes.push_back(lowest + static_cast<int>(n));
      first.push_back(first.back() + next[n]);
      next[n] = first[first.size() - 2];
    }
    for (std::size_t r = 0; r < rows.size(); ++r) rows[next[node_of_row[r] - lowest]++] = static_cast<int>(r);
  }
};

}  // namespace

void SpringCollector::bring_to(TangentSprings& springs) const {
  springs.count = static_cast<int>(stiffness_.size());
  std::vector<int> spring_of_row(node_.size());
  for (int s = 0; s < springs.count; ++s)
    std::fill(spring_of_row.begin() + first_[s], spring_of_row.begin() + first_[s + 1], s);
  const RowsOfNodes of_nodes(node_);
  springs.node_count = static_cast<int>(of_nodes.nodes.size());
  std::vector<int> spring;
  std::vector<Vec3> share;
  spring.reserve(node_.size());
  share.reserve(node_.size());
  for (const int row : of_nodes.rows) {
    spring.push_back(spring_of_row[row]);
    share.push_back(share_[row]);
  }
  bring_into("tangent spring first", first_, springs.first);
  bring_into("tangent spring node", node_, springs.node);
  bring_into("tangent spring share", share_, springs.share);
  bring_into("tangent spring stiffness", stiffness_, springs.stiffness);
  bring_into("tangent spring damping", damping_, springs.damping);
  if (springs.force.extent(0) < stiffness_.size())
    springs.force = unset_array<double*>("tangent spring force", springs.stiffness.extent(0));
  bring_into("nodes with tangent springs", of_nodes.nodes, springs.with_springs);
  bring_into("tangent springs of node, first", of_nodes.first, springs.first_of_node);
  bring_into("tangent springs of node", spring, springs.spring_of_node);
  bring_into("tangent spring share of node", share, springs.share_of_node);
}

}  // namespace railwave
