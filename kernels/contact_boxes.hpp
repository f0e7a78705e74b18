#pragma once

#include "kernels/contact_projection.hpp"

namespace railwave {

/// Boxes around the leaves of SegmentBoxes: where their segments are and can be until the next look, at their present speeds and a
/// quarter more, and `sudden` for what waves and loads can add; and how far beside them a node still counts as over them.
struct LeafBoxes {
  ContactProjection surface;
  Array<const double* [3]> velocity;
  double interval;  ///< s until the next look
  double sudden;    ///< m

  KOKKOS_INLINE_FUNCTION void operator()(const int l) const {
    const ContactArrays& contact = surface.contact;
    const SegmentBoxes& boxes = contact.boxes;
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300}, fastest = 0, widest = 0;
    const int first = l * SegmentBoxes::leaf_size, beyond = first + SegmentBoxes::leaf_size;
    const int end = beyond < contact.segment_count ? beyond : contact.segment_count;
    for (int i = first; i < end; ++i) {
      const Segment segment = contact.surface(boxes.order(i));
      const Vector3 diagonal = surface.diagonal(segment);
      widest = std::fmax(widest, dot(diagonal, diagonal));
      for (int k = 0; k < 4; ++k) {
        const Vector3 x = surface.at_corner(surface.position, segment.node[k]), v = surface.at_corner(velocity, segment.node[k]);
        fastest = std::fmax(fastest, dot(v, v));
        for (int c = 0; c < 3; ++c) {
          low[c] = std::fmin(low[c], x[c]);
          high[c] = std::fmax(high[c], x[c]);
        }
      }
    }
    const double margin = 1.25 * interval * std::sqrt(fastest) + sudden + ContactProjection::outside_tolerance * std::sqrt(widest);
    for (int c = 0; c < 3; ++c) {
      boxes.leaf(l, c) = low[c] - margin;
      boxes.leaf(l, 3 + c) = high[c] + margin;
    }
  }
};

/// Boxes around the branches, once the leaves have theirs.
struct BranchBoxes {
  SegmentBoxes boxes;

  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
    const int first = b * SegmentBoxes::branch_size, beyond = first + SegmentBoxes::branch_size;
    const int end = beyond < boxes.leaf_count() ? beyond : boxes.leaf_count();
    for (int l = first; l < end; ++l)
      for (int c = 0; c < 3; ++c) {
        low[c] = std::fmin(low[c], boxes.leaf(l, c));
        high[c] = std::fmax(high[c], boxes.leaf(l, 3 + c));
      }
    for (int c = 0; c < 3; ++c) {
      boxes.branch(b, c) = low[c];
      boxes.branch(b, 3 + c) = high[c];
    }
  }
};

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

}  // namespace railwave
