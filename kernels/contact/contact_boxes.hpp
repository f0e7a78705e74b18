#pragma once

#include "kernels/contact/contact_projection.hpp"
#include "kernels/support/team.hpp"

namespace railwave {

/// Of a number's size: more than single precision rounds off.
inline constexpr double single_rounding = 2.5e-7;

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
    RoundedBox box{};
    for (int c = 0; c < 3; ++c) {
      const double low =
          std::fmin(std::fmin(corner[0][c], corner[1][c]), std::fmin(corner[2][c], corner[3][c])) - margin;
      const double high =
          std::fmax(std::fmax(corner[0][c], corner[1][c]), std::fmax(corner[2][c], corner[3][c])) + margin;
      box.low[c] = static_cast<float>(low - single_rounding * std::fabs(low));
      box.high[c] = static_cast<float>(high + single_rounding * std::fabs(high));
      boxes.normal(i, c) = normal[c] / norm(normal);
    }
    boxes.segment(i) = box;
  }
};

/// Leaves around the segments' boxes, branches around leaves, boughs around branches: by one team, as a GPU takes
/// longer for three launches than for all that they do.
struct EncloseBoxes {
  SegmentBoxes boxes;

  KOKKOS_INLINE_FUNCTION void operator()(const Team::member_type& team) const {
    enclose<SegmentBoxes::leaf_size>(team, boxes.segment, boxes.leaf);
    enclose<SegmentBoxes::branch_size>(team, boxes.leaf, boxes.branch);
    enclose<SegmentBoxes::bough_size>(team, boxes.branch, boxes.bough);
  }

 private:
  template <int of_each>
  KOKKOS_INLINE_FUNCTION static void enclose(const Team::member_type& team, const Array<RoundedBox*>& smaller,
                                             const Array<RoundedBox*>& around) {
    const int count = static_cast<int>(around.extent(0)), all = static_cast<int>(smaller.extent(0));
    for (int n = team.team_rank(); n < count; n += team.team_size()) {
      const int first = n * of_each;
      RoundedBox box = smaller(first);
      for (int i = first + 1; i < first + of_each && i < all; ++i) {
        const RoundedBox one = smaller(i);
        for (int c = 0; c < 3; ++c) {
          box.low[c] = std::fmin(box.low[c], one.low[c]);
          box.high[c] = std::fmax(box.high[c], one.high[c]);
        }
      }
      around(n) = box;
    }
    team.team_barrier();
  }
};

/// @param space in whose order, @param interval s, @param sudden m, until the next check
/// @param enclose EncloseBoxes, or what does the same and something else
template <class Enclose>
void update_boxes(const ExecutionSpace& space, const ContactProjection& surface,
                  const Array<const double* [3]>& velocity, double interval, double sudden, const Enclose& enclose) {
  constexpr int threads = on_device ? 512 : 1;
  Kokkos::parallel_for("segment_boxes", SpreadRange(space, 0, surface.contact.boxes.segment_count()),
                       BoxSegments{surface, velocity, interval, sudden});
  Kokkos::parallel_for("boxes_around", Kokkos::TeamPolicy<ExecutionSpace, AsArgument>(space, 1, threads), enclose);
}

/// A place between numbers of single precision, in which a GPU has a box's distance with a third of the instructions.
struct RoundedPlace {
  float low[3], high[3];

  KOKKOS_INLINE_FUNCTION explicit RoundedPlace(const Vector3& x) {
    for (int c = 0; c < 3; ++c) {
      low[c] = static_cast<float>(x[c] - single_rounding * std::fabs(x[c]));
      high[c] = static_cast<float>(x[c] + single_rounding * std::fabs(x[c]));
    }
  }

  /// Whether a box is surely farther away than that; of NaN never.
  /// @param squared m2, rounded up
  KOKKOS_INLINE_FUNCTION bool is_beyond(const RoundedBox& box, float squared) const {
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
      const float below = box.low[c] - high[c], above = low[c] - box.high[c];
      const float beyond = below > above ? below : above, outside = beyond > 0 ? beyond : 0;
      sum += outside * outside;
    }
    return sum > squared;
  }

  /// A squared distance rounded up, by more than is_beyond() rounds.
  KOKKOS_INLINE_FUNCTION static float rounded_up(double squared) {
    return squared < 1e38 ? static_cast<float>((1 + 8 * single_rounding) * squared) : 3e38f;
  }
};

/// Calls visit(i) for the place in the order of each segment whose box is within a distance of a place, until it says
/// to stop.
/// @param limit m2, the distance squared; visit may make it smaller on the way
template <class Visit>
KOKKOS_INLINE_FUNCTION void visit_boxes(const SegmentBoxes& boxes, const Vector3& x, const double& limit,
                                        const Visit& visit) {
  const RoundedPlace place(x);
  float rounded_limit = RoundedPlace::rounded_up(limit);
  for (int g = 0; g < boxes.bough_count(); ++g) {
    if (place.is_beyond(boxes.bough(g), rounded_limit)) continue;
    const int first_branch = g * SegmentBoxes::bough_size, end_branch = first_branch + SegmentBoxes::bough_size;
    for (int b = first_branch; b < end_branch && b < boxes.branch_count(); ++b) {
      if (place.is_beyond(boxes.branch(b), rounded_limit)) continue;
      const int first_leaf = b * SegmentBoxes::branch_size, end_leaf = first_leaf + SegmentBoxes::branch_size;
      for (int l = first_leaf; l < end_leaf && l < boxes.leaf_count(); ++l) {
        if (place.is_beyond(boxes.leaf(l), rounded_limit)) continue;
        const int first = l * SegmentBoxes::leaf_size, end = first + SegmentBoxes::leaf_size;
        for (int i = first; i < end && i < boxes.segment_count(); ++i) {
          if (place.is_beyond(boxes.segment(i), rounded_limit)) continue;
          if (!visit(i)) return;
          rounded_limit = RoundedPlace::rounded_up(limit);
        }
      }
    }
  }
}

}  // namespace railwave
