#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "kernels/statics/static_solve.hpp"
#include "model/beams/beams.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/ties.hpp"
#include "model/nodal_state.hpp"

namespace railwave {

/// The unknowns of a static equilibrium: a displacement of each node, then a rotation of each beam node, rows of a
/// NodeVector. Slaves of ties follow their masters, nodes of non-reflecting ends are held: neither has unknowns of its
/// own, and in forces and preconditioned vectors their rows are zero.
class StaticUnknowns {
 public:
  StaticUnknowns(const NodalState& nodal, const Ties& ties, const NonReflectingEnds& ends,
                 const std::shared_ptr<BeamModel>& beams);

  int nodes() const { return nodes_.count; }
  int rows() const { return rows_; }
  int rotations() const { return rows_ - nodes(); }
  /// m, of each row now; of a rotation that of its node
  std::vector<Vec3> positions() const;

  /// I - sum d d^T of a row's held directions, by rows; null: free.
  const double* projection(int row) const { return row_of_[row] < 0 ? nullptr : table_[row_of_[row]].data(); }
  const HeldRows& held() const { return held_; }

  /// A row's small motion is the sum of these shares of other rows' motions; of all but slaves the row's own.
  struct Lead {
    int row;
    Eigen::Matrix3d share;
  };
  template <class Visit>
  void each_lead(int row, const Visit& visit) const {
    if (slave_[row] < 0)
      visit(Lead{row, Eigen::Matrix3d::Identity()});
    else
      for (const Lead& lead : leads_[slave_[row]]) visit(lead);
  }
  bool follows(int row) const { return slave_[row] >= 0; }

  /// Fills the slaves' rows of a motion.
  void lead_slaves(const NodeVector& motion) const;
  /// Adds the slaves' rows of forces to their masters'.
  void pass_on(const NodeVector& force) const;

 private:
  void hold(const NodalState& nodal, const NonReflectingEnds& ends);

  const NodeArrays& nodes_;
  const TieArrays& ties_;
  const BeamModel* beams_;  ///< null: none
  int rows_ = 0;
  std::vector<int> row_of_;  ///< of the table, by row; -1: free
  std::vector<std::array<double, 9>> table_;
  HeldRows held_;
  std::vector<int> slave_;                  ///< by row, -1: none
  std::vector<std::array<Lead, 4>> leads_;  ///< by slave, as it lay when this was made
};

}  // namespace railwave
