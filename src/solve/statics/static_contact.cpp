#include "solve/statics/static_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/contact/laws/augmented_penalty.hpp"
#include "mesh/vectors.hpp"
#include "model/host_copy.hpp"
#include "solve/tasks/contributions.hpp"

namespace railwave {
namespace {

/// Stiffness of augmented Lagrange over that of penalty springs: more makes the gaps vanish sooner, and the equations
/// stiffer.
constexpr double stiffening = 4;
/// Tangential stiffness of a node that slips, over that of one that sticks: none would do, but for bodies held by
/// friction alone.
constexpr double slipping_share = 0.1;

/// N, of each slave node.
std::vector<double> pressing_forces(const ContactPair& pair) {
  const auto normal = to_host(pair.arrays.normal_force);
  const auto status = to_host(pair.arrays.status);
  std::vector<double> pressing(pair.slave_nodes.size(), 0);
  for (std::size_t s = 0; s < pressing.size(); ++s)
    if (status(s) != status_apart) pressing[s] = length({normal(s, 0), normal(s, 1), normal(s, 2)});
  return pressing;
}

/// Keeps how much each of the master's nodes moves a contact point along the normal, see SmoothNormals::reaction.
struct KeepWeights {
  ContactArrays contact;
  Array<int**> node;
  Array<double**> weight;
  Array<int*> count;
  Segment segment;
  Vector3 normal;
  int slave;

  KOKKOS_INLINE_FUNCTION void corners(const Vector3 (&share)[4]) const {
    for (int k = 0; k < 4; ++k) put(segment.node[k], dot(share[k], normal));
  }
  KOKKOS_INLINE_FUNCTION void pair(int plus, int minus, const Vector3& share) const {
    put(plus, dot(share, normal));
    put(minus, -dot(share, normal));
  }
  KOKKOS_INLINE_FUNCTION void put(int n, double w) const {
    const int at = count(slave)++;
    node(slave, at) = contact.node_of(n);
    weight(slave, at) = w;
  }
};

struct CurvedWeights {
  ContactSearch search;
  Array<int**> node;
  Array<double**> weight;
  Array<int*> count;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    const ContactArrays& contact = search.contact;
    const Vector3 force = row(contact.normal_force, s);
    const double pressing = norm(force);
    if (contact.status(s) == status_apart || contact.tracked(s) < 0 || !(pressing > 0)) return;
    const int segment = contact.tracked(s);
    const Vector3 normal = (1 / pressing) * force;
    SmoothNormals::reaction(search, segment, {contact.place(s, 0), contact.place(s, 1)}, normal,
                            KeepWeights{contact, node, weight, count, contact.surface(segment), normal, s});
  }
};

/// Of each slave node that presses on a curved segment by a spring: what moves the gap, the master's nodes with their
/// weights. Empty for other pairs.
std::vector<std::map<int, double>> curved_weights(const NodeArrays& arrays, const ContactPair& pair) {
  if (pair.contact->normals != scene::ContactNormals::smooth || !pair.has_springs()) return {};
  const auto first = to_host(pair.arrays.first_segment);
  int most = 0;
  for (const auto& segment : pair.master_segments) {
    int around = 0;
    for (int m : segment) around += first(m + 1) - first(m);
    most = std::max(most, 4 + 4 * around);
  }
  const int slaves = pair.arrays.slave_count;
  const auto node = unset_array<int**>("nodes of curved segments", slaves, most);
  const auto weight = unset_array<double**>("weights of curved segments", slaves, most);
  const Array<int*> count("terms of curved segments", slaves);
  Kokkos::parallel_for("curved_weights", Range(0, slaves),
                       CurvedWeights{ContactSearch{{pair.arrays, arrays.position}}, node, weight, count});
  const auto nodes = to_host(node);
  const auto weights = to_host(weight);
  const auto counts = to_host(count);
  std::vector<std::map<int, double>> result(slaves);
  for (int s = 0; s < slaves; ++s)
    for (int k = 0; k < counts(s); ++k) result[s][nodes(s, k)] += weights(s, k);
  return result;
}

/// As the run's multipliers press: along smooth normals, on the segment's own nodes only.
struct SmoothNormalsOfMultipliers : SmoothNormals {
  static constexpr bool curved = false;
};

template <class Normals>
void press_pair(const NodalState& nodal, const ContactPair& pair, bool friction, const Array<double*>& multiplier) {
  const AugmentedPenalty law{{pair.arrays.friction}, stiffening};
  const SpreadRange range(0, pair.window.count);
  const Instant instant;
  if (friction)
    Kokkos::parallel_for("augmented_contact", range,
                         contact_force<true, Normals>(nodal, pair, instant, law, multiplier));
  else
    Kokkos::parallel_for("augmented_contact", range,
                         contact_force<false, Normals>(nodal, pair, instant, law, multiplier));
}

}  // namespace

StaticContact::StaticContact(const AssembledScene& assembled, const NodalState& nodal,
                             std::vector<ContactPair>& contacts)
    : scene_(assembled.scene), nodal_(nodal), contacts_(contacts) {
  for (const ContactPair& pair : contacts) {
    Array<double*>& multiplier = multiplier_.emplace_back();
    if (!pair.has_springs()) {
      augmented_ = true;
      multiplier = to_device("multipliers", pressing_forces(pair));
    }
    for (const auto& segment : pair.master_segments)
      for (int k : {0, 1}) {
        const Vec3 &a = assembled.assembly.nodes[pair.master_nodes[segment[k]]],
                   &b = assembled.assembly.nodes[pair.master_nodes[segment[k + 2]]];
        smallest_segment_ = std::min(smallest_segment_, length(difference(a, b)));
      }
  }
}

void StaticContact::search_anew() {
  for (ContactPair& pair : contacts_) {
    pair.next_check = pair.next_near_check = -1;
    pair.slaves_at_layout = {};
  }
}

void StaticContact::press() {
  for (std::size_t p = 0; p < multiplier_.size(); ++p) {
    ContactPair& pair = contacts_[p];
    if (pair.has_springs()) continue;
    keep_window(scene_, nodal_, pair, Instant{0, 1}, StepKind::settling);
    const bool friction = has_friction(scene_, pair, StepKind::settling);
    if (pair.contact->normals == scene::ContactNormals::smooth)
      press_pair<SmoothNormalsOfMultipliers>(nodal_, pair, friction, multiplier_[p]);
    else
      press_pair<FacetNormals>(nodal_, pair, friction, multiplier_[p]);
  }
}

void StaticContact::add_springs(SpringCollector& springs) const {
  constexpr Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const ContactPair& pair : contacts_) {
    const auto status = to_host(pair.arrays.status), tracked = to_host(pair.arrays.tracked);
    const auto place = to_host(pair.arrays.place);
    const auto normal_force = to_host(pair.arrays.normal_force);
    const auto gap = to_host(pair.arrays.gap);
    const auto curved = curved_weights(nodal_.nodes, pair);
    for (std::size_t s = 0; s < pair.slave_nodes.size(); ++s) {
      if (status(s) == status_apart || tracked(s) < 0) continue;
      const auto& segment = pair.master_segments[tracked(s)];
      std::vector<int> nodes{pair.slave_nodes[s]};
      std::vector<double> weights{1};
      for (int k = 0; k < 4; ++k) {
        nodes.push_back(pair.master_nodes[segment[k]]);
        weights.push_back(-segment_shape(k, place(s, 0), place(s, 1)));
      }
      Vec3 normal{normal_force(s, 0), normal_force(s, 1), normal_force(s, 2)};
      const double pressing = length(normal);
      if (!(pressing > 0)) continue;
      for (double& n : normal) n /= pressing;
      const double spring = (pair.has_springs() ? 1 : stiffening) * pair.segment_stiffness[tracked(s)];
      // Of a spring whose stiffness grows straight from its start.
      const double stiffness = pair.has_springs() && pair.growth != 1 && gap(s) < 0
                                   ? std::max(spring, -2 * pressing / gap(s) - spring)
                                   : spring;
      const double across = !has_friction(scene_, pair, StepKind::settling)
                                ? 0
                                : (status(s) == status_sticks ? 1 : slipping_share) * spring;
      if (curved.empty()) {
        springs.add_spring(nodes, weights, normal, stiffness - across);
      } else {
        std::vector<int> felt{pair.slave_nodes[s]};
        std::vector<double> by{1};
        for (const auto& [n, weight] : curved[s]) {
          felt.push_back(n);
          by.push_back(-weight);
        }
        springs.add_spring(felt, by, normal, stiffness);
        if (across > 0) springs.add_spring(nodes, weights, normal, -across);
      }
      if (across > 0)
        for (const Vec3& axis : axes) springs.add_spring(nodes, weights, axis, across);
    }
  }
}

double StaticContact::renew_multipliers() {
  double change = 0, largest = 0;
  for (std::size_t p = 0; p < multiplier_.size(); ++p) {
    if (contacts_[p].has_springs()) continue;
    const auto before = to_vector(multiplier_[p]), now = pressing_forces(contacts_[p]);
    for (std::size_t s = 0; s < now.size(); ++s) {
      change = std::max(change, std::fabs(now[s] - before[s]));
      largest = std::max(largest, now[s]);
    }
    multiplier_[p] = to_device("multipliers", now);
  }
  return largest > 0 ? change / largest : 0;
}

}  // namespace railwave
