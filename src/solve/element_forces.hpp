#pragma once

#include "model/carriers.hpp"
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

/// Forces of a group's elements at an instant, to `model.partial`, or to the nodes themselves where patches may move
/// them. Each pair of types has a source file of its own (element_forces_double.cpp, ...): their kernels take compilers
/// long.
/// @tparam S number type of the elements
/// @tparam Nodes how nodes are kept and moved: NodeAdvance or CarriedAdvance
template <class S, class Nodes>
void element_forces(const Model& model, const ElementGroup& group, const Instant& instant, const ElementLaunch& launch);

extern template void element_forces<double, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                         const ElementLaunch&);
extern template void element_forces<float, NodeAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                        const ElementLaunch&);
extern template void element_forces<float, CarriedAdvance>(const Model&, const ElementGroup&, const Instant&,
                                                           const ElementLaunch&);

}  // namespace railwave
