#include "model/build_steps.hpp"
#include "model/elements/materials.hpp"

namespace railwave {

std::vector<std::string> what_is_left_out(const scene::Scene& scene) {
  std::vector<std::string> left_out = materials_left_out(scene);
  const auto note = [&](bool absent, const char* what) {
    if (absent) left_out.emplace_back(what);
  };
  const scene::Precision precision = scene.solver.precision;
  note(precision == scene::Precision::mixed,
       "double precision of the elements: they are computed in single, nodes move in double");
  note(precision == scene::Precision::single_precision,
       "double precision of elements and nodes: nodes are kept in single as what their part's rigid motion at the "
       "start leaves "
       "of their motion; contact, loads, constraints, settling and the account are in double");
  bool any_damped = false, any_undamped = false;
  for (const auto& part : scene.parts) (part.damped() ? any_damped : any_undamped) = true;
  note(!any_damped && scene.absorbing_layers.empty(), "damping of parts");
  note((any_damped || !scene.absorbing_layers.empty()) && any_undamped,
       "damping of the other parts: their nodes and elements know nothing of it");
  note(scene.contacts.empty(), "contact: the scene has none");
  bool any_frictionless = false;
  for (const auto& contact : scene.contacts) any_frictionless = any_frictionless || contact.friction == 0;
  note(any_frictionless, "friction: contacts with coefficient 0 use the frictionless kernel");
  note(scene.gravity == Vec3{0, 0, 0}, "gravity");
  note(scene.loads.empty(), "loads");
  note(scene.connectors.empty(), "springs and dashpots");
  note(scene.beams.empty(), "beams, and rotations of nodes");
  note(scene.constraints.empty(), "constraints");
  note(scene.prescribed_motions.empty(), "prescribed motion");
  note(scene.non_reflecting.empty(), "non-reflecting ends");
  note(scene.absorbing_layers.empty(), "absorbing layers");
  note(scene.ties.empty(), "ties between meshes");
  note(!scene.settle.active, "settling: the run starts from the undeformed mesh");
  note(!scene.monitor.active, "the monitor: faults are not looked for, but for values that are not finite");
  bool any_viscous = false;
  for (const auto& part : scene.parts) any_viscous = any_viscous || part.hourglass == scene::HourglassType::viscous;
  note(!any_viscous, "viscous hourglass control: element kernels read no velocities");
  return left_out;
}

}  // namespace railwave
