#pragma once

#include "model/elements/relative_coordinates.hpp"
#include "solve/tasks.hpp"

namespace railwave {

/// Step of the nodes from the present instant: positions by a step, velocities from their instant, half a step back (at
/// the start: none, thesis table 2.1), to half a step ahead.
NodeAdvance node_advance(const NodalState& nodal, double step);

/// How a plan evaluates a group of elements.
struct ElementLaunch {
  StepKind kind;
  const ContactPair* contact = nullptr;  ///< whose springs are in the same launch
  const LoadModel* sets = nullptr;       ///< and these, that move as one, with their connectors and torques
  const Array<int*>* listed = nullptr;   ///< of the group's blocks those to compute; null: all
};

/// Forces of a group's elements at an instant, to `nodal.partial`, or to the nodes themselves where blocks may move
/// them. Defined in solve/tasks/element_forces_of.hpp; each of `Materials` and each pair of number and nodes has a
/// source file of its own, which CMake writes from solve/tasks/element_forces_of.cpp.in: their kernels take compilers
/// long.
/// @tparam S number type of the elements
/// @tparam Nodes how nodes are kept and moved: NodeAdvance or RelativeAdvance
/// @tparam Material that of the group
template <class S, class Nodes, class Material>
void element_forces_of(const NodalState& nodal, const ElementGroup& group, const Instant& instant,
                       const ElementLaunch& launch);

/// Damping forces of a damped group's elements at an instant, to their rows of `nodal.partial`.
/// @param in_single whether the elements are computed in single precision
/// @param listed of the group's blocks those to compute; null: all
void element_damping(const NodalState& nodal, const ElementGroup& group, bool in_single, const Instant& instant,
                     const Array<int*>* listed);

/// Of a group that is not evaluated at every step, one step after its evaluation: see BookDamping.
void book_damping(const NodalState& nodal, const ElementGroup& group, bool in_single, const Instant& instant);

}  // namespace railwave
