#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"
#include "kernels/nodes/subcycled_nodes.hpp"
#include "model/assembly.hpp"

namespace railwave {

/// How a model is subcycled; see kernels/nodes/subcycled_nodes.hpp.
struct Subcycling {
  int levels = 1;  ///< 1: every element takes every step
  SubcycleLevels node_levels;
  std::vector<int> shared_end;  ///< by level: how many of the model's shared nodes are of it or finer
  std::vector<long> elements;   ///< by level

  /// Steps from one instant at which everything is in phase to the next.
  long cycle() const { return 1L << (levels - 1); }
  bool in_phase(long step) const { return step % cycle() == 0; }
  /// The coarsest level that is evaluated at a step.
  int phase(long step) const;
  /// By what factor element updates fall.
  double gain() const;
};

/// Subcycling level of each element: 2^level steps of the run stay below the element's own stable step by a margin, and
/// buffer layers separate regions of different levels. Empty where subcycling would not pay.
std::vector<int> element_levels(const scene::Scene& scene, const Assembly& assembly);

/// One line per subcycling level with its element count, then the saving. Empty unless the case asks for subcycling.
std::vector<std::string> describe_subcycling(const scene::Scene& scene, const Subcycling& subcycling);

}  // namespace railwave
