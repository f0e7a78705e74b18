#include "mesh/sections/profile_contact.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {

ProfileContact::ProfileContact(std::vector<ProfilePoint> wheel, std::vector<ProfilePoint> rail)
    : wheel_(std::move(wheel)), rail_(std::move(rail)), slope_(wheel_.size()) {
  if (rail_.front().at.y > rail_.back().at.y) std::reverse(rail_.begin(), rail_.end());
  for (std::size_t i = 0; i < wheel_.size(); ++i) {
    const Point2 chord = wheel_[std::min(i + 1, wheel_.size() - 1)].at - wheel_[i == 0 ? 0 : i - 1].at;
    // The flange's back is vertical: no circle of it is the lowest anywhere.
    slope_[i] = std::abs(chord.y) > 0 ? chord.z / chord.y : 1e9;
  }
}

std::vector<ProfileContact::Opening> ProfileContact::openings(const AxlePlace& place) const {
  // Unit vectors: along the axle; level across it, forwards; down in the wheel's plane.
  const double cy = std::cos(place.yaw), sy = std::sin(place.yaw), cr = std::cos(place.roll), sr = std::sin(place.roll);
  const double axle[3] = {-sy * cr, cy * cr, sr}, forward[3] = {cy, sy, 0}, down[3] = {-sy * sr, cy * sr, -cr};
  std::vector<Opening> found;
  for (std::size_t i = 0; i < wheel_.size(); ++i) {
    // Point of the circle at the angle t from `down`: normal cos(t) down + sin(t) forward - slope axle, x of it 0.
    const double a = forward[0], b = down[0], c = slope_[i] * axle[0], size = std::hypot(a, b);
    if (std::abs(c) >= size) continue;
    const double t = std::asin(c / size) - std::atan2(b, a);
    const double ct = std::cos(t), st = std::sin(t), radius = wheel_[i].at.z, along = wheel_[i].at.y;
    double p[3];
    for (int k = 0; k < 3; ++k) p[k] = along * axle[k] + radius * (ct * down[k] + st * forward[k]);
    const double y = place.lateral + p[1];
    const auto next = std::lower_bound(rail_.begin(), rail_.end(), y,
                                       [](const ProfilePoint& of, double value) { return of.at.y < value; });
    if (next == rail_.begin() || next == rail_.end()) continue;
    const ProfilePoint &left = *(next - 1), &right = *next;
    const double share = (y - left.at.y) / (right.at.y - left.at.y);
    const double z = left.at.z + share * (right.at.z - left.at.z);
    // The normal's y and z give the tangent's slope across the rail.
    const double ny = ct * down[1] + st * forward[1] - slope_[i] * axle[1], nz = ct * down[2] - slope_[i] * axle[2];
    const double ahead = radius * (ct * down[0] + st * forward[0]);
    found.push_back({p[2] - z, i, left.arc + share * (right.arc - left.arc), {y, z}, ahead, -ny / nz});
  }
  if (found.empty()) return found;
  const double least = std::min_element(found.begin(), found.end(), [](const Opening& a, const Opening& b) {
                         return a.opening < b.opening;
                       })->opening;
  for (Opening& one : found) one.opening -= least;
  return found;
}

std::vector<ProfileMeeting> ProfileContact::meetings(const AxlePlace& place, double opening) const {
  // Minima that are nearer than that along the wheel, or between which the opening hardly grows, are one.
  constexpr double apart = 4e-3, ridge = 2e-6;
  const auto all = openings(place);
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool lowest = (i == 0 || all[i].opening <= all[i - 1].opening) &&
                        (i + 1 == all.size() || all[i].opening <= all[i + 1].opening);
    if (lowest && all[i].opening <= opening) minima.push_back(i);
  }
  std::sort(minima.begin(), minima.end(),
            [&](std::size_t a, std::size_t b) { return all[a].opening < all[b].opening; });
  std::vector<std::size_t> kept;
  for (std::size_t i : minima) {
    const bool own = std::all_of(kept.begin(), kept.end(), [&](std::size_t other) {
      const auto [from, to] = std::minmax(i, other);
      double top = 0;
      for (std::size_t k = from; k <= to; ++k) top = std::max(top, all[k].opening);
      return std::abs(wheel_[all[i].wheel].arc - wheel_[all[other].wheel].arc) > apart && top > all[i].opening + ridge;
    });
    if (own) kept.push_back(i);
  }
  std::vector<ProfileMeeting> result;
  for (std::size_t i : kept) {
    const Opening& one = all[i];
    const ProfilePoint& wheel = wheel_[one.wheel];
    result.push_back({wheel.arc, one.rail_arc, wheel.at, one.rail, std::atan(one.slope), one.ahead, one.opening});
  }
  return result;
}

NearPieces ProfileContact::near(const AxlePlace& place, double opening) const {
  NearPieces pieces;
  const auto extend = [](std::array<double, 2>& piece, double arc) {
    piece = {std::min(piece[0], arc), std::max(piece[1], arc)};
  };
  for (const Opening& one : openings(place)) {
    if (one.opening > opening) continue;
    extend(pieces.wheel, wheel_[one.wheel].arc);
    extend(pieces.rail, one.rail_arc);
  }
  return pieces;
}

}  // namespace railwave
