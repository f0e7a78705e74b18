#include "post/rigid_slip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace railwave {
namespace {

RigidSlip slip_in(const ContactState& state, const LocalFrame& frame, double inner, double outer) {
  RigidSlip slip;
  slip.slave = fit_rigid_motion(state.slave, nodes_in_ring(state.slave, frame.centre, inner, outer), frame.centre);
  slip.master = fit_rigid_motion(state.master, nodes_in_ring(state.master, frame.centre, inner, outer), frame.centre);
  slip.known = slip.slave.nodes > 0 && slip.master.nodes > 0;
  const Vector difference = slip.slave.velocity - slip.master.velocity;
  const Vector mean = 0.5 * (slip.slave.velocity + slip.master.velocity);
  slip.along = difference.dot(frame.along);
  slip.across = difference.dot(frame.across);
  slip.spin = (slip.slave.rotation - slip.master.rotation).dot(frame.along.cross(frame.across));
  slip.mean_along = mean.dot(frame.along);
  slip.mean_across = mean.dot(frame.across);
  return slip;
}

}  // namespace

RigidSlip rigid_slip(const ContactState& state, const LocalFrame& frame, double semi_axis, const CreepageRing& ring) {
  const double inner = ring.inner * semi_axis, outer = ring.outer * semi_axis, middle = 0.5 * (inner + outer);
  RigidSlip slip = slip_in(state, frame, inner, outer);
  for (const RigidSlip& half : {slip_in(state, frame, inner, middle), slip_in(state, frame, middle, outer)}) {
    const double unknown = half.known ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    const auto widen = [&](double& spread, double value, double other) {
      spread = std::isnan(spread) ? spread : std::max(std::fabs(value - other), spread) + unknown;
    };
    widen(slip.spread_along, slip.along, half.along);
    widen(slip.spread_across, slip.across, half.across);
    widen(slip.spread_spin, slip.spin, half.spin);
  }
  return slip;
}

}  // namespace railwave
