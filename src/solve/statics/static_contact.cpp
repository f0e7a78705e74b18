#include "solve/statics/static_contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "kernels/contact/laws/augmented_penalty.hpp"
#include "mesh/vectors.hpp"
#include "model/host_copy.hpp"
#include "solve/tasks.hpp"
#include "solve/tasks/contact_window.hpp"
#include "solve/tasks/contributions.hpp"

namespace railwave {
namespace {

/// Stiffness of augmented Lagrange over that of penalty springs: more makes the gaps vanish sooner, and the equations
/// stiffer.
constexpr double stiffening = 4;
/// Tangential stiffness of a node that slips, over that of one that sticks: none would do, but for bodies held by
/// friction alone.
constexpr double slipping_share = 0.1;

template <class View>
void copy(const View& to, const View& from) {
  if (from.span() > 0) Kokkos::deep_copy(to, from);
}

template <class View>
View like(const View& view) {
  View copied = Kokkos::create_mirror(MemorySpace(), view);
  return copied;
}

ContactArrays state_like(const ContactArrays& contact) {
  ContactArrays result;
  result.tracked = like(contact.tracked);
  result.place = like(contact.place);
  result.status = like(contact.status);
  result.gap = like(contact.gap);
  result.normal_force = like(contact.normal_force);
  result.tangential_force = like(contact.tangential_force);
  return result;
}

void copy_state(const ContactArrays& to, const ContactArrays& from) {
  copy(to.tracked, from.tracked);
  copy(to.place, from.place);
  copy(to.status, from.status);
  copy(to.gap, from.gap);
  copy(to.normal_force, from.normal_force);
  copy(to.tangential_force, from.tangential_force);
}

/// What trials make flow, group by group.
std::vector<Array<double*>> plastic_state(const Model& model) {
  std::vector<Array<double*>> state;
  for (const ElementGroup& group : model.elements) state.push_back(group.material.history);
  return state;
}

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
std::vector<std::map<int, double>> curved_weights(const Model& model, const ContactPair& pair) {
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
                       CurvedWeights{ContactSearch{{pair.arrays, model.nodes.position}}, node, weight, count});
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
void press_pair(const Model& model, const ContactPair& pair, const Array<double*>& multiplier) {
  const AugmentedPenalty law{{pair.arrays.friction}, stiffening};
  const SpreadRange range(0, pair.window.count);
  const Instant instant;
  if (has_friction(model, pair, StepKind::settling))
    Kokkos::parallel_for("augmented_contact", range,
                         contact_force<true, Normals>(model, pair, instant, law, multiplier));
  else
    Kokkos::parallel_for("augmented_contact", range,
                         contact_force<false, Normals>(model, pair, instant, law, multiplier));
}

}  // namespace

StaticContact::StaticContact(Model& model) : model_(model) {
  for (const ContactPair& pair : model.contacts) {
    Kept& kept = kept_.emplace_back(Kept{state_like(pair.arrays), like(pair.law.state), {}});
    if (!pair.has_springs()) {
      augmented_ = true;
      kept.multiplier = to_device("multipliers", pressing_forces(pair));
    }
    for (const auto& segment : pair.master_segments)
      for (int k : {0, 1}) {
        const Vec3 &a = model.assembly.nodes[pair.master_nodes[segment[k]]],
                   &b = model.assembly.nodes[pair.master_nodes[segment[k + 2]]];
        smallest_segment_ = std::min(smallest_segment_, length(difference(a, b)));
      }
  }
  for (const Array<double*>& flowed : plastic_state(model)) plastic_.push_back(like(flowed));
}

void StaticContact::keep() {
  for (std::size_t p = 0; p < kept_.size(); ++p) {
    copy_state(kept_[p].contact, model_.contacts[p].arrays);
    copy(kept_[p].law_state, model_.contacts[p].law.state);
  }
  const auto plastic = plastic_state(model_);
  for (std::size_t i = 0; i < plastic_.size(); ++i) copy(plastic_[i], plastic[i]);
}

void StaticContact::restore() {
  for (std::size_t p = 0; p < kept_.size(); ++p) {
    ContactPair& pair = model_.contacts[p];
    copy_state(pair.arrays, kept_[p].contact);
    copy(pair.law.state, kept_[p].law_state);
    pair.next_look = pair.next_near_look = -1;
    pair.slaves_at_layout = {};
  }
  const auto plastic = plastic_state(model_);
  for (std::size_t i = 0; i < plastic_.size(); ++i) copy(plastic[i], plastic_[i]);
}

void StaticContact::press() {
  for (std::size_t p = 0; p < kept_.size(); ++p) {
    ContactPair& pair = model_.contacts[p];
    if (pair.has_springs()) continue;
    keep_window(model_, pair, 1, StepKind::settling);
    if (pair.contact->normals == scene::ContactNormals::smooth)
      press_pair<SmoothNormalsOfMultipliers>(model_, pair, kept_[p].multiplier);
    else
      press_pair<FacetNormals>(model_, pair, kept_[p].multiplier);
  }
}

void StaticContact::add_springs(SpringCollector& springs) const {
  constexpr Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const ContactPair& pair : model_.contacts) {
    const auto status = to_host(pair.arrays.status), tracked = to_host(pair.arrays.tracked);
    const auto place = to_host(pair.arrays.place);
    const auto normal_force = to_host(pair.arrays.normal_force);
    const auto gap = to_host(pair.arrays.gap);
    const auto curved = curved_weights(model_, pair);
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
      const double across = !has_friction(model_, pair, StepKind::settling)
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
  for (std::size_t p = 0; p < kept_.size(); ++p) {
    if (model_.contacts[p].has_springs()) continue;
    const auto before = to_vector(kept_[p].multiplier), now = pressing_forces(model_.contacts[p]);
    for (std::size_t s = 0; s < now.size(); ++s) {
      change = std::max(change, std::fabs(now[s] - before[s]));
      largest = std::max(largest, now[s]);
    }
    kept_[p].multiplier = to_device("multipliers", now);
  }
  return largest > 0 ? change / largest : 0;
}

}  // namespace railwave
