#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/beams/beams.hpp"
#include "solve/statics/static_unknowns.hpp"

namespace railwave {

/// The free directions of a model's rows (displacements of nodes, rotations where beams end) as one vector q: a row
/// moves by u = sum over its leads of share B q, B the orthonormal free directions of the lead. Held directions have no
/// q; slaves of ties have none of their own.
class ModeUnknowns {
 public:
  /// @param rows with their constraints and ties
  /// @param beams null in a scene without beams
  ModeUnknowns(StaticUnknowns rows, const NodeArrays& nodes, const std::shared_ptr<BeamModel>& beams);

  int count() const { return count_; }
  int rows() const { return rows_.rows(); }
  int nodes() const { return rows_.nodes(); }
  /// kg or kg m2, by q: the masses of a run, those of slaves on their masters.
  const Eigen::VectorXd& mass() const { return mass_; }
  /// m, by q: where its row is.
  std::vector<Vec3> places() const;

  /// visit(first, A) for each lead of a row that is free at all: A (3 rows) times q[first ...] is its part of the row's
  /// motion.
  template <class Visit>
  void each(int row, const Visit& visit) const {
    rows_.each_lead(row, [&](const StaticUnknowns::Lead& lead) {
      const Free& free = free_[lead.row];
      if (free.size > 0) visit(free.first, Shares(lead.share * free.directions.leftCols(free.size)));
    });
  }

  /// Motion of all rows, slaves included; 3 values each.
  Eigen::VectorXd motion(const Eigen::VectorXd& q) const;

  using Shares = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>;

 private:
  struct Free {
    int first = 0, size = 0;
    Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();  ///< columns
  };

  StaticUnknowns rows_;
  std::vector<Free> free_;
  int count_ = 0;
  Eigen::VectorXd mass_;
};

}  // namespace railwave
