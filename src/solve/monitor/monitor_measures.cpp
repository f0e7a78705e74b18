#include "solve/monitor/monitor_measures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kernels/support/reductions.hpp"
#include "mesh/hexahedron.hpp"
#include "model/host_copy.hpp"

namespace railwave {
MonitorArrays::MonitorArrays(const Assembly& assembly, const std::vector<ContactPair>& contacts) {
  const auto& elements = assembly.elements;
  shapes_.count = static_cast<int>(elements.size());
  shapes_.corners = unset_array<int* [8]>("monitored corners", elements.size());
  shapes_.undeformed = unset_array<float * [ElementShapes::values]>("monitored shapes", elements.size());
  const auto corners = Kokkos::create_mirror_view(shapes_.corners);
  const auto undeformed = Kokkos::create_mirror_view(shapes_.undeformed);
  for (int e = 0; e < shapes_.count; ++e) {
    ElementShape shape;
    for (int N = 0; N < 8; ++N) {
      corners(e, N) = elements[e][N];
      for (int i = 0; i < 3; ++i) shape.x[N][i] = assembly.nodes[elements[e][N]][i];
    }
    const double volume = hexahedron_volume(corners_of(assembly.nodes, elements[e]));
    const double jacobian = shape.smallest_jacobian(), mean = volume / 8;
    if (e == 0 || jacobian / mean < worst_shape_.value) worst_shape_ = {jacobian / mean, e};
    undeformed(e, ElementShapes::jacobian) = static_cast<float>(jacobian);
    undeformed(e, ElementShapes::scale) = static_cast<float>(std::fmax(jacobian, 0.1 * mean));
    for (int m = 0; m < 4; ++m) undeformed(e, ElementShapes::mode + m) = static_cast<float>(shape.hourglass_mode(m));
    undeformed(e, ElementShapes::size) = static_cast<float>(std::cbrt(volume));
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

MonitorMeasures MonitorArrays::measure(const NodalState& nodal, const std::vector<ContactPair>& contacts) const {
  MonitorMeasures found;
  Reductions reductions(*nodal.reduction_space);
  reductions.largest(ElementCheck{shapes_, nodal.nodes.position}, shapes_.count, [&found](const Largest<2>& of) {
    found.jacobian = {-of.value[0], of.place[0]};
    found.distortion = {of.value[1], of.place[1]};
  });
  reductions.largest(NodeCheck{nodal.subcycled_acceleration()}, nodal.nodes.count, [&found](const Largest<2>& of) {
    found.speed = {of.value[0], of.place[0]};
    found.acceleration = {of.value[1], of.place[1]};
  });
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactPair& pair = contacts[c];
    reductions.largest(ContactCheck{pair.arrays, nodal.nodes.position, changes_[c]}, pair.arrays.slave_count,
                       [&](const Largest<2>& of) {
                         const auto node = [&pair](int slave) { return slave < 0 ? -1 : pair.slave_nodes[slave]; };
                         found.penetration.push_back({of.value[0], node(of.place[0])});
                         found.chatter.push_back({of.value[1], node(of.place[1])});
                       });
  }
  reductions.fetch();
  return found;
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
