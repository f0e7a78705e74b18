#include "modes/mode_unknowns.hpp"

#include <Eigen/Eigenvalues>

#include "model/host_copy.hpp"

namespace railwave {

ModeUnknowns::ModeUnknowns(StaticUnknowns rows, const NodeArrays& nodes, const std::shared_ptr<BeamModel>& beams)
    : rows_(std::move(rows)), free_(rows_.rows()) {
  std::vector<double> inertia = to_vector(nodes.mass), mass;
  if (beams)
    for (double value : to_vector(beams->arrays.inertia)) inertia.push_back(value);
  for (int row = 0; row < rows_.rows(); ++row) {
    if (rows_.follows(row)) continue;
    Free& free = free_[row];
    free.first = count_;
    free.size = 3;
    if (const double* p = rows_.projection(row)) {
      const Eigen::Matrix3d projection = Eigen::Map<const Eigen::Matrix3d>(p);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(projection);
      free.size = static_cast<int>((axes.eigenvalues().array() > 0.5).count());
      free.directions = axes.eigenvectors().rowwise().reverse();
    }
    count_ += free.size;
    mass.insert(mass.end(), free.size, inertia[row]);
  }
  mass_ = Eigen::Map<Eigen::VectorXd>(mass.data(), count_);
}

std::vector<Vec3> ModeUnknowns::places() const {
  std::vector<Vec3> result;
  const auto positions = rows_.positions();
  for (int row = 0; row < rows_.rows(); ++row)
    if (!rows_.follows(row)) result.insert(result.end(), free_[row].size, positions[row]);
  return result;
}

Eigen::VectorXd ModeUnknowns::motion(const Eigen::VectorXd& q) const {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * rows_.rows());
  for (int row = 0; row < rows_.rows(); ++row)
    each(row,
         [&](int first, const Shares& shares) { u.segment<3>(3 * row) += shares * q.segment(first, shares.cols()); });
  return u;
}

}  // namespace railwave
