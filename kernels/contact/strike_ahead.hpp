#pragma once

#include "kernels/contact/contact_arrays.hpp"

namespace railwave {

/// Of the slave nodes in a contact's window, against the master's segments that they are tracked over.
struct TrackedMotion {
  ContactArrays contact;
  ContactWindow window;
  Array<const double*[3]> position, velocity;

  KOKKOS_INLINE_FUNCTION Vector3 mean(const Array<const double* [3]>& of, const Segment& segment) const {
    Vector3 sum{{0, 0, 0}};
    for (int k = 0; k < 4; ++k) sum = sum + 0.25 * row(of, contact.node_of(segment.node[k]));
    return sum;
  }

  /// m/s, of the node against the middle of its segment.
  KOKKOS_INLINE_FUNCTION Vector3 relative_velocity(const WindowEntry& entry, const Segment& segment) const {
    return row(velocity, entry.node) - mean(velocity, segment);
  }
};

/// Speed of a slave node against the master, m/s.
struct Approach {
  static constexpr int values = 1;
  TrackedMotion tracked;

  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const {
    value[0] = 0;
    const WindowEntry entry = tracked.window.entries(i);
    const int s = tracked.contact.tracked(entry.slave);
    if (s >= 0) value[0] = norm(tracked.relative_velocity(entry, tracked.contact.surface(s)));
  }
};

/// Minus the number of steps in which a slave node that closes in on the master faster than `fast`, m/s, touches it.
struct StrikeAhead {
  static constexpr int values = 1;
  TrackedMotion tracked;
  double fast, step;

  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const {
    value[0] = -1e300;
    const ContactArrays& contact = tracked.contact;
    const Array<const double* [3]>& position = tracked.position;
    const WindowEntry entry = tracked.window.entries(i);
    if (entry.near == 0 || contact.tracked(entry.slave) < 0) return;
    const Segment segment = contact.surface(contact.tracked(entry.slave));
    const auto corner = [&](int k) { return row(position, contact.node_of(segment.node[k])); };
    const Vector3 normal = cross(corner(2) - corner(0), corner(3) - corner(1));
    const double size = norm(normal);
    const double closing = size > 0 ? -dot(tracked.relative_velocity(entry, segment), normal) / size : 0;
    if (!(closing > fast)) return;
    const double gap = dot(row(position, entry.node) - tracked.mean(position, segment), normal) / size;
    value[0] = gap > 0 ? -gap / (closing * step) : 0;
  }
};

}  // namespace railwave
