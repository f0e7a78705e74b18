#include "solve/monitor/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/contact/initial_overlap.hpp"

namespace railwave {
namespace {

/// Strain of a load's own making that no steel stands.
constexpr double much_strain = 0.05;

double length_of(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

int part_of_target(const scene::Scene& scene, const std::string& target) {
  const std::string name = target.substr(0, target.find('.'));
  for (std::size_t p = 0; p < scene.parts.size(); ++p)
    if (scene.parts[p].name == name) return static_cast<int>(p);
  return -1;
}

const scene::Material& material_of(const AssembledScene& assembled, int part) {
  return assembled.scene.materials[assembled.assembly.parts[part].material];
}

double largest_of(const scene::Curve* curve) {
  if (curve == nullptr || curve->type != scene::CurveType::table) return 1;
  double largest = 0;
  for (const auto& point : curve->points) largest = std::fmax(largest, std::fabs(point[1]));
  return largest;
}

void curves(const scene::Scene& scene, std::vector<Cause>& causes) {
  for (const scene::Curve& curve : scene.curves)
    for (const auto& point : curve.points)
      if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
        causes.push_back(
            Cause{"curve",
                  fmt::format("curve {} has a value that is no number: mend curves.{}", curve.name, curve.name), 100});
}

/// Speed of what begins or is made to move, m/s; its part's waves bound what a body can take.
void speeds(const scene::Scene& scene, const MonitorEvidence& evidence, std::vector<Cause>& causes) {
  const double limit = scene.monitor.speed;
  if (!(evidence.first.speed.value > limit)) return;
  std::string sources;
  for (const auto& motion : scene.initial_motions) sources += fmt::format(" initial_motion.{}", motion.name);
  for (const auto& motion : scene.prescribed_motions) sources += fmt::format(" prescribed_motion.{}", motion.name);
  causes.push_back(Cause{"speed",
                         fmt::format("bodies begin with {:.4g} m/s: see{} (velocity in m/s, angular_velocity in rad/s)",
                                     evidence.first.speed.value, sources),
                         85});
}

/// Strain that a load makes where it acts: its pressure over Young's modulus, or its force on a node over that and the
/// square of the elements there.
void load_causes(const AssembledScene& assembled, const std::vector<LoadArrays>& all, std::vector<Cause>& causes) {
  for (const LoadArrays& arrays : all) {
    const scene::Load& load = *arrays.load;
    const int part = part_of_target(assembled.scene, load.target);
    if (part < 0 || assembled.assembly.parts[part].element_count == 0) continue;
    const double modulus = material_of(assembled, part).youngs_modulus, factor = largest_of(arrays.curve);
    double stress = 0;
    if (load.type == scene::LoadType::pressure)
      stress = std::fabs(load.pressure);
    else if (load.type == scene::LoadType::traction)
      stress = length_of(load.traction);
    else {
      const auto nodes = assembled.assembly.node_sets.find(load.target);
      if (nodes == assembled.assembly.node_sets.end() || nodes->second.empty()) continue;
      Vec3 low = assembled.assembly.nodes[nodes->second[0]], high = low;
      for (int n : nodes->second)
        for (int i = 0; i < 3; ++i) {
          low[i] = std::fmin(low[i], assembled.assembly.nodes[n][i]);
          high[i] = std::fmax(high[i], assembled.assembly.nodes[n][i]);
        }
      const auto& range = assembled.assembly.parts[part];
      double size = 0;
      for (int e = range.first_element; e < range.first_element + range.element_count; ++e)
        size += assembled.element_length[e] / range.element_count;
      const double across = size + length_of({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
      const double force =
          load.type == scene::LoadType::torque ? std::fabs(load.moment) / across : length_of(load.force);
      stress = force / (size * size * static_cast<double>(nodes->second.size()));
    }
    const double strain = stress * factor / modulus;
    if (!(strain > much_strain)) continue;
    const bool pressure = load.type == scene::LoadType::pressure || load.type == scene::LoadType::traction;
    causes.push_back(
        Cause{"load",
              fmt::format("load {} strains the elements under it by about {:.3g}: see loads.{} ({}) and its curve",
                          load.name, strain, load.name,
                          pressure                               ? "Pa"
                          : load.type == scene::LoadType::torque ? "N m"
                                                                 : "N"),
              // What strains by its whole length no constraint would mend.
              (strain > 1 ? 76 : 70) + std::fmin(3, std::log10(strain / much_strain))});
  }
}

/// A body that a load drives and nothing holds: a contact that is apart does not.
void unheld(const scene::Scene& scene, const Fault& fault, const MonitorEvidence& evidence,
            std::vector<Cause>& causes) {
  if (fault.kind == FaultKind::hourglass_share || !(evidence.last.speed.value > scene.monitor.speed)) return;
  for (const scene::Load& load : scene.loads) {
    const int part = part_of_target(scene, load.target);
    if (part < 0) continue;
    const std::string& name = scene.parts[part].name;
    const auto concerns = [&](const std::string& target) { return target.substr(0, target.find('.')) == name; };
    bool held = false;
    for (const auto& one : scene.constraints) held = held || concerns(one.target);
    for (const auto& one : scene.connectors) held = held || concerns(one.from) || concerns(one.to);
    for (const auto& one : scene.ties) held = held || concerns(one.slave) || concerns(one.master);
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
      const auto& one = scene.contacts[c];
      held = held || ((concerns(one.slave) || std::any_of(one.master.begin(), one.master.end(), concerns)) &&
                      c < evidence.touching.size() && evidence.touching[c] > 0);
    }
    for (const auto& one : scene.beams) held = held || concerns(one.from) || concerns(one.to);
    for (const auto& one : scene.prescribed_motions) held = held || concerns(one.target);
    for (const auto& one : scene.non_reflecting) held = held || concerns(one.target);
    if (held || !(evidence.kinetic_share > 0.5)) continue;
    causes.push_back(Cause{
        "unheld",
        fmt::format(
            "nothing holds part {} against load {}, whose work has gone into its motion: add constraints or connectors",
            name, load.name),
        75});
  }
}

/// Overlaps as the scene is laid out: deep nodes may press with nothing at first, or be searched on another side of the
/// body, so that no penetration is seen.
void overlaps(const AssembledScene& assembled, const std::vector<ContactPair>& contacts, double step_size,
              std::vector<Cause>& causes) {
  for (const InitialOverlap& overlap : initial_overlaps(assembled, contacts, step_size)) {
    if (!overlap.deep) continue;
    const Vec3& x = overlap.place;
    causes.push_back(
        Cause{"initial penetration",
              fmt::format("the run begins with contact {} pressed in by {:.3g} of a face's size, {:.4g} m at ({:.6g}, "
                          "{:.6g}, {:.6g}) m: {}",
                          overlap.contact->name, overlap.share, overlap.depth, x[0], x[1], x[2], mend_of(overlap)),
              80});
  }
}

void contact_causes(const scene::Monitor& limit, const std::vector<ContactPair>& contacts, const Fault& fault,
                    const MonitorEvidence& evidence, std::vector<Cause>& causes) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const scene::Contact& contact = *contacts[c].contact;
    const auto known = [&](const Cause& cause) { return cause.name == "initial penetration"; };
    if (std::none_of(causes.begin(), causes.end(), known) && c < evidence.first.penetration.size() &&
        evidence.first.penetration[c].value > 0.5 * limit.penetration)
      causes.push_back(Cause{
          "initial penetration",
          fmt::format(
              "the run begins with contact {} pressed in by {:.3g} of a face's size: move the parts apart, or give "
              "contacts.{}.close_gap",
              contact.name, evidence.first.penetration[c].value, contact.name),
          80});
    if (fault.kind == FaultKind::energy && c < evidence.deepest.size() && evidence.deepest[c] > 0.5 * limit.penetration)
      causes.push_back(Cause{"contact",
                             fmt::format("nodes of contact {} were found {:.3g} of a face's size inside the other "
                                         "surface, with more energy than brought them there: look "
                                         "where they come in from beside, over an edge or from behind, and move the "
                                         "parts or choose other surfaces",
                                         contact.name, evidence.deepest[c]),
                             45});
    if (fault.kind == FaultKind::energy && contacts[c].has_springs() && !(contacts[c].contact->damping > 0) &&
        c < evidence.deepest.size() && evidence.deepest[c] > 0 && !(evidence.first.penetration[c].value > 0))
      causes.push_back(Cause{"blow on springs",
                             fmt::format("bodies strike the undamped springs of contact {} with few elements behind "
                                         "them, and each node that touches or parts errs by "
                                         "the square of the step: lower time.step_scale, give contacts.{}.damping, or "
                                         "take its algorithm \"multiplier\"",
                                         contact.name, contact.name),
                             10});
    const bool pressed = c < evidence.deepest.size() && evidence.deepest[c] > limit.penetration;
    if (pressed && contact.algorithm == scene::ContactAlgorithm::penalty)
      causes.push_back(Cause{
          "soft penalty",
          fmt::format("the springs of contact {} (contacts.{}.penalty_scale = {:.3g}) are too soft for what presses",
                      contact.name, contact.name, contact.penalty_scale),
          contact.penalty_scale < 0.5 ? 59.0 : 20.0});
    if (fault.kind == FaultKind::chatter)
      causes.push_back(Cause{
          "chatter",
          fmt::format("nodes of contact {} bounce: give it damping (contacts.{}.damping), or a softer penalty_scale",
                      contact.name, contact.name),
          30});
  }
}

/// What scripts/hourglass_table shows to make a part's share smaller (docs/hourglass.md). A higher coefficient does
/// not: viscous control takes no less with it, and stiffness control stores more.
Cause hourglass_share(const scene::Part& part) {
  const std::string& name = part.name;
  const scene::Part usual;
  if (part.hourglass == scene::HourglassType::viscous)
    return {"viscous hourglass control",
            fmt::format("viscous control takes the energy of part {}'s hourglass modes whatever its coefficient: set "
                        "parts.{}.hourglass = "
                        "\"stiffness\", the default, and leave hourglass_coefficient out",
                        name, name),
            30};
  const std::string coarse = fmt::format(
      "part {} is bent, or loaded at points, over few elements, and its hourglass control stores what these bear: "
      "refine it there",
      name);
  if (part.hourglass_coefficient > 1.001 * usual.hourglass_coefficient)
    return {"coarse mesh",
            fmt::format("{}, or lower parts.{}.hourglass_coefficient ({:.3g}) to {:g}", coarse, name,
                        part.hourglass_coefficient, usual.hourglass_coefficient),
            30};
  return {"coarse mesh", coarse, 30};
}

void hourglass(const AssembledScene& assembled, const Fault& fault, const MonitorEvidence& evidence,
               std::vector<Cause>& causes) {
  for (std::size_t p = 0; p < assembled.scene.parts.size(); ++p) {
    const scene::Part& part = assembled.scene.parts[p];
    const auto& range = assembled.assembly.parts[p];
    const int seen = evidence.last.distortion.place;
    const bool here = seen >= range.first_element && seen < range.first_element + range.element_count;
    const bool distorted = here && evidence.last.distortion.value > 0.5 * assembled.scene.monitor.hourglass_distortion;
    const double usual = part.hourglass == scene::HourglassType::viscous ? 0.1 : 0.05;
    if (part.hourglass_coefficient < 0.1 * usual &&
        (distorted || fault.kind == FaultKind::hourglass_distortion || fault.kind == FaultKind::inversion))
      causes.push_back(Cause{"no hourglass control",
                             fmt::format("part {} has no hourglass control to speak of: raise "
                                         "parts.{}.hourglass_coefficient ({:.3g}) to about {:g}",
                                         part.name, part.name, part.hourglass_coefficient, usual),
                             68});
    if (fault.kind == FaultKind::hourglass_share && part.name == fault.part) causes.push_back(hourglass_share(part));
  }
}

void shape(const scene::Scene& scene, const Fault& fault, const MonitorEvidence& evidence, std::vector<Cause>& causes) {
  const Extreme& worst = evidence.worst_shape;
  if (worst.place >= 0 && worst.value < 0.05)
    causes.push_back(Cause{"mesh",
                           fmt::format("the model's element {} is badly shaped before anything moves, its smallest "
                                       "Jacobian at a corner being {:.2g} of the mean: "
                                       "mend the mesh (`railwave check` names the worst)",
                                       worst.place, worst.value),
                           58});
  else if (fault.kind == FaultKind::inversion || fault.kind == FaultKind::hourglass_distortion)
    causes.push_back(
        Cause{"overstrained",
              fmt::format("part {} is strained beyond what its elements can follow: see what presses or hits it, or "
                          "let its material yield "
                          "(materials.{}.yield_stress)",
                          fault.part.empty() ? "?" : fault.part,
                          fault.part.empty() ? "NAME" : scene.parts[part_of_target(scene, fault.part)].material),
              25});
}

}  // namespace

std::vector<Cause> likely_causes(const AssembledScene& assembled, const StepSizes& sizes, const LoadModel& loads,
                                 const std::vector<ContactPair>& contacts, const Fault& fault,
                                 const MonitorEvidence& evidence) {
  const scene::Scene& scene = assembled.scene;
  std::vector<Cause> causes;
  curves(scene, causes);
  for (Fault& unit : absurd_units(assembled)) causes.push_back(std::move(unit.causes[0]));
  speeds(scene, evidence, causes);
  load_causes(assembled, loads.loads, causes);
  unheld(scene, fault, evidence, causes);
  overlaps(assembled, contacts, sizes.step_size, causes);
  contact_causes(scene.monitor, contacts, fault, evidence, causes);
  hourglass(assembled, fault, evidence, causes);
  shape(scene, fault, evidence, causes);
  for (Cause& cause : steps_too_long(assembled, sizes, loads.connectors.cells, contacts))
    causes.push_back(std::move(cause));
  if (causes.empty())
    causes.push_back(Cause{"unknown",
                           "none of the known causes is apparent: lower time.step_scale to see whether that mends it, "
                           "and look at the fault's surroundings",
                           0});
  std::stable_sort(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) { return a.weight > b.weight; });
  // Most meshes are stable beyond what their worst element is alone: that is worth telling only where nothing else is.
  causes.erase(std::remove_if(causes.begin() + 1, causes.end(),
                              [](const Cause& one) { return one.name == possible_step_cause; }),
               causes.end());
  return causes;
}

}  // namespace railwave
