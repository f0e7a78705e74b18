#pragma once

#include <Eigen/SparseCore>

#include "model/time_step/tangent_springs.hpp"
#include "modes/mode_unknowns.hpp"

namespace railwave {

/// The stiffness of a model about its present place as a sparse matrix: elements (linear elastic, with stiffness
/// hourglass control), connectors and beams, T^T K T by the unknowns q.
struct StiffnessMatrix {
  /// Lower triangle. After the q come `extra` rows, one for each spring between many nodes, whose full block would be
  /// too dense: [[K, k s], [k s^T, -k]] is K + k s s^T for q, and has one negative eigenvalue more.
  Eigen::SparseMatrix<double> lower;
  int extra = 0;
};

/// Of each part, in order.
std::vector<ElementStiffness> mode_stiffness(const AssembledScene& assembled);

/// Connectors and beams.
SpringCollector mode_springs(const scene::Scene& scene, const std::vector<ConnectorCell>& cells,
                             const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes);

/// @param most springs with no more unknowns than this become full blocks
StiffnessMatrix stiffness_matrix(const AssembledScene& assembled, const NodeArrays& nodes, const ModeUnknowns& unknowns,
                                 const SpringCollector& springs, int most = 48);

/// Strain energy of small motions, as a sum of squares of strains: that of a rigid motion is zero to the square of
/// rounding, where u.K u would be zero to rounding only and hide a body's slow motions on soft springs.
class StrainEnergy {
 public:
  StrainEnergy(const AssembledScene& assembled, const NodeArrays& nodes, const SpringCollector& springs);

  /// J, of each part and, behind them, of connectors and beams together.
  /// @param motion of all rows, 3 values each (ModeUnknowns::motion)
  /// @param hourglass when given, receives what of that is in each part's hourglass control, J
  std::vector<double> operator()(const Eigen::VectorXd& motion, std::vector<double>* hourglass = nullptr) const;

 private:
  const Assembly& assembly_;
  const SpringCollector& springs_;
  std::vector<ElementStiffness> stiffness_;
  Array<double* [3]>::HostMirror position_;
};

}  // namespace railwave
