#pragma once

#include "benchmarks/problems/problem.hpp"
#include "benchmarks/problems/rayleigh_packet.hpp"

namespace railwave::bench {

/// A packet of Rayleigh waves of 10 mm runs 20 mm along the top of a block. Error: displacements of the whole block at
/// the end, L2. Detail: the speed, from where the packet's phase on the surface fits best.
inline Outcome rayleigh_pulse(double element_size, const Method& method) {
  const double length = 0.08, depth = 0.05, wavelength = 0.01, travel = 0.02, from = 0.03, amplitude = 1e-6;
  const int along = static_cast<int>(std::lround(length / element_size));
  const int down = static_cast<int>(std::lround(depth / element_size));
  scene::Scene scene = block_scene({length, element_size, depth}, {along, 1, down}, method.choice);
  apply(method, scene);
  hold(scene, "block", {false, true, false});
  const RayleighPacket packet(scene.materials[0], wavelength, 0.8 * wavelength);
  scene.time.end = travel / packet.speed;

  Outcome outcome;
  Model model;
  build_model(scene, model);
  set_position(model, [&](const Vec3& x) {
    const Vec3 u = packet.displacement(x[0] - from, depth - x[2]);
    return Vec3{x[0] + amplitude * u[0], x[1], x[2] + amplitude * u[2]};
  });
  set_velocity(model, [&](const Vec3& x) {
    const Vec3 u = packet.slope(x[0] - from, depth - x[2]);
    return Vec3{-packet.speed * amplitude * u[0], 0, -packet.speed * amplitude * u[2]};
  });
  Loop loop(model);
  outcome.seconds = seconds_of([&] { loop.steps(model.step_count); });
  outcome.elements = model.element_count();
  outcome.steps = model.step_count;
  const double time = static_cast<double>(model.step) * model.step_size;
  const auto at = [&](double speed) {
    return [&, speed](const Vec3& x) {
      const Vec3 u = packet.displacement(x[0] - from - speed * time, depth - x[2]);
      return Vec3{amplitude * u[0], 0, amplitude * u[2]};
    };
  };
  outcome.error = relative_error(model, NodeField::displacement, at(packet.speed));

  // The surface's motion against the packet at other speeds: the best fit by golden section.
  std::vector<int> surface;
  for (int n = 0; n < model.nodes.count; ++n)
    if (model.assembly.nodes[n][2] > depth - 1e-9) surface.push_back(n);
  const auto values = node_field(model, model.ties, NodeField::displacement, surface).values;
  const auto misfit = [&](double speed) {
    double off = 0;
    for (std::size_t k = 0; k < surface.size(); ++k) {
      const Vec3 u = at(speed)(model.assembly.nodes[surface[k]]);
      off += std::pow(values[3 * k] - u[0], 2) + std::pow(values[3 * k + 2] - u[2], 2);
    }
    return off;
  };
  double low = 0.95 * packet.speed, high = 1.05 * packet.speed;
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  for (int k = 0; k < 40; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  outcome.details = {{"speed_error", 0.5 * (low + high) / packet.speed - 1}, {"rayleigh_speed", packet.speed}};
  return outcome;
}

}  // namespace railwave::bench
