#include "post/rigid_motion.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace railwave {
namespace {

Eigen::Matrix3d cross_matrix(const Vector& r) {
  Eigen::Matrix3d matrix;
  matrix << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0;
  return matrix;
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
  for (std::size_t i = 0; i < side.nodes.size(); ++i) {
    const double distance = (entry(side.position, i) - centre).norm();
    if (distance >= inner && distance <= outer) nodes.push_back(static_cast<int>(i));
  }
  return nodes;
}

}  // namespace railwave
