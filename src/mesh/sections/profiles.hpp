#pragma once

#include <string>

#include "mesh/curve.hpp"

namespace railwave {

/// S1002 wheel profile of EN 13715 / UIC 510-2 (flange 32.5 mm thick, 28 mm high): by how much the wheel's radius at
/// the lateral coordinate s exceeds the radius at the tape circle s = 0 (m). The flange lies towards negative s. Valid
/// from s1002_first (flange back, vertical tangent) to s1002_last.
double s1002_height(double s);
/// d(height)/ds; infinite at the flange back.
double s1002_slope(double s);
inline constexpr double s1002_first = -0.070;
inline constexpr double s1002_last = 0.060;
/// Where its sections meet; the curvature jumps there.
inline constexpr double s1002_joints[] = {-0.062764705882, -0.049662510381, -0.039764473993, -0.038426669071,
                                          -0.035,          -0.026,          0.03215796};
/// Where the arc of the flange back (centre, radius) meets the flange tip's arc.
inline constexpr double s1002_flange_back_joint = s1002_joints[0];
inline constexpr Point2 s1002_flange_back_centre{-0.0495, 0.009519259302};
inline constexpr double s1002_flange_back_radius = 0.0205;

/// The profile from the flange back's joint to s = `end`, at the height added by `radius`, by arc length.
Curve s1002_curve(double radius, double end);

/// The right half (y > 0) of a rail's outline before inclination, from the crown's middle clockwise to the middle of
/// the underside, cut where a mesh needs corners. z = 0 at the underside of the foot, y = 0 in the middle (m).
struct RailOutline {
  double height = 0;
  double crown_end = 0;         ///< arc length on `head` at which the gauge corner's arc begins
  double gauge_corner_end = 0;  ///< arc length on `head` at which the gauge corner's arc ends and the side begins
  Curve head;                   ///< crown to the middle of the head's lower corner
  Curve underside;              ///< on to the middle of the fillet between head and web
  Curve web;                    ///< on to the middle of the fillet between web and foot
  Curve foot_top;               ///< on to the middle of the toe's upper rounding
  Curve toe;                    ///< on to the middle of the toe's lower rounding
  Curve base;                   ///< on to y = 0
};

/// Tangent arcs of EN 13674-1 for "54E1" and "60E1"; some fillets of web and foot are fitted to a published outline.
/// Throws std::invalid_argument for another name.
RailOutline rail_outline(const std::string& section);

}  // namespace railwave
