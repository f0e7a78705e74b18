#pragma once

#include <vector>

#include "kernels/statics/static_solve.hpp"
#include "model/assembled_scene.hpp"
#include "model/time_step/tangent_operator.hpp"
#include "model/time_step/tangent_springs.hpp"
#include "solve/ranks/static_parts.hpp"
#include "solve/statics/static_unknowns.hpp"

namespace railwave {

/// The scene's stiffness about its present place, as an operator on displacements: elements (linear elastic, with the
/// stiffness hourglass control that they have while settling), connectors, beams and the contact springs that press,
/// T^T K T with ties u = T u_masters. Always in double. A small multiple of the diagonal is added, so that what nothing
/// holds has an answer all the same.
class StaticTangent {
 public:
  /// @param parts of ranks that multiply the elements' stiffness together; null: there is one process
  StaticTangent(const AssembledScene& assembled, const NodeArrays& nodes, const StaticUnknowns& unknowns,
                StaticParts* parts = nullptr);

  /// Connectors, beams and contact springs as they are now; lays out the preconditioner's blocks.
  /// @param shift share of the diagonal that is added
  void set_springs(const SpringCollector& springs, double shift);

  /// f = (P T^T K T P + shift D) u, for u without parts along held directions; its slaves' rows are filled.
  void apply(const NodeVector& u, const NodeVector& f) const;

  double shift() const { return shift_; }
  /// N/m, by row: a mean of its own block.
  const Array<double*>::HostMirror& diagonal() const { return diagonal_; }
  /// Inverses of the diagonal blocks, held directions taken out.
  const NodeBlocks& inverse_blocks() const { return inverse_; }

  const StaticUnknowns& unknowns() const { return unknowns_; }
  const ElementStiffness& stiffness_of(int element) const { return stiffness_[part_of_element_[element]]; }

 private:
  const Assembly& assembly_;
  const NodeArrays& nodes_;
  const StaticUnknowns& unknowns_;
  StaticParts* const parts_;
  TangentOperator tangent_;
  double shift_ = 0;
  std::vector<ElementStiffness> stiffness_;  ///< by part
  std::vector<int> part_of_element_;
  std::vector<std::array<double, 6>> element_blocks_;
  Array<double*> device_diagonal_;
  NodeBlocks inverse_;
  // Kept, as fresh memory takes longer than what is written to it.
  Array<double*>::HostMirror diagonal_;
  NodeBlocks::HostMirror inverse_on_host_;
};

}  // namespace railwave
