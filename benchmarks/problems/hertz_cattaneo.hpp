#pragma once

#include "benchmarks/problems/pressed_cylinder.hpp"

namespace railwave::bench {

/// Hertz's line contact for a force a metre.
struct HertzLine {
  double half_width, peak;
  HertzLine(double force, double radius, double modulus)
      : half_width(std::sqrt(4 * force * radius / (pi * modulus))), peak(2 * force / (pi * half_width)) {}
  double pressure(double x) const {
    const double r = x / half_width;
    return r * r < 1 ? peak * std::sqrt(1 - r * r) : 0;
  }
};

/// The cylinder pressed on the block by a given approach, settled. Error: the pressure, L2, against Hertz's for the
/// force that came out. Details: the peak pressure's error, and the force's against Johnson's for this approach.
inline Outcome hertz_press(double element_size, const Method& method) {
  PressedCylinder problem;
  problem.element_size = element_size;
  scene::Scene scene = problem.scene(method);
  hold(scene, "upper.far", {true, false, false});
  const scene::Material& steel = scene.materials[0];
  Model model;
  build_model(scene, problem.assembly(steel), model);
  Outcome outcome;
  SettleReport report;
  outcome.seconds = seconds_of([&] { report = settle(model, [](const SettleReport&) { return true; }); });
  Loop(model).forces();
  const LineContact contact(model, element_size);
  const HertzLine hertz(contact.normal, problem.radius, PressedCylinder::contact_modulus(steel));
  outcome.elements = model.element_count();
  outcome.steps = report.steps;
  outcome.error = contact.error(contact.pressure, [&](double x) { return hertz.pressure(x); });
  const double peak = *std::max_element(contact.pressure.begin(), contact.pressure.end());
  outcome.details = {{"peak_error", peak / hertz.peak - 1},
                     {"force_error", contact.normal / problem.force(steel) - 1},
                     {"half_width", hertz.half_width},
                     {"settled", report.settled ? 1.0 : 0.0}};
  return outcome;
}

/// The same, then shifted by a tangential force that grows slowly to 0.6 of what friction can carry (Cattaneo 1938).
/// Error: the shear, L2, against q = mu p - mu p0 c/b sqrt(1 - x^2/c^2), c/b = sqrt(1 - Q / mu P), for the forces that
/// came out. Detail: the stick zone's half width.
inline Outcome cattaneo_shift(double element_size, const Method& method) {
  constexpr double friction = 0.4, share = 0.6, ramp = 6e-4;
  PressedCylinder problem;
  problem.element_size = element_size;
  scene::Scene scene = problem.scene(method);
  scene.contacts[0].friction = friction;
  const scene::Material steel = scene.materials[0];
  scene::Curve curve;
  curve.name = "ramp";
  curve.type = scene::CurveType::cosine_ramp;
  curve.duration = ramp;
  scene.curves.push_back(curve);
  scene::Load load;
  load.name = "shift";
  load.target = "upper.far";
  load.force = {share * friction * problem.force(steel) * element_size, 0, 0};
  load.curve = "ramp";
  scene.loads.push_back(load);
  scene.time.end = ramp;

  Model model;
  build_model(scene, problem.assembly(steel), model);
  Outcome outcome;
  SettleReport report;
  Loop loop(model);
  outcome.seconds = seconds_of([&] {
    report = settle(model, [](const SettleReport&) { return true; });
    loop.steps(model.step_count);
  });
  loop.forces();
  const LineContact contact(model, element_size);
  const HertzLine hertz(contact.normal, problem.radius, PressedCylinder::contact_modulus(steel));
  outcome.elements = model.element_count();
  outcome.steps = report.steps + model.step_count;
  const double carried = std::fabs(contact.tangential) / (friction * contact.normal);
  const double stick = std::sqrt(std::fmax(0.0, 1 - carried));  // c/b
  const double sign = contact.tangential < 0 ? -1 : 1;
  outcome.error = contact.error(contact.shear, [&](double x) {
    const double r = x / (stick * hertz.half_width);
    const double inner = r * r < 1 ? stick * std::sqrt(1 - r * r) : 0;
    return sign * friction * (hertz.pressure(x) - hertz.peak * inner);
  });
  double stuck = 0;
  for (std::size_t n = 0; n < contact.x.size(); ++n) stuck += contact.sticks[n] * contact.area[n];
  outcome.details = {{"stick_width_error", 0.5 * stuck / element_size / (stick * hertz.half_width) - 1},
                     {"carried", carried},
                     {"settled", report.settled ? 1.0 : 0.0}};
  return outcome;
}

}  // namespace railwave::bench
