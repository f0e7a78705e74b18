#pragma once

#include "model/model.hpp"

namespace railwave::bench {

template <class View>
double bytes_of(const View& view) {
  return static_cast<double>(view.span() * sizeof(typename View::value_type));
}

/// Bytes that one step of the model's element and node kernels must move between memory and processor when every array
/// that a kernel reads comes in once and every array it writes goes out once: node data that several blocks read
/// count once a kernel (an ideal cache), what a write fetches first does not count. Blocks advance the nodes that are
/// theirs alone; the others' partial forces go out and come in again. Loads and contact are left out.
inline double step_traffic(const Model& model) {
  const NodeArrays& n = model.nodes;
  const bool relative = model.relative.active();
  double bytes = relative ? bytes_of(model.relative.node) : bytes_of(n.position) + bytes_of(n.reference);
  bool velocities = false;
  for (const ElementGroup& group : model.elements) {
    const ElementBlocks& p = group.blocks;
    bytes += bytes_of(p.element_count) + bytes_of(p.node_count) + bytes_of(p.material) + bytes_of(p.node) +
             bytes_of(p.frame) + bytes_of(p.corner) + bytes_of(p.first_place) + bytes_of(p.place) +
             bytes_of(p.hourglass_scale);
    if (relative) bytes += bytes_of(group.relative.local) + bytes_of(group.relative.arm) - bytes_of(p.frame);
    if (group.hourglass == scene::HourglassType::viscous) {
      bytes += 2 * bytes_of(p.hourglass_energy);
      velocities = true;
    }
  }
  if (velocities && !relative) bytes += bytes_of(n.velocity);
  const double nodes = n.count, listed = static_cast<double>(model.shared.nodes.extent(0)), alone = nodes - listed;
  const double rows = static_cast<double>(n.partial_place.extent(0)), listed_rows = rows - alone;
  const double row_bytes = (bytes_of(model.partial.in_double) + bytes_of(model.partial.in_single)) / rows;
  const double state = bytes_of(n.position) / nodes + bytes_of(n.velocity) / nodes, mass = bytes_of(n.mass) / nodes;
  bytes += listed_rows * 2 * row_bytes;  // partial forces out and in
  if (relative)
    return bytes + alone * sizeof(RelativeNode) +
           listed * (2 * sizeof(RelativeNode) + sizeof(SharedNode) + sizeof(FrameArm));
  bytes += alone * (state + mass);  // velocities and positions are written, the mass read
  bytes += listed * (2 * state + mass + sizeof(SharedNode));
  return bytes;
}

}  // namespace railwave::bench
