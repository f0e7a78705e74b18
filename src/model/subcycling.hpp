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

/// Level of each element of an assembly, by its own stable step against the one used: 2^level steps leave it a margin,
/// and regions of different levels have a buffer between them. Empty where subcycling would not pay.
std::vector<int> element_levels(const scene::Scene& scene, const Assembly& assembly);

/// Lines that tell how many elements are of which level, and what that saves; none without subcycling.
std::vector<std::string> describe_subcycling(const scene::Scene& scene, const Subcycling& subcycling);

}  // namespace railwave
