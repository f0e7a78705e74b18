#pragma once

#include "benchmarks/problems/problem.hpp"

namespace railwave::bench {

/// A pulse of velocity in a bar that is held sideways, so that it carries plane P waves without any dispersion of its
/// own. The pulse parts in two, each is reflected by a free end, and they meet again (d'Alembert). The error is that of
/// the velocity at the end, L2: the numerical dispersion.
inline Outcome bar_wave(double element_size, const Method& method) {
  const double length = 0.1, width = 0.01, pulse = 0.03, amplitude = 0.1;
  const int along = std::max(1, static_cast<int>(std::lround(length / element_size)));
  const int across = std::max(1, static_cast<int>(std::lround(width / element_size)));
  scene::Scene scene = block_scene({length, width, width}, {along, across, across}, method.choice);
  apply(method, scene);
  hold(scene, "block", {false, true, true});
  const double speed = scene.materials[0].dilatational_speed();
  scene.time.end = 1.75 * length / speed;

  const auto start = [&](double x) {
    const double s = (x - 0.5 * length) / pulse;
    return std::fabs(s) < 0.5 ? amplitude * 0.5 * (1 + std::cos(2 * pi * s)) : 0.0;
  };
  Outcome outcome;
  Model model;
  build_model(scene, model);
  set_velocity(model, [&](const Vec3& x) { return Vec3{start(x[0]), 0, 0}; });
  Loop loop(model);
  outcome.seconds = seconds_of([&] { loop.steps(model.step_count); });
  loop.forces();
  outcome.elements = model.element_count();
  outcome.steps = model.step_count;
  const double time = static_cast<double>(model.step) * model.step_size;
  outcome.error = relative_error(model, NodeField::velocity, [&](const Vec3& x) {
    double sum = 0;
    for (int image = -3; image <= 3; ++image)  // free ends reflect like images of the same sign
      for (double y : {2 * image * length + x[0], 2 * image * length - x[0]})
        sum += 0.5 * (start(y - speed * time) + start(y + speed * time));
    return Vec3{sum, 0, 0};
  });
  return outcome;
}

}  // namespace railwave::bench
