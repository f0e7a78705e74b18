#pragma once

#include "modes/stiffness_matrix.hpp"

namespace railwave {

/// Strain energy of small motions, as a sum of squares of strains: that of a rigid motion is zero to the square of
/// rounding, where u.K u would be zero to rounding only and hide a body's slow motions on soft springs.
class StrainEnergy {
 public:
  StrainEnergy(const Model& model, const SpringCollector& springs);

  /// J, of each part and, behind them, of connectors and beams together.
  /// @param motion of all rows, 3 values each (ModeUnknowns::motion)
  /// @param hourglass when given, receives what of that is in each part's hourglass control, J
  std::vector<double> operator()(const Eigen::VectorXd& motion, std::vector<double>* hourglass = nullptr) const;

 private:
  const Model& model_;
  const SpringCollector& springs_;
  std::vector<ElementStiffness> stiffness_;
  Array<double* [3]>::HostMirror position_;
};

}  // namespace railwave
