#pragma once

#include <array>
#include <vector>

#include "kernels/contact/contact_arrays.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A contact surface's segments with what is beyond their sides, and its corners at mouths.
struct LinkedSegments {
  std::vector<Segment> segments;
  std::vector<MouthCorner> mouth_corners;  ///< `master` is left to the caller
};

/// Beyond a side is the segment that shares its nodes, with a mark where the surface folds by 60 degrees or more; where
/// the surface ends, or folds outwards, the segment across a mouth, if there is one.
/// @param nodes     where they are, m
/// @param segments  of each the numbers of its corners, counter-clockwise seen from outside
/// @param widest_mouth m: a crack, slot or gap so wide between two sides that face each other is crossed
LinkedSegments link_segments(const std::vector<Vec3>& nodes, const std::vector<std::array<int, 4>>& segments,
                             double widest_mouth);

/// The order of SegmentBoxes, and room for its boxes.
/// @param nodes     where they are, m
/// @param segments  of each the numbers of its corners
SegmentBoxes make_boxes(const std::vector<Vec3>& nodes, const std::vector<std::array<int, 4>>& segments);

}  // namespace railwave
