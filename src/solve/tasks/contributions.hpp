#pragma once

#include "kernels/contact/contact_force.hpp"
#include "kernels/loads/set_loads.hpp"
#include "solve/tasks.hpp"

namespace railwave {

/// Contact's springs go in one launch with the first group's elements: on a device, in advancing steps, and where such
/// elements take every step. Springs of the linear penalty alone.
bool contact_goes_along(const std::vector<ElementGroup>& groups, const std::vector<ContactPair>& contacts,
                        StepKind kind);

/// The same of the sets, where contact does. Subcycled nodes do not work out their own loads.
bool sets_go_along(const NodalState& nodal, const NodeSets& sets);

/// Gather of the loads' contributions at the nodes.
RowLoads row_loads(const NodalState& nodal, const LoadModel& loads, double elapsed);

/// Sets of nodes that move as one, connectors and torques.
SetLoads set_loads(const NodalState& nodal, const LoadModel& loads, const Instant& instant, StepKind kind);

/// What a node that begins to touch is judged by.
/// @param elapsed s since the instant before
FirstTouch first_touch(const NodalState& nodal, double elapsed);

/// Contact's springs at an instant, by a law of kernels/contact/laws/.
/// @param state of a law that has one, by slave node
template <bool Friction, class Normals = FacetNormals, class Law>
ContactForce<Friction, Law, Normals> contact_force(const NodalState& nodal, const ContactPair& pair,
                                                   const Instant& instant, const Law& law,
                                                   const Array<double*>& state) {
  LawAtNodes<Law, Normals> at_nodes{law, {}};
  if constexpr (at_nodes.has_state) at_nodes.arrays = {state, nodal.nodes.mass};
  return {ContactSearch{{pair.arrays, nodal.nodes.position}},
          pair.window,
          nodal.external.sum,
          nodal.nodes.external_row,
          first_touch(nodal, instant.elapsed),
          at_nodes};
}

}  // namespace railwave
