#pragma once

#include "post/contact_patch.hpp"

namespace railwave {

enum class CutDirection { along, across };

/// What a patch carries at one place of a straight line through its centre in its tangent plane, brought there from the
/// corners of the facet by the bilinear shape functions.
struct CutPoint {
  double distance = 0;                                   ///< m, from the patch's centre along the line
  double pressure = 0;                                   ///< Pa
  double bound = 0;                                      ///< Pa, mu p
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();       ///< Pa, along and across
  Eigen::Vector2d micro_slip = Eigen::Vector2d::Zero();  ///< m/s, along and across
  double parting = 0;                                    ///< m/s
  double slip_by_force =
      0;  ///< 0 sticks, 1 slips (eq. 3.6), between the touching corners of the facet; above 0.5 it slips
  double slip_by_velocity = 0;
};

/// Position of a number in an ascending list; -1: it is not there.
int place_in(const std::vector<int>& sorted, int number);

/// Points in equal steps from one end of the facets around the patch to the other; where the line leaves them there is
/// none.
std::vector<CutPoint> centre_cut(const ContactState& state, const ContactPatch& patch, CutDirection direction,
                                 int points = 161);

}  // namespace railwave
