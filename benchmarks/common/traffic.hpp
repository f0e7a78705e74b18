#pragma once

#include "model/model.hpp"

namespace railwave::bench {

template <class View>
double bytes_of(const View& view) {
  return static_cast<double>(view.span() * sizeof(typename View::value_type));
}

/// Bytes that one step of the model's element and node kernels must move between memory and processor when every array
/// that a kernel reads comes in once and every array it writes goes out once: node data that several elements read
/// count once a kernel (an ideal cache), what a write fetches first does not count. Loads and contact are left out.
inline double step_traffic(const Model& model) {
  const NodeArrays& n = model.nodes;
  double elements = bytes_of(model.corner_force) + bytes_of(n.position) + bytes_of(n.reference);
  bool velocities = false;
  for (const ElementSet& set : model.elements) {
    elements += bytes_of(set.arrays.corners) + bytes_of(set.arrays.hourglass_scale);
    if (set.hourglass == scene::HourglassType::viscous) {
      elements += 2 * bytes_of(set.arrays.hourglass_energy);
      velocities = true;
    }
  }
  if (velocities) elements += bytes_of(n.velocity);
  const double nodes = bytes_of(model.corner_force) + bytes_of(n.corner) + bytes_of(n.first_corner) + bytes_of(n.extra) +
                       bytes_of(n.constraint) + bytes_of(n.mass) + 2 * bytes_of(n.position) + 2 * bytes_of(n.velocity);
  return elements + nodes;
}

}  // namespace railwave::bench
