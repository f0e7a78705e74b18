#include "solve/tasks/contributions.hpp"

#include "model/contact/contact_law.hpp"

namespace railwave {

bool few_sets(const Model& model) {
  constexpr int most_sums = 2048;
  return model.sets.moving * NodeSets::values <= most_sums;
}

bool few_rows(const Model& model) {
  constexpr int most_rows = 4096;
  return few_sets(model) && model.extra.loaded_count <= most_rows;
}

bool contact_goes_along(const Model& model, StepKind kind) {
  if (!on_device || kind != StepKind::advancing || model.contacts.size() != 1) return false;
  if (!is_linear(model.contacts.front().law)) return false;
  // Multipliers come later, and must predict what loads do to their nodes.
  return model.elements.front().level == 0 && (model.contacts.front().has_springs() || !model.contacts.front().loaded);
}

bool sets_go_along(const Model& model, StepKind kind) {
  // Ties and non-reflecting ends must find the loads where they add to them.
  const bool added_to = model.ties.arrays.active() || model.ends.arrays.count > 0;
  return contact_goes_along(model, kind) && model.sets.moving > 0 && few_sets(model) && model.subcycling.levels == 1 &&
         model.prescribed.empty() && !added_to;
}

RowLoads row_loads(const Model& model, double elapsed) {
  return {model.extra, model.connectors.arrays, model.torques, model.nodes.position, model.nodes.velocity, elapsed};
}

SetLoads set_loads(const Model& model, const Instant& instant, StepKind kind, int rows) {
  const SetMotion motion{model.sets, model.nodes.position, model.nodes.velocity};
  TorqueNow torques{model.torques, motion};
  for (const LoadArrays& load : model.loads)
    if (load.torque >= 0) torques.moment[load.torque] = curve_value(load.curve, instant.time) * load.load->moment;
  const ConnectorForce connectors{model.connectors.arrays, motion, instant.elapsed,
                                  kind == StepKind::settling ? 0.0 : 1.0};
  return {motion, connectors, torques, row_loads(model, instant.elapsed), rows};
}

}  // namespace railwave
