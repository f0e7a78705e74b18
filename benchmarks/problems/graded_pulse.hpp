#pragma once

#include "benchmarks/problems/problem.hpp"

namespace railwave::bench {

/// A pulse that runs along a bar held sideways, through a mesh graded from 30 times the element size down to it in the
/// middle, and back. The error is that of the displacement at the end, L2. Detail: by what factor subcycling lessens
/// the element updates.
inline Outcome graded_pulse(double element_size, const Method& method) {
  const double coarse = 30 * element_size, coarse_length = 1.5, fine_length = 0.03, width = 0.12, amplitude = 1e-6;
  std::vector<double> half;
  for (double h = element_size; h < coarse; h *= 1.1) half.push_back(h);
  half.insert(half.end(), static_cast<std::size_t>(std::lround(coarse_length / coarse)), coarse);
  std::vector<double> sizes(half.rbegin(), half.rend());
  sizes.insert(sizes.end(), static_cast<std::size_t>(std::lround(fine_length / element_size)), element_size);
  sizes.insert(sizes.end(), half.begin(), half.end());
  std::vector<double> planes{0};
  for (double h : sizes) planes.push_back(planes.back() + h);

  const int along = static_cast<int>(sizes.size()), across = 4;
  scene::Scene scene =
      block_scene({double(along), across * coarse, across * coarse}, {along, across, across}, method.choice);
  apply(method, scene);
  hold(scene, "block", {false, true, true});
  Assembly assembly = assemble(scene);
  for (Vec3& x : assembly.nodes) x[0] = planes[static_cast<std::size_t>(std::lround(x[0]))];
  const double speed = scene.materials[0].dilatational_speed(), start = 5 * width, path = planes.back() - 2 * start;
  scene.time.end = path / speed;

  const auto shape = [&](double x) {
    const double s = (x - start) / width;
    return amplitude * std::exp(-0.5 * s * s);
  };
  Outcome outcome;
  Model model;
  build_model(scene, assembly, model);
  set_position(model, [&](const Vec3& x) { return Vec3{x[0] + shape(x[0]), x[1], x[2]}; });
  set_velocity(model, [&](const Vec3& x) {
    return Vec3{speed * (x[0] - start) / (width * width) * shape(x[0]), 0, 0};
  });
  Loop loop(model);
  outcome.seconds = seconds_of([&] { loop.steps(model.step_count); });
  outcome.elements = model.element_count();
  outcome.steps = model.step_count;
  outcome.error = relative_error(model, NodeField::displacement, [&](const Vec3& x) {
    return Vec3{shape(x[0] - path), 0, 0};
  });
  outcome.details = {{"updates_saved", model.subcycling.gain()}};
  return outcome;
}

}  // namespace railwave::bench
