#include "solve/stages.hpp"

#include "kernels/contact_force.hpp"
#include "kernels/torque.hpp"
#include "solve/contact_window.hpp"

namespace railwave {
namespace {

template <class Hourglass>
void element_forces(const Model& model, const ElementSet& set, const Array<double*>& scale, double step) {
  ElementArrays arrays = set.arrays;
  arrays.hourglass_scale = scale;
  Kokkos::parallel_for("element_force", Range(0, arrays.batch_count()),
                       ElementForce<Hourglass>{set.constants, step, arrays, model.nodes.position, model.nodes.reference,
                                               model.nodes.velocity, model.corner_force});
}

Stage element_stage(const Model& model, const ElementSet& set) {
  const bool viscous = set.hourglass == scene::HourglassType::viscous;
  const auto run = [&model, &set, viscous](const Instant& instant) {
    if (instant.settling) element_forces<StiffnessHourglass>(model, set, set.settling_hourglass, 0);
    else if (viscous) element_forces<ViscousHourglass>(model, set, set.arrays.hourglass_scale, instant.step);
    else element_forces<StiffnessHourglass>(model, set, set.arrays.hourglass_scale, instant.step);
  };
  return {"elements of " + set.part + (viscous ? ", viscous" : ", stiffness") + " hourglass control", run};
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
  return {"contact " + pair.contact->name + (Friction ? ", friction" : ", frictionless"),
          [&model, &pair](const Instant&) {
            keep_window(model, pair);
            const ContactSearch search{pair.arrays, model.nodes.position};
            Kokkos::parallel_for("contact_force", Range(0, pair.window.slave_count),
                                 ContactForce<Friction>{search, pair.window, model.extra, model.nodes.extra});
            Kokkos::parallel_for("contact_gather", Range(0, pair.window.master_count),
                                 ContactGather{pair.arrays, pair.window, model.extra, model.nodes.extra});
          }};
}

}  // namespace

std::vector<Stage> force_stages(Model& model) {
  std::vector<Stage> stages;
  for (const ElementSet& set : model.elements) stages.push_back(element_stage(model, set));
  if (model.sets.count > 0) stages.push_back(set_motion_stage(model));
  for (const LoadArrays& load : model.loads) stages.push_back(load_stage(model, load));
  if (model.connectors.arrays.count > 0) stages.push_back(connector_stage(model));
  if (model.extra.row_count > 0) stages.push_back(gather_extra_stage(model));
  for (ContactPair& pair : model.contacts)
    stages.push_back(pair.arrays.friction > 0 ? contact_stage<true>(model, pair) : contact_stage<false>(model, pair));
  return stages;
}

void advance(Model& model, double step) {
  // The first velocities are those at t = 0, half a step later than the scheme's own (thesis table 2.1).
  const double velocity_step = model.step == 0 ? 0.5 * step : step;
  Kokkos::parallel_for("node_update", Range(0, model.nodes.count), NodeUpdate{model.acceleration(), velocity_step, step});
  ++model.step;
  model.velocity_lag = 0.5 * step;
}

}  // namespace railwave
