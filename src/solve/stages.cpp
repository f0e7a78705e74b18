#include "solve/stages.hpp"

#include "kernels/contact_force.hpp"
#include "kernels/torque.hpp"
#include "model/patch_launch.hpp"
#include "solve/contact_window.hpp"

namespace railwave {
namespace {

NodeAdvance node_advance(const Model& model, double step) {
  // The first velocities are those at t = 0, half a step later than the scheme's own (thesis table 2.1).
  const Vec3& g = model.scene.gravity;
  return {model.nodes, {{g[0], g[1], g[2]}}, model.step == 0 ? 0.5 * step : step, step};
}

template <class S, class Hourglass, bool Advance>
void element_forces(const Model& model, const ElementGroup& group, const Array<float*>& scale, const Instant& instant) {
  using Force = PatchForce<S, Elastic, Hourglass, Advance>;
  const auto partial = [&] {
    if constexpr (sizeof(S) == sizeof(double)) return model.partial.wide;
    else return model.partial.narrow;
  }();
  launch_patches(group.patches, Force{{group.constants}, group.patches, scale, node_advance(model, instant.step), instant.step,
                                      partial, group.first_partial});
}

template <class S>
void element_forces(const Model& model, const ElementGroup& group, const Instant& instant) {
  const PatchArrays& patches = group.patches;
  const bool viscous = group.hourglass == scene::HourglassType::viscous;
  if (instant.settling) element_forces<S, StiffnessHourglass, false>(model, group, patches.settling_hourglass, instant);
  else if (viscous && instant.advancing) element_forces<S, ViscousHourglass, true>(model, group, patches.hourglass_scale, instant);
  else if (viscous) element_forces<S, ViscousHourglass, false>(model, group, patches.hourglass_scale, instant);
  else if (instant.advancing) element_forces<S, StiffnessHourglass, true>(model, group, patches.hourglass_scale, instant);
  else element_forces<S, StiffnessHourglass, false>(model, group, patches.hourglass_scale, instant);
}

Stage element_stage(Model& model, const ElementGroup& group) {
  const bool viscous = group.hourglass == scene::HourglassType::viscous;
  const bool wide = model.scene.solver.precision == scene::Precision::double_precision;
  const auto run = [&model, &group, wide](const Instant& instant) {
    if (wide) element_forces<double>(model, group, instant);
    else element_forces<float>(model, group, instant);
    model.patches_have_advanced = instant.advancing;
  };
  return {"elements of " + group.parts + (viscous ? ", viscous" : ", stiffness") + " hourglass control", run};
}

Stage set_motion_stage(const Model& model) {
  return {"mean motion of node sets", [&model](const Instant&) {
            Kokkos::parallel_for("set_motion", Team(model.sets.count, Kokkos::AUTO),
                                 SetMotion{model.sets, model.nodes.position, model.nodes.velocity});
          }};
}

void apply_load(const Model& model, const LoadArrays& load, const Instant& instant) {
  const double factor = curve_value(load.curve, instant.time);
  const NodeArrays& nodes = model.nodes;
  if (load.load->type == scene::LoadType::torque) {
    const Vec3& a = load.load->axis;
    const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const Vector3 axis{{a[0] / length, a[1] / length, a[2] / length}};
    Kokkos::parallel_for("torque", Team(1, Kokkos::AUTO),
                         Torque{model.extra, model.sets, nodes.position, nodes.velocity, load.set, load.first, axis,
                                factor * load.load->moment, instant.elapsed});
  } else if (load.load->type == scene::LoadType::pressure) {
    Kokkos::parallel_for("pressure", Range(0, load.count),
                         PressureLoad{model.extra, nodes.position, nodes.velocity, load.first, load.facets,
                                      factor * load.load->pressure, instant.elapsed});
  } else {
    Kokkos::parallel_for("dead_load", Range(0, load.count),
                         DeadLoad{model.extra, nodes.velocity, load.first, load.amplitude, factor, instant.elapsed});
  }
}

Stage load_stage(const Model& model, const LoadArrays& load) {
  return {"load " + load.load->name, [&model, &load](const Instant& instant) { apply_load(model, load, instant); }};
}

Stage connector_stage(const Model& model) {
  return {"connectors", [&model](const Instant& instant) {
            const ConnectorStage& stage = model.connectors;
            Kokkos::parallel_for("connector_force", Range(0, stage.arrays.count),
                                 ConnectorForce{stage.arrays, model.sets, instant.elapsed, instant.settling ? 0.0 : 1.0});
            Kokkos::parallel_for("connector_contribution", Range(0, stage.connector.extent(0)),
                                 ConnectorContribution{model.extra, stage.arrays, stage.first, stage.connector, stage.share});
          }};
}

Stage gather_extra_stage(const Model& model) {
  return {"gather of extra forces", [&model](const Instant&) {
            Kokkos::parallel_for("gather_extra_force", Range(0, model.extra.row_count), GatherExtraForce{model.extra});
          }};
}

template <bool Friction>
Stage contact_stage(Model& model, ContactPair& pair) {
  const bool first = &pair == &model.contacts.front();
  return {"contact " + pair.contact->name + (Friction ? ", friction" : ", frictionless"),
          [&model, &pair, first](const Instant& instant) {
            // The node update leaves the sum cleared; settling, and forces computed twice at one instant, do not.
            if (first && model.contact_uncleared) Kokkos::deep_copy(ExecutionSpace(), model.extra.sum.contact, 0ULL);
            model.contact_uncleared = true;
            keep_window(model, pair, instant);
            Kokkos::parallel_for("contact_force", ContactRange(0, pair.window.count),
                                 ContactForce<Friction>{ContactSearch{{pair.arrays, model.nodes.position}}, pair.window,
                                                        model.extra.sum, model.nodes.extra});
          }};
}

}  // namespace

std::vector<Stage> force_stages(Model& model) {
  std::vector<Stage> stages;
  if (model.sets.count > 0) stages.push_back(set_motion_stage(model));
  for (const LoadArrays& load : model.loads) stages.push_back(load_stage(model, load));
  if (model.connectors.arrays.count > 0) stages.push_back(connector_stage(model));
  if (model.extra.row_count > 0) stages.push_back(gather_extra_stage(model));
  for (ContactPair& pair : model.contacts)
    stages.push_back(pair.arrays.friction > 0 ? contact_stage<true>(model, pair) : contact_stage<false>(model, pair));
  // Last: its patches may move their nodes at once, where all else must still find them.
  for (const ElementGroup& group : model.elements) stages.push_back(element_stage(model, group));
  return stages;
}

void advance(Model& model, double step) {
  const NodeUpdate update{model.acceleration(), node_advance(model, step),
                          model.patches_have_advanced ? model.listed_nodes : Array<int*>()};
  const int count = model.patches_have_advanced ? static_cast<int>(model.listed_nodes.extent(0)) : model.nodes.count;
  Kokkos::parallel_for("node_update", Range(0, count), update);
  model.patches_have_advanced = false;
  ++model.step;
  model.velocity_lag = 0.5 * step;
  model.contact_uncleared = false;
}

}  // namespace railwave
