#include "post/rigid_slip.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace railwave {
namespace {

Eigen::Matrix3d cross_matrix(const Vector& r) {
  Eigen::Matrix3d matrix;
  matrix << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0;
  return matrix;
}

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

RigidMotion fit_rigid_motion(const ContactSide& side, const std::vector<int>& nodes, const Vector& about) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  RigidMotion motion;
  motion.about = about;
  double area = 0, square = 0;
  for (const int node : nodes) {
    area += side.area[node];
    square += side.area[node] * (entry(side.position, node) - about).squaredNorm();
  }
  if (nodes.size() < 3 || !(square > 0)) return motion;
  const double length = std::sqrt(square / area);  // makes all six unknowns velocities

  // A column of the design is v = velocity - (r / length) x (length rotation).
  Matrix6 matrix = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  for (const int node : nodes) {
    Eigen::Matrix<double, 3, 6> design;
    design << Eigen::Matrix3d::Identity(), -cross_matrix((entry(side.position, node) - about) / length);
    const double weight = side.area[node] / area;
    matrix += weight * design.transpose() * design;
    right += weight * design.transpose() * entry(side.velocity, node);
  }
  const Eigen::LDLT<Matrix6> factors(matrix);
  if (factors.vectorD().minCoeff() < 1e-8 * factors.vectorD().maxCoeff()) return motion;  // on one line
  const Vector6 found = factors.solve(right);
  motion.nodes = static_cast<int>(nodes.size());
  motion.velocity = found.head<3>();
  motion.rotation = found.tail<3>() / length;
  double left = 0;
  for (const int node : nodes) {
    const Vector rigid = motion.velocity + motion.rotation.cross(entry(side.position, node) - about);
    left += side.area[node] / area * (entry(side.velocity, node) - rigid).squaredNorm();
  }
  motion.residual = std::sqrt(left);
  return motion;
}

std::vector<int> nodes_in_ring(const ContactSide& side, const Vector& centre, double inner, double outer) {
  std::vector<int> nodes;
  if (side.velocity.empty()) return nodes;  // the results do not have it
  for (std::size_t i = 0; i < side.nodes.size(); ++i) {
    const double distance = (entry(side.position, i) - centre).norm();
    if (distance >= inner && distance <= outer) nodes.push_back(static_cast<int>(i));
  }
  return nodes;
}

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
