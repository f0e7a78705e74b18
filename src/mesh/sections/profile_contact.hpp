#pragma once

#include <array>
#include <vector>

#include "mesh/curve.hpp"

namespace railwave {

/// A profile's points by arc length along it. Of a wheel y is the place along its axle, from the origin of its mesh,
/// and z the radius; of a rail y and z are the scene's, m.
struct ProfilePoint {
  double arc = 0;
  Point2 at;
};

/// How a wheel's axle stands over a rail along x.
struct AxlePlace {
  double lateral = 0;  ///< y of the wheel's origin, m
  double yaw = 0;      ///< rad about z; positive: the wheel's plane points towards +y
  double roll = 0;     ///< rad about x; positive: the axle rises towards +y
};

/// Where the two profiles meet.
struct ProfileMeeting {
  double wheel_arc = 0, rail_arc = 0;  ///< m, along the profiles
  Point2 wheel, rail;                  ///< of the profiles
  double angle = 0;                    ///< rad, between the common tangent across the rail and the horizontal
  double ahead = 0;                    ///< m along x, from the axle there
  double opening = 0;                  ///< m, vertical, when the wheel is let down until it touches; 0 where it touches
};

/// Parts of both profiles that come near each other, as arc lengths, m.
struct NearPieces {
  std::array<double, 2> wheel{1e300, -1e300}, rail{1e300, -1e300};
};

/// Rigid contact of a wheel with a straight rail. The lowest outline of the turned wheel, seen along the rail, is the
/// envelope of its circles: on each of them the point whose normal has no component along x (de Pater 1988,
/// docs/references.md). The wheel is let down vertically onto the rail.
class ProfileContact {
 public:
  /// @param wheel the running surface; @param rail its running surface, y rising or falling all the way
  ProfileContact(std::vector<ProfilePoint> wheel, std::vector<ProfilePoint> rail);

  /// Where the opening is least in its surroundings and at most `opening`, m; the first is where they touch. Empty: no
  /// point of the wheel is above the rail.
  std::vector<ProfileMeeting> meetings(const AxlePlace& place, double opening) const;

  /// From the first to the last place with at most that opening, m.
  NearPieces near(const AxlePlace& place, double opening) const;

 private:
  struct Opening {
    double opening;
    std::size_t wheel;  ///< number of the wheel's point
    double rail_arc;
    Point2 rail;
    double ahead, slope;
  };
  std::vector<Opening> openings(const AxlePlace& place) const;

  std::vector<ProfilePoint> wheel_, rail_;  ///< the rail's by rising y
  std::vector<double> slope_;               ///< of the wheel's radius along the axle
};

}  // namespace railwave
