#include "solve/watch_measures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kernels/block_largest.hpp"
#include "mesh/hexahedron.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

template <int Values>
Extreme extreme(const Largest<Values>& largest, int k) {
  return {largest.value[k], largest.place[k]};
}

}  // namespace

WatchArrays::WatchArrays(const Model& model) {
  const auto& elements = model.assembly.elements;
  shapes_.count = static_cast<int>(elements.size());
  shapes_.corners = unset_array<int* [8]>("watched corners", elements.size());
  shapes_.undeformed = unset_array<float* [ElementShapes::values]>("watched shapes", elements.size());
  const auto corners = Kokkos::create_mirror_view(shapes_.corners);
  const auto undeformed = Kokkos::create_mirror_view(shapes_.undeformed);
  for (int e = 0; e < shapes_.count; ++e) {
    ElementShape shape;
    for (int N = 0; N < 8; ++N) {
      corners(e, N) = elements[e][N];
      for (int i = 0; i < 3; ++i) shape.x[N][i] = model.assembly.nodes[elements[e][N]][i];
    }
    const double volume = hexahedron_volume(corners_of(model.assembly.nodes, elements[e]));
    const double jacobian = shape.smallest_jacobian(), mean = volume / 8;
    if (e == 0 || jacobian / mean < worst_shape_.value) worst_shape_ = {jacobian / mean, e};
    undeformed(e, ElementShapes::jacobian) = static_cast<float>(jacobian);
    undeformed(e, ElementShapes::scale) = static_cast<float>(std::fmax(jacobian, 0.1 * mean));
    for (int m = 0; m < 4; ++m) undeformed(e, ElementShapes::mode + m) = static_cast<float>(shape.hourglass_mode(m));
    undeformed(e, ElementShapes::size) = static_cast<float>(std::cbrt(volume));
  }
  Kokkos::deep_copy(shapes_.corners, corners);
  Kokkos::deep_copy(shapes_.undeformed, undeformed);
  for (const ContactPair& pair : model.contacts) changes_.push_back(Array<int*>("watched contact", pair.arrays.slave_count));
}

void WatchArrays::archive(StateTaker& state) {
  for (std::size_t c = 0; c < changes_.size(); ++c) state.values(fmt::format("watch_contact_{}", c), to_vector(changes_[c]));
}

void WatchArrays::archive(StateLayer& state) {
  for (std::size_t c = 0; c < changes_.size(); ++c) {
    const std::string name = fmt::format("watch_contact_{}", c);
    std::vector<int> seen;
    state.values(name, seen);
    if (seen.size() != changes_[c].extent(0)) refuse_state(name, fmt::format("has {} values, not {}", seen.size(), changes_[c].extent(0)));
    changes_[c] = to_device("watched contact", seen);
  }
}

WatchMeasures WatchArrays::measure(const Model& model) const {
  WatchMeasures found;
  const auto element = block_largest(ElementWatch{shapes_, model.nodes.position}, shapes_.count);
  found.jacobian = extreme(element, 0);
  found.jacobian.value = -found.jacobian.value;
  found.distortion = extreme(element, 1);
  found.speed = extreme(block_largest(NodeWatch{model.nodes.velocity}, model.nodes.count), 0);
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const ContactPair& pair = model.contacts[c];
    const auto contact = block_largest(ContactWatch{pair.arrays, model.nodes.position, changes_[c]}, pair.arrays.slave_count);
    for (auto [list, k] : {std::pair{&found.penetration, 0}, {&found.chatter, 1}}) {
      Extreme one = extreme(contact, k);
      if (one.place >= 0) one.place = pair.slave_nodes[one.place];
      list->push_back(one);
    }
  }
  return found;
}

}  // namespace railwave
