#include "post/micro_slip.hpp"

#include <cmath>

namespace railwave {
namespace {

constexpr double beside = 0.1;  ///< of a facet's diagonal: farther beside the surface a node is not over it

RelativeMotion motion_at(const ContactSide& slave, int node, const ContactSide& master, const FacetPlace& place) {
  const FacetCorners corners = facet_corners(master, place.facet);
  const Vector normal = facet_normal(corners, place);
  const Vector offset = entry(slave.position, node) - place.interpolate(master, master.position);
  RelativeMotion motion;
  if ((offset - offset.dot(normal) * normal).norm() > beside * (corners[2] - corners[0]).norm()) return motion;
  const Vector relative = entry(slave.velocity, node) - place.interpolate(master, master.velocity);
  motion.known = true;
  motion.parting = relative.dot(normal);
  motion.slip = relative - motion.parting * normal;
  return motion;
}

}  // namespace

std::vector<RelativeMotion> relative_motion(const ContactSide& slave, const std::vector<int>& nodes,
                                            const ContactSide& master, const SurfaceSearch& search) {
  std::vector<RelativeMotion> motions;
  motions.reserve(nodes.size());
  for (const int node : nodes) {
    // A node that touches is within a facet's size of a node of the master.
    const FacetPlace place = search.find(entry(slave.position, node), HUGE_VAL);
    motions.push_back(place.facet < 0 ? RelativeMotion{} : motion_at(slave, node, master, place));
  }
  return motions;
}

}  // namespace railwave
