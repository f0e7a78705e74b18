#pragma once

#include "model/elements/carriers.hpp"
#include "solve/plan.hpp"

namespace railwave {

/// Step of the nodes from the present instant: positions by a step, velocities from their instant, half a step back (at
/// the start: none, thesis table 2.1), to half a step ahead.
NodeAdvance node_advance(const Model& model, double step);

/// How a plan evaluates a group of elements.
struct ElementLaunch {
  StepKind kind;
  bool with_contact = false;  ///< contact's springs in the same launch
  bool with_sets = false;     ///< and sets of nodes that move as one, connectors and torques
};

/// Forces of a group's elements at an instant, to `model.partial`, or to the nodes themselves where blocks may move
/// them.
/// @tparam S number type of the elements
/// @tparam Nodes how nodes are kept and moved: NodeAdvance or CarriedAdvance
template <class S, class Nodes>
void element_forces(const Model& model, const ElementGroup& group, const Instant& instant, const ElementLaunch& launch);

/// The same of one material. Defined in solve/tasks/element_forces_of.hpp; each of `Materials` and each pair of number
/// and nodes has a source file of its own, which CMake writes from solve/tasks/element_forces_of.cpp.in: their kernels
/// take compilers long.
template <class S, class Nodes, class Material>
void element_forces_of(const Model& model, const ElementGroup& group, const Instant& instant,
                       const ElementLaunch& launch);

}  // namespace railwave
