#pragma once

#include <memory>
#include <vector>

#include "kernels/statics/tangent.hpp"
#include "model/assembled_scene.hpp"
#include "model/ranks/transport.hpp"

namespace railwave {

/// Products of the elements' stiffness with displacements, which ranks compute together while rank 0 searches the
/// static equilibrium. Each rank has a range of nodes with all elements around them, so that forces on its nodes are
/// added in the order of one process: products are bit for bit those of TangentOperator. On processors.
class StaticParts {
 public:
  static constexpr bool possible = !on_device;

  /// Rank 0's side. The others must wait for its orders.
  StaticParts(const AssembledScene& assembled, Transport& transport);
  /// The others go on.
  ~StaticParts();
  StaticParts(const StaticParts&) = delete;
  StaticParts& operator=(const StaticParts&) = delete;

  /// The present places, m, about which products are from now on.
  void place(const NodeVector& position);
  /// f = K u of all nodes. Rows of the vectors behind these stay as they are.
  void apply(const NodeVector& u, const NodeVector& f);

  struct Part;

 private:
  /// Rows that a rank needs: its own range of nodes, then others of its elements.
  struct Rows {
    int first, count;
    std::vector<int> others;
    std::vector<double> packed;
  };

  static void pack(const Rows& rows, const NodeVector& vector, double* to);
  /// To each rank the rows that it needs, and those of rank 0 to its own vector.
  void send(const NodeVector& vector, const NodeVector& own);

  Transport& transport_;
  std::vector<Rows> rows_;  ///< by rank
  std::unique_ptr<Part> own_;
};

/// The side of another rank, after RankOrder::settle, until rank 0 needs no more products.
void follow_static_parts(Transport& transport);

}  // namespace railwave
