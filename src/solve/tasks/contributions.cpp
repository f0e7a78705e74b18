#include "solve/tasks/contributions.hpp"

#include "model/contact/contact_law.hpp"

namespace railwave {

bool few_sets(const NodeSets& sets) {
  constexpr int most_sums = 2048;
  return sets.moving * NodeSets::values <= most_sums;
}

bool few_rows(const NodeSets& sets, const ExternalForces& external) {
  constexpr int most_rows = 4096;
  return few_sets(sets) && external.loaded_count <= most_rows;
}

bool contact_goes_along(const std::vector<ElementGroup>& groups, const std::vector<ContactPair>& contacts,
                        StepKind kind) {
  if (!on_device || kind != StepKind::advancing || contacts.size() != 1) return false;
  const ContactPair& pair = contacts.front();
  if (!is_linear(pair.law)) return false;
  // Multipliers come later, and must predict what loads do to their nodes.
  return groups.front().level == 0 && (pair.has_springs() || !pair.loaded);
}

bool sets_go_along(const NodalState& nodal, const NodeSets& sets) {
  return sets.moving > 0 && few_sets(sets) && nodal.subcycling.levels == 1;
}

RowLoads row_loads(const NodalState& nodal, const LoadModel& loads, double elapsed) {
  return {nodal.external, loads.connectors.arrays, loads.torques, nodal.nodes.position, nodal.nodes.velocity, elapsed};
}

SetLoads set_loads(const NodalState& nodal, const LoadModel& loads, const Instant& instant, StepKind kind, int rows) {
  const SetMotion motion{loads.sets, nodal.nodes.position, nodal.nodes.velocity};
  TorqueNow torques{loads.torques, motion};
  for (const LoadArrays& load : loads.loads)
    if (load.torque >= 0) torques.moment[load.torque] = instant.value_of(load);
  const ConnectorForce connectors{loads.connectors.arrays, motion, instant.elapsed,
                                  kind == StepKind::settling ? 0.0 : 1.0};
  return {motion, connectors, torques, row_loads(nodal, loads, instant.elapsed), rows};
}

FirstTouch first_touch(const NodalState& nodal, double elapsed) {
  return {{nodal.nodes.velocity, elapsed}, static_cast<double>(1L << (nodal.subcycling.levels - 1))};
}

}  // namespace railwave
