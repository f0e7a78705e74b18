#pragma once

#include <array>
#include <vector>

#include "model/assembly.hpp"
#include "model/contact/contact_pair.hpp"

namespace railwave {

/// What lies beyond a side of a contact surface's facet.
enum class Beyond : int {
  goes_on = -1,  ///< no facet shares the side, but the surface goes on within some segments: behind a crack, a slot, a
                 ///< rail gap
  body_ends = -2,  ///< the body's skin turns away by more than 60 degrees: the end of a rail, the edge of a block
  set_ends = -3    ///< the skin goes on, but the surface does not, where a contact is not seen
};

/// Where a surface's facets end.
struct SurfaceEnds {
  std::vector<std::array<int, 4>> corners;  ///< model nodes of each facet, turned outwards
  std::vector<std::array<int, 4>> beyond;   ///< of its side from corner k to the next: the facet there, or a Beyond
  bool is_end(int facet, int side) const { return beyond[facet][side] <= static_cast<int>(Beyond::body_ends); }
};

/// The ends of one surface of a pair.
/// @param corners model nodes of its facets, turned outwards
/// @param others surfaces on which the same contact partner may go on, as those of other rails
SurfaceEnds surface_ends(const Assembly& assembly, std::vector<std::array<int, 4>> corners,
                         const std::vector<std::vector<std::array<int, 4>>>& others);

/// Both surfaces of one of the contact pairs, in the order slave, master; what other contacts of one's part
/// touch continues the other.
std::array<SurfaceEnds, 2> pair_ends(const Assembly& assembly, const std::vector<ContactPair>& contacts,
                                     const ContactPair& pair);

/// The direction in which a surface ends at a facet's side, unit: in the facet's plane, away from it.
Vec3 outward(const std::vector<Vec3>& place, const std::array<int, 4>& corners, int side);

/// m: the longest side of each facet up to which it counts as fine: twice the element size of the part's solution zone,
/// or of the path that it has besides. 0 where the part's mesh has none.
double finest_wanted(const scene::Scene& scene, const std::string& part);

/// m
double longest_side(const std::vector<Vec3>& place, const std::array<int, 4>& corners);

}  // namespace railwave
