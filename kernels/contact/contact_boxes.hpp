#pragma once

#include "kernels/contact/contact_projection.hpp"

namespace railwave {

/// Box around a segment: where it is and can be until the next check, at its present speed and a quarter more, and
/// `sudden` for what waves and loads can add; and how far beside it a node still counts as over it.
struct BoxSegments {
  ContactProjection surface;
  Array<const double* [3]> velocity;
  double interval;  ///< s until the next check
  double sudden;    ///< m

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const SegmentBoxes& boxes = surface.contact.boxes;
    const Segment segment = surface.contact.surface(boxes.order(i));
    Vector3 corner[4];
    double fastest = 0;
    for (int k = 0; k < 4; ++k) {
      corner[k] = surface.at_corner(surface.position, segment.node[k]);
      const Vector3 v = surface.at_corner(velocity, segment.node[k]);
      fastest = std::fmax(fastest, dot(v, v));
    }
    const Vector3 diagonal = corner[2] - corner[0], normal = cross(diagonal, corner[3] - corner[1]);
    const double margin =
        1.25 * interval * std::sqrt(fastest) + sudden + ContactProjection::outside_tolerance * norm(diagonal);
    for (int c = 0; c < 3; ++c) {
      boxes.segment(i, c) =
          std::fmin(std::fmin(corner[0][c], corner[1][c]), std::fmin(corner[2][c], corner[3][c])) - margin;
      boxes.segment(i, 3 + c) =
          std::fmax(std::fmax(corner[0][c], corner[1][c]), std::fmax(corner[2][c], corner[3][c])) + margin;
      boxes.normal(i, c) = normal[c] / norm(normal);
    }
  }
};

/// Boxes around groups of so many boxes: around the leaves, then around the branches.
struct BoxBoxes {
  Array<const double* [6]> inner;
  Array<double* [6]> outer;
  int size;

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    const int count = static_cast<int>(inner.extent(0)), first = b * size,
              end = first + size < count ? first + size : count;
    for (int i = first; i < end; ++i)
      for (int c = 0; c < 3; ++c) {
        low[c] = std::fmin(low[c], inner(i, c));
        high[c] = std::fmax(high[c], inner(i, 3 + c));
      }
    for (int c = 0; c < 3; ++c) {
      outer(b, c) = low[c];
      outer(b, 3 + c) = high[c];
    }
  }
};

/// @param space in whose order, @param interval s, @param sudden m, until the next check
inline void update_boxes(const ExecutionSpace& space, const ContactProjection& surface,
                         const Array<const double* [3]>& velocity, double interval, double sudden) {
  const SegmentBoxes& boxes = surface.contact.boxes;
  Kokkos::parallel_for("segment_boxes", SpreadRange(space, 0, boxes.segment_count()),
                       BoxSegments{surface, velocity, interval, sudden});
  Kokkos::parallel_for("leaf_boxes", SpreadRange(space, 0, boxes.leaf_count()),
                       BoxBoxes{boxes.segment, boxes.leaf, SegmentBoxes::leaf_size});
  Kokkos::parallel_for("branch_boxes", SpreadRange(space, 0, boxes.branch_count()),
                       BoxBoxes{boxes.leaf, boxes.branch, SegmentBoxes::branch_size});
}

/// Squared distance of a place from a box, m2.
template <class Boxes>
KOKKOS_INLINE_FUNCTION double squared_distance_from_box(const Boxes& boxes, int b, const Vector3& x) {
  double squared = 0;
  for (int c = 0; c < 3; ++c) {
    const double outside = std::fmax(0.0, std::fmax(boxes(b, c) - x[c], x[c] - boxes(b, 3 + c)));
    squared += outside * outside;
  }
  return squared;
}

/// Calls visit(i) for the place in the order of each segment whose box is within a distance of a place, until it says
/// to stop.
/// @param limit m2, the distance squared; visit may make it smaller on the way
template <class Visit>
KOKKOS_INLINE_FUNCTION void visit_boxes(const SegmentBoxes& boxes, const Vector3& x, const double& limit,
                                        const Visit& visit) {
  for (int b = 0; b < boxes.branch_count(); ++b) {
    if (squared_distance_from_box(boxes.branch, b, x) > limit) continue;
    const int first_leaf = b * SegmentBoxes::branch_size, last_leaf = first_leaf + SegmentBoxes::branch_size;
    for (int l = first_leaf; l < last_leaf && l < boxes.leaf_count(); ++l) {
      if (squared_distance_from_box(boxes.leaf, l, x) > limit) continue;
      const int first = l * SegmentBoxes::leaf_size, last = first + SegmentBoxes::leaf_size;
      for (int i = first; i < last && i < boxes.segment_count(); ++i) {
        if (squared_distance_from_box(boxes.segment, i, x) > limit) continue;
        if (!visit(i)) return;
      }
    }
  }
}

}  // namespace railwave
