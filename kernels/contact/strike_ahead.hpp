#pragma once

#include "kernels/contact/contact_arrays.hpp"

namespace railwave {

/// Minus the number of steps in which a slave node that closes in on the master faster than `fast`, m/s, touches it.
struct StrikeAhead {
  static constexpr int values = 1;
  ContactArrays contact;
  ContactWindow window;
  Array<const double*[3]> position, velocity;
  double fast, step;

  KOKKOS_INLINE_FUNCTION Vector3 mean(const Array<const double* [3]>& of, const Segment& segment) const {
    Vector3 sum{{0, 0, 0}};
    for (int k = 0; k < 4; ++k) sum = sum + 0.25 * row(of, contact.node_of(segment.node[k]));
    return sum;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const {
    value[0] = -1e300;
    const WindowEntry entry = window.entries(i);
    if (entry.near == 0 || contact.tracked(entry.slave) < 0) return;
    const Segment segment = contact.surface(contact.tracked(entry.slave));
    const auto corner = [&](int k) { return row(position, contact.node_of(segment.node[k])); };
    const Vector3 normal = cross(corner(2) - corner(0), corner(3) - corner(1));
    const double size = norm(normal);
    const Vector3 motion = row(velocity, entry.node) - mean(velocity, segment);
    const double closing = size > 0 ? -dot(motion, normal) / size : 0;
    if (!(closing > fast)) return;
    const double gap = dot(row(position, entry.node) - mean(position, segment), normal) / size;
    value[0] = gap > 0 ? -gap / (closing * step) : 0;
  }
};

}  // namespace railwave
