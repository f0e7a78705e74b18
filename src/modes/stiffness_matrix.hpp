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
std::vector<ElementStiffness> mode_stiffness(const Model& model);

/// Connectors and beams.
SpringCollector mode_springs(const Model& model);

/// @param most springs with no more unknowns than this become full blocks
StiffnessMatrix stiffness_matrix(const Model& model, const ModeUnknowns& unknowns, const SpringCollector& springs,
                                 int most = 48);

}  // namespace railwave
