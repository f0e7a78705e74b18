#include "solve/tasks/contributions.hpp"

#include "model/contact/contact_law.hpp"

namespace railwave {

bool contact_goes_along(const std::vector<ElementGroup>& groups, const std::vector<ContactPair>& contacts,
                        StepKind kind) {
  if (!on_device || kind != StepKind::advancing || contacts.size() != 1) return false;
  const ContactPair& pair = contacts.front();
  if (!is_linear(pair.law)) return false;
  // Multipliers come later, and must predict what loads do to their nodes.
  return groups.front().level == 0 && (pair.has_springs() || !pair.loaded);
}

bool sets_go_along(const NodalState& nodal, const NodeSets& sets) {
  return sets.moving > 0 && nodal.subcycling.levels == 1;
}

RowLoads row_loads(const NodalState& nodal, const LoadModel& loads, double elapsed) {
  const ConnectorArrays& connectors = loads.connectors.arrays;
  return {nodal.external,       connectors.count,     connectors.force, loads.torques,
          nodal.nodes.position, nodal.nodes.velocity, elapsed};
}

SetLoads set_loads(const NodalState& nodal, const LoadModel& loads, const Instant& instant, StepKind kind) {
  const SetMotion motion{loads.sets, nodal.nodes.position, nodal.nodes.velocity};
  TorqueNow torques{loads.torques};
  for (const LoadArrays& load : loads.loads)
    if (load.torque >= 0) torques.moment[load.torque] = instant.value_of(load);
  const ConnectorForce connectors{loads.connectors.arrays, instant.elapsed, kind == StepKind::settling ? 0.0 : 1.0};
  return {motion, connectors, torques, row_loads(nodal, loads, instant.elapsed), loads.set_teams};
}

FirstTouch first_touch(const NodalState& nodal, double elapsed) {
  return {{nodal.nodes.velocity, elapsed}, static_cast<double>(1L << (nodal.subcycling.levels - 1))};
}

}  // namespace railwave
