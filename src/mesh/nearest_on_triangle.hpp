#pragma once

#include <algorithm>

#include "mesh/vectors.hpp"

namespace railwave {

/// The point of an edge nearest to a place, m.
inline Vec3 nearest_on_edge(const Vec3& a, const Vec3& b, const Vec3& place) {
  const Vec3 along = difference(b, a);
  const double squared = dot(along, along),
               share = squared > 0 ? std::clamp(dot(difference(place, a), along) / squared, 0.0, 1.0) : 0.0;
  return {a[0] + share * along[0], a[1] + share * along[1], a[2] + share * along[2]};
}

/// The point of a triangle nearest, m, to a place: its foot on the plane if that lies inside, or one of an edge.
inline Vec3 nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& place) {
  const Vec3 normal = cross(difference(b, a), difference(c, a));
  const double squared = dot(normal, normal);
  if (squared > 0) {
    const double off = dot(difference(place, a), normal) / squared;
    const Vec3 foot = {place[0] - off * normal[0], place[1] - off * normal[1], place[2] - off * normal[2]};
    const auto left_of = [&](const Vec3& p, const Vec3& q) {
      return dot(cross(difference(q, p), difference(foot, p)), normal) >= 0;
    };
    if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return foot;
  }
  Vec3 best = nearest_on_edge(a, b, place);
  for (const Vec3& other : {nearest_on_edge(b, c, place), nearest_on_edge(c, a, place)})
    if (length(difference(other, place)) < length(difference(best, place))) best = other;
  return best;
}

}  // namespace railwave
