#include "solve/monitor/monitor_measures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mesh/hexahedron.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Of equal values the lower place is kept, as Largest does.
void keep_larger(Extreme& extreme, const Extreme& other, double sign) {
  if (other.place < 0) return;
  const double mine = sign * extreme.value, theirs = sign * other.value;
  if (extreme.place < 0 || theirs > mine || (theirs == mine && other.place < extreme.place)) extreme = other;
}

}  // namespace

ElementShape undeformed_shape(const Assembly& assembly, int element) {
  ElementShape shape;
  for (int N = 0; N < 8; ++N)
    for (int i = 0; i < 3; ++i) shape.x[N][i] = assembly.nodes[assembly.elements[element][N]][i];
  return shape;
}

void join(MonitorMeasures& measures, const MonitorMeasures& of_others) {
  keep_larger(measures.jacobian, of_others.jacobian, -1);
  keep_larger(measures.distortion, of_others.distortion, 1);
  keep_larger(measures.speed, of_others.speed, 1);
  keep_larger(measures.acceleration, of_others.acceleration, 1);
}

MonitorArrays::MonitorArrays(const Assembly& assembly, const std::vector<ContactPair>& contacts, const OwnItems* own) {
  if (own != nullptr) {
    elements_ = own->elements;
    own_nodes_ = true;
    node_numbers_ = own->nodes;
    nodes_ = to_device("monitored nodes", own->nodes);
  }
  shapes_.count = own != nullptr ? static_cast<int>(elements_.size()) : static_cast<int>(assembly.elements.size());
  shapes_.corners = unset_array<int* [8]>("monitored corners", shapes_.count);
  shapes_.undeformed = unset_array<float * [ElementShapes::values]>("monitored shapes", shapes_.count);
  const auto corners = Kokkos::create_mirror_view(shapes_.corners);
  const auto undeformed = Kokkos::create_mirror_view(shapes_.undeformed);
  for (int i = 0; i < shapes_.count; ++i) {
    const int e = own != nullptr ? elements_[i] : i;
    const ElementShape shape = undeformed_shape(assembly, e);
    const double volume = hexahedron_volume(corners_of(assembly.nodes, assembly.elements[e])), mean = volume / 8;
    const double jacobian = shape.smallest_jacobian();
    for (int N = 0; N < 8; ++N) corners(i, N) = assembly.elements[e][N];
    undeformed(i, ElementShapes::jacobian) = static_cast<float>(jacobian);
    undeformed(i, ElementShapes::scale) = static_cast<float>(std::fmax(jacobian, 0.1 * mean));
    for (int m = 0; m < 4; ++m) undeformed(i, ElementShapes::mode + m) = static_cast<float>(shape.hourglass_mode(m));
    undeformed(i, ElementShapes::size) = static_cast<float>(std::cbrt(volume));
  }
  Kokkos::deep_copy(shapes_.corners, corners);
  Kokkos::deep_copy(shapes_.undeformed, undeformed);
  for (const ContactPair& pair : contacts)
    changes_.push_back(Array<int*>("monitored contact", pair.arrays.slave_count));
}

void MonitorArrays::archive(StateSaver& state) {
  for (std::size_t c = 0; c < changes_.size(); ++c)
    state.values(fmt::format("watch_contact_{}", c), to_vector(changes_[c]));
}

void MonitorArrays::archive(StateRestorer& state) {
  for (std::size_t c = 0; c < changes_.size(); ++c) {
    const std::string name = fmt::format("watch_contact_{}", c);
    std::vector<int> seen;
    state.values(name, seen);
    if (seen.size() != changes_[c].extent(0))
      refuse_state(name, fmt::format("has {} values, not {}", seen.size(), changes_[c].extent(0)));
    changes_[c] = to_device("monitored contact", seen);
  }
}

void MonitorArrays::ask(const NodalState& nodal, const std::vector<ContactPair>& contacts,
                        const ExecutionSpace& order) {
  question_.ask(order, [&](Reductions& reductions, MonitorMeasures& found) {
    reductions.largest(ElementCheck{shapes_, nodal.nodes.position}, shapes_.count,
                       [this, &found](const Largest<2>& of) {
                         const auto element = [this](int i) { return i < 0 || elements_.empty() ? i : elements_[i]; };
                         found.jacobian = {-of.value[0], element(of.place[0])};
                         found.distortion = {of.value[1], element(of.place[1])};
                       });
    const int nodes = own_nodes_ ? static_cast<int>(nodes_.extent(0)) : nodal.nodes.count;
    reductions.largest(NodeCheck{nodal.subcycled_acceleration(), nodes_}, nodes, [this, &found](const Largest<2>& of) {
      const auto node = [this](int i) { return i < 0 || !own_nodes_ ? i : node_numbers_[i]; };
      found.speed = {of.value[0], node(of.place[0])};
      found.acceleration = {of.value[1], node(of.place[1])};
    });
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const ContactPair& pair = contacts[c];
      reductions.largest(ContactCheck{pair.arrays, nodal.nodes.position, changes_[c]}, pair.arrays.slave_count,
                         [&pair, &found](const Largest<2>& of) {
                           const auto node = [&pair](int slave) { return slave < 0 ? -1 : pair.slave_nodes[slave]; };
                           found.penetration.push_back({of.value[0], node(of.place[0])});
                           found.chatter.push_back({of.value[1], node(of.place[1])});
                         });
    }
  });
}

MonitorMeasures MonitorArrays::measure(const NodalState& nodal, const std::vector<ContactPair>& contacts) {
  if (!question_.asked()) ask(nodal, contacts, ExecutionSpace());
  return question_.answer();
}

double MonitorArrays::largest_rate(const NodalState& nodal) const {
  double squared = 0;
  Reductions reductions(*nodal.reduction_space);
  reductions.largest(EdgeRate{shapes_, nodal.nodes.position, nodal.nodes.velocity}, shapes_.count,
                     [&squared](const Largest<1>& of) { squared = of.value[0]; });
  reductions.fetch();
  return std::sqrt(squared);
}

}  // namespace railwave
