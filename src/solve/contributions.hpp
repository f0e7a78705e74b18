#pragma once

#include "kernels/contact_force.hpp"
#include "kernels/set_loads.hpp"
#include "solve/contact_window.hpp"
#include "solve/stages.hpp"

namespace railwave {

/// Whether the sets of connectors and torques are few enough for one team, which spares launches; and with them the
/// rows that feel these.
bool few_sets(const Model& model);
bool few_rows(const Model& model);

/// What contact's springs and sets of nodes do goes in one launch with the elements: on a device, where nobody looks at
/// the parts, and where such elements take every step. Not springs of any law but the plain one.
bool go_together(const Model& model, const Instant& instant);

/// The same of the sets. Nodes at paces of their own do not work out their own loads.
bool sets_go_along(const Model& model, const Instant& instant);

/// Gather of the loads' contributions at the nodes.
RowLoads row_loads(const Model& model, double elapsed);

/// Sets of nodes that move as one, connectors and torques.
SetLoads set_loads(const Model& model, const Instant& instant);

/// A pair's law, where that is not the plain one.
ContactLaw contact_law(const Model& model, const ContactPair& pair, const Instant& instant);

template <bool Friction, class Normals = FacetNormals, class Law = PlainContactLaw>
ContactForce<Friction, Law, Normals> contact_force(const Model& model, const ContactPair& pair, const Instant& instant,
                                                   const Law& law = {}) {
  return {ContactSearch{{pair.arrays, model.nodes.position}},
          pair.window,
          model.extra.sum,
          model.nodes.extra,
          first_touch(model, instant),
          law};
}

}  // namespace railwave
