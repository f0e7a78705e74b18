#include "post/equivalent_ellipse.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {

EquivalentEllipse equivalent_ellipse(const ContactSide& side, const std::vector<int>& nodes,
                                     const std::vector<double>& forces, const LocalFrame& frame) {
  double sum = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Eigen::Vector2d place = frame.place(entry(side.position, nodes[i])).head<2>();
    sum += forces[i];
    mean += forces[i] * place;
    moments += forces[i] * place * place.transpose();
  }
  EquivalentEllipse ellipse;
  if (!(sum > 0)) return ellipse;
  mean /= sum;
  moments = moments / sum - mean * mean.transpose();
  // Half the angle at which the mixed moment vanishes, taken such that the first axis is the one nearer to
  // longitudinal.
  const double difference = moments(0, 0) - moments(1, 1), mixed = 2 * moments(0, 1);
  const double size = std::hypot(difference, mixed);
  const bool first_is_larger = difference >= 0;
  const double half_sum = 0.5 * (moments(0, 0) + moments(1, 1));
  const double larger = half_sum + 0.5 * size, smaller = std::max(0.0, half_sum - 0.5 * size);
  ellipse.semi_axis_along = std::sqrt(5 * (first_is_larger ? larger : smaller));
  ellipse.semi_axis_across = std::sqrt(5 * (first_is_larger ? smaller : larger));
  if (size > 1e-12 * half_sum) ellipse.turn = 0.5 * std::atan2(first_is_larger ? mixed : -mixed, std::fabs(difference));
  return ellipse;
}

}  // namespace railwave
