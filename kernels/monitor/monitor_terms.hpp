#pragma once

#include "kernels/contact/contact_arrays.hpp"
#include "kernels/elements/element_modes.hpp"
#include "kernels/nodes/nodes.hpp"
#include "kernels/nodes/subcycled_nodes.hpp"

namespace railwave {

/// An element's shape where nothing has moved: its smallest Jacobian at a corner, m3, what its change is measured by
/// (that Jacobian, but no less than a tenth of the mean: corners may be flat from the beginning), the sizes of its four
/// hourglass modes, m, and its size, m.
struct ElementShapes {
  static constexpr int jacobian = 0, scale = 1, mode = 2, size = 6, values = 7;
  int count = 0;
  Array<int* [8]> corners;
  Array<float* [values]> undeformed;
};

/// Corners of an element and what its shape is measured by.
struct ElementShape {
  Vector3 x[8];

  KOKKOS_INLINE_FUNCTION static double jacobian(const Vector3& along, const Vector3& across, const Vector3& up) {
    return 0.125 * dot(along, cross(across, up));
  }

  /// Jacobian at each corner, of the edges that meet there.
  KOKKOS_INLINE_FUNCTION double smallest_jacobian() const {
    const Vector3 along[4] = {x[1] - x[0], x[2] - x[3], x[5] - x[4], x[6] - x[7]};
    const Vector3 across[4] = {x[3] - x[0], x[2] - x[1], x[7] - x[4], x[6] - x[5]};
    const Vector3 up[4] = {x[4] - x[0], x[5] - x[1], x[6] - x[2], x[7] - x[3]};
    const double at[8] = {jacobian(along[0], across[0], up[0]), jacobian(along[0], across[1], up[1]),
                          jacobian(along[1], across[1], up[2]), jacobian(along[1], across[0], up[3]),
                          jacobian(along[2], across[2], up[0]), jacobian(along[2], across[3], up[1]),
                          jacobian(along[3], across[3], up[2]), jacobian(along[3], across[2], up[3])};
    double least = at[0];
    // What is not a number stays.
    for (int N = 1; N < 8; ++N)
      if (least == least && !(at[N] >= least)) least = at[N];
    return least;
  }

  /// How far the corners lie in an hourglass mode (0 to 3), m: no rigid motion changes it.
  KOKKOS_INLINE_FUNCTION double hourglass_mode(int m) const {
    Vector3 sum{{0, 0, 0}};
    for (int N = 0; N < 8; ++N) sum = sum + (0.125 * mode_sign(3 + m, N)) * x[N];
    return norm(sum);
  }
};

/// Minus the smallest Jacobian over the undeformed one, as far as that is large enough (1 + (J - J_0)/scale); the
/// largest change of an hourglass mode over the element's size.
struct ElementCheck {
  static constexpr int values = 2;
  ElementShapes shapes;
  Array<const double* [3]> position;

  KOKKOS_INLINE_FUNCTION void operator()(int e, double* value) const {
    ElementShape now;
    for (int N = 0; N < 8; ++N) now.x[N] = row(position, shapes.corners(e, N));
    value[0] = (shapes.undeformed(e, ElementShapes::jacobian) - now.smallest_jacobian()) /
                   shapes.undeformed(e, ElementShapes::scale) -
               1;
    value[1] = 0;
    for (int m = 0; m < 4; ++m) {
      const double change = std::fabs(now.hourglass_mode(m) - shapes.undeformed(e, ElementShapes::mode + m));
      if (value[1] == value[1] && !(change <= value[1])) value[1] = change;
    }
    value[1] /= shapes.undeformed(e, ElementShapes::size);
  }
};

/// Largest difference of velocity over distance between neighbouring corners of an element, 1/s, squared: of what turns
/// its angular velocity, of what travels nothing.
struct EdgeRate {
  static constexpr int values = 1;
  ElementShapes shapes;
  Array<const double*[3]> position, velocity;

  KOKKOS_INLINE_FUNCTION void operator()(int e, double* value) const {
    value[0] = 0;
    for (int k = 0; k < 12; ++k) {
      // Around the lower and the upper face, and up between them.
      const int N = k % 8, M = k >= 8 ? N + 4 : N % 4 == 3 ? N - 3 : N + 1;
      const int a = shapes.corners(e, N), b = shapes.corners(e, M);
      const Vector3 moving = row(velocity, a) - row(velocity, b), apart = row(position, a) - row(position, b);
      const double length = dot(apart, apart);
      if (length > 0) value[0] = std::fmax(value[0], dot(moving, moving) / length);
    }
  }
};

/// A node's speed, m/s, and its acceleration, m/s2, which tells from what travels fast what is pushed too hard.
struct NodeCheck {
  static constexpr int values = 2;
  SubcycledAcceleration acceleration;
  Array<const int*> listed;  ///< nodes; empty: all
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const {
    const int n = listed.extent(0) == 0 ? i : listed(i);
    value[0] = norm(row(acceleration.plain.force.nodes.velocity, n));
    value[1] = norm(acceleration(n));
  }
};

/// What the account adds of a group's elements, from what each block has: elastic energy, hourglass control, damping,
/// work of flow.
struct BlockTotals {
  static constexpr int values = 4;
  Array<const double* [values]> of;
  KOKKOS_INLINE_FUNCTION void operator()(int p, double* sum) const {
    for (int k = 0; k < values; ++k) sum[k] += of(p, k);
  }
};

/// How deep a slave node is in its segment, over the segment's size; how often it was seen to open and to close again.
struct ContactCheck {
  static constexpr int values = 2;
  ContactArrays contact;
  Array<const double* [3]> position;
  Array<int*>
      changes;  ///< by slave: twice the changes of its status that checks have seen, and 1 where it touched at the last

  KOKKOS_INLINE_FUNCTION void operator()(int s, double* value) const {
    const int touches = contact.status(s) == status_apart ? 0 : 1;
    if ((changes(s) & 1) != touches) changes(s) = ((changes(s) >> 1) + 1) * 2 + touches;
    value[0] = 0;
    value[1] = 0.5 * (changes(s) >> 1);
    if (touches == 0) return;
    const Segment segment = contact.surface(contact.tracked(s));
    const Vector3 across =
        row(position, contact.node_of(segment.node[2])) - row(position, contact.node_of(segment.node[0]));
    const Vector3 other =
        row(position, contact.node_of(segment.node[3])) - row(position, contact.node_of(segment.node[1]));
    value[0] = -contact.gap(s) / std::sqrt(0.5 * norm(cross(across, other)));
  }
};

}  // namespace railwave
