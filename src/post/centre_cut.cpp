#include "post/centre_cut.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {

int place_in(const std::vector<int>& sorted, int number) {
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), number);
  return found != sorted.end() && *found == number ? static_cast<int>(found - sorted.begin()) : -1;
}

namespace {

/// Corners of a facet in the patch's tangent plane.
struct FlatFacet {
  int facet;
  FacetCorners corners;
  Vector low, high;  ///< the box around them

  bool may_hold(const Vector& point) const {
    return (point.head<2>().array() >= low.head<2>().array()).all() &&
           (point.head<2>().array() <= high.head<2>().array()).all();
  }
};

std::vector<FlatFacet> flattened(const ContactSide& slave, const ContactPatch& patch) {
  std::vector<FlatFacet> facets;
  for (const int facet : patch.facets) {
    FlatFacet flat{facet, facet_corners(slave, facet), Vector::Constant(HUGE_VAL), Vector::Constant(-HUGE_VAL)};
    for (Vector& corner : flat.corners) {
      corner = patch.frame.place(corner);
      corner[2] = 0;
      flat.low = flat.low.cwiseMin(corner);
      flat.high = flat.high.cwiseMax(corner);
    }
    const Vector rim = 1e-9 * (flat.high - flat.low);
    flat.low -= rim;
    flat.high += rim;
    facets.push_back(flat);
  }
  return facets;
}

CutPoint point_on(const ContactState& state, const ContactPatch& patch, const FacetPlace& place) {
  const ContactSide& slave = state.slave;
  CutPoint point;
  double touching_share = 0;
  for (int k = 0; k < 4; ++k) {
    const int node = slave.facets[place.facet][k];
    const double share = place.shares[k];
    const RelativeMotion& motion = patch.motion[place_in(patch.surroundings, node)];
    point.micro_slip += share * patch.frame.components(motion.slip).head<2>();
    point.parting += share * motion.parting;
    const int touching = place_in(patch.touching, node);
    if (touching < 0) continue;
    point.pressure += share * patch.pressure[touching];
    point.bound += share * state.friction_at(node) * entry(slave.normal_force, node).norm() / slave.area[node];
    point.shear += share / slave.area[node] * patch.frame.components(entry(slave.tangential_force, node)).head<2>();
    touching_share += share;
    point.slip_by_force += patch.regions.by_force[touching] ? share : 0.0;
    point.slip_by_velocity += patch.regions.by_velocity[touching] ? share : 0.0;
  }
  if (touching_share > 0) {
    point.slip_by_force /= touching_share;
    point.slip_by_velocity /= touching_share;
  }
  return point;
}

}  // namespace

std::vector<CutPoint> centre_cut(const ContactState& state, const ContactPatch& patch, CutDirection direction,
                                 int points) {
  const int axis = direction == CutDirection::along ? 0 : 1;
  const std::vector<FlatFacet> facets = flattened(state.slave, patch);
  double first = HUGE_VAL, last = -HUGE_VAL;
  for (const FlatFacet& flat : facets) {
    if (flat.low[1 - axis] > 0 || flat.high[1 - axis] < 0) continue;
    first = std::min(first, flat.low[axis]);
    last = std::max(last, flat.high[axis]);
  }
  std::vector<CutPoint> cut;
  if (!(last > first)) return cut;
  for (int i = 0; i < points; ++i) {
    Vector place = Vector::Zero();
    place[axis] = first + (last - first) * i / (points - 1);
    for (const FlatFacet& flat : facets) {
      if (!flat.may_hold(place)) continue;
      FacetPlace found = nearest_on_facet(flat.corners, place);
      if (!found.inside) continue;
      found.facet = flat.facet;
      cut.push_back(point_on(state, patch, found));
      cut.back().distance = place[axis];
      break;
    }
  }
  return cut;
}

}  // namespace railwave
