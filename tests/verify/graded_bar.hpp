#pragma once

#include "tests/verify/march.hpp"

namespace railwave::verify {

/// Planes of a bar along x, graded from `largest` down to 1 mm in its middle and back, m.
inline std::vector<double> graded_planes(int coarse, int fine, double largest) {
  std::vector<double> half;
  for (double h = 1e-3; h < largest; h *= 1.1) half.push_back(h);
  half.insert(half.end(), coarse, largest);
  std::vector<double> sizes(half.rbegin(), half.rend());
  sizes.insert(sizes.end(), fine, 1e-3);
  sizes.insert(sizes.end(), half.begin(), half.end());
  std::vector<double> x{0};
  for (double h : sizes) x.push_back(x.back() + h);
  return x;
}

/// The bar as a scene and its assembly: elements of the largest size across, `across` by `across` of them.
struct GradedBar {
  std::vector<double> planes;
  scene::Scene scene;
  Assembly assembly;

  GradedBar(int coarse, int fine, double end, int across = 2, double largest = 0.03)
      : planes(graded_planes(coarse, fine, largest)) {
    const int layers = static_cast<int>(planes.size()) - 1;
    const double width = largest * across;
    scene = block_scene({static_cast<double>(layers), width, width}, {layers, across, across}, end);
    set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
    scene.time.step_scale = 0.9;
    assembly = assemble(scene);
    for (Vec3& x : assembly.nodes) x[0] = planes[static_cast<std::size_t>(std::lround(x[0]))];
  }

  double length() const { return planes.back(); }
  double wave_speed() const { return scene.materials[0].dilatational_speed(); }

  void build(Model& model, bool subcycling) {
    scene.solver.subcycling = subcycling;
    build_model(scene, assembly, model);
  }
};

/// A dilatational pulse that runs along x, a Gaussian of `width` with its peak at `start`.
struct Pulse {
  double width, amplitude, start, speed;  ///< m, m, m, m/s

  double displacement(double x) const {
    const double s = (x - start) / width;
    return amplitude * std::exp(-0.5 * s * s);
  }
  double largest_strain() const { return amplitude / width * std::exp(-0.5); }
  void set(Model& model) const {
    set_position(model, [&](const Vec3& x, int) { return x + Vec3{displacement(x[0]), 0, 0}; });
    set_velocity(model, [&](const Vec3& x, int) {
      return Vec3{speed * (x[0] - start) / (width * width) * displacement(x[0]), 0, 0};
    });
  }
};

/// Every mode of the bar at once: random velocities.
inline void shake(Model& model) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-0.01, 0.01);
  set_velocity(model, [&](const Vec3&, int) { return Vec3{any(generator), any(generator), any(generator)}; });
}

}  // namespace railwave::verify
