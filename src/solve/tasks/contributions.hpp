#pragma once

#include "kernels/contact/contact_force.hpp"
#include "kernels/loads/set_loads.hpp"
#include "solve/plan.hpp"
#include "solve/tasks/contact_window.hpp"

namespace railwave {

/// Whether the sets of connectors and torques are few enough for one team, which spares launches; and with them the
/// rows that feel these.
bool few_sets(const Model& model);
bool few_rows(const Model& model);

/// Contact's springs go in one launch with the first group's elements: on a device, in advancing steps, and where such
/// elements take every step. Springs of the linear penalty alone.
bool contact_goes_along(const Model& model, StepKind kind);

/// The same of the sets. Nodes at paces of their own do not work out their own loads.
bool sets_go_along(const Model& model, StepKind kind);

/// Gather of the loads' contributions at the nodes.
RowLoads row_loads(const Model& model, double elapsed);

/// Sets of nodes that move as one, connectors and torques.
/// @param rows how many loaded nodes gather their loads in the same launch
SetLoads set_loads(const Model& model, const Instant& instant, StepKind kind, int rows);

/// Contact's springs at an instant, by a law of kernels/contact/laws/.
/// @param state of a law that has one, by slave node
template <bool Friction, class Normals = FacetNormals, class Law>
ContactForce<Friction, Law, Normals> contact_force(const Model& model, const ContactPair& pair, const Instant& instant,
                                                   const Law& law, const Array<double*>& state) {
  LawAtNodes<Law, Normals> at_nodes{law, {}};
  if constexpr (at_nodes.has_state) at_nodes.arrays = {state, model.nodes.mass};
  return {ContactSearch{{pair.arrays, model.nodes.position}},
          pair.window,
          model.extra.sum,
          model.nodes.extra,
          first_touch(model, instant.elapsed),
          at_nodes};
}

}  // namespace railwave
