#pragma once

#include <map>
#include <memory>

#include "solve/statics/coarse_factors.hpp"
#include "solve/statics/static_tangent.hpp"

namespace railwave {

/// Rigid motions of aggregates of nodes, in which the slow modes that a diagonal can't reach are solved exactly: E =
/// Z^T K Z, sparse, factored on the host. An aggregate is the nodes of a compact group of elements of one part; nodes
/// of no element and rotations are aggregates of their own. Slaves of ties go with their masters' aggregates.
class StaticCoarse {
 public:
  StaticCoarse(const Assembly& assembly, const Array<double* [3]>& position, const StaticTangent& tangent);

  /// Adds the springs to the elements' part of E and factors it. Throws std::runtime_error where a pivot vanishes.
  void factor(const SpringCollector& springs);

  /// z = B^-1 r + Z E^-1 Z^T r
  void precondition(const NodeVector& r, const NodeVector& z) const;

  int aggregates() const { return count_; }

 private:
  static constexpr int modes = CoarseModes::of_aggregate;
  using Block = CoarseFactors::Block;
  using Blocks = CoarseFactors::Blocks;

  void divide_nodes(const Assembly& assembly);
  void divide(const std::vector<CornerNodes>& elements, const std::vector<Vec3>& middle, std::vector<int>& order,
              int begin, int end, int largest);
  void lay_modes();
  void lay_slaves();
  bool is_inside(const CornerNodes& corners) const;
  void add_elements(const Assembly& assembly, const Array<double* [3]>& position);
  void add_springs(const SpringCollector& springs, Blocks& blocks) const;

  /// What an aggregate's rigid motions are at a row: mode m along i is entry 3 m + i.
  using RowModes = std::array<double, 3 * modes>;
  struct Motion {
    int aggregate;
    const RowModes* mode;
  };
  template <class Visit>
  void each_motion(int row, const Visit& visit) const;

  /// What an element has of E, and what is needed to find it.
  struct ElementPart {
    struct CornerMotion {
      int corner;
      Motion motion;
    };
    struct PlacedBlock {
      std::pair<int, int> place;  ///< as in Blocks
      Block block;
    };
    std::vector<CornerMotion> motions;
    std::vector<int> touched;  ///< aggregates
    std::vector<PlacedBlock> blocks;
  };
  void find_blocks(const CornerNodes& corners, const ElementStiffness& stiffness,
                   const Array<double* [3]>::HostMirror& place, ElementPart& found) const;

  const StaticTangent& tangent_;
  const StaticUnknowns& unknowns_;
  int count_ = 0;
  std::vector<int> aggregate_;                     ///< by row
  std::vector<RowModes> mode_;                     ///< by row; zero along held directions
  std::map<int, std::map<int, RowModes>> slaves_;  ///< by row and aggregate
  std::vector<double> unused_;                     ///< by coarse coordinate: 1 where the aggregate has no such motion
  Blocks of_elements_;
  CoarseModes on_device_;
  Array<double*> coarse_;
  std::unique_ptr<CoarseFactors> factors_;
};

}  // namespace railwave
