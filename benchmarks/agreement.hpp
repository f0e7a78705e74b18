#pragma once

#include <cmath>

#include "benchmarks/baseline_build.hpp"
#include "benchmarks/common/loop.hpp"
#include "benchmarks/common/scenes.hpp"
#include "model/fields.hpp"

namespace railwave::bench {

/// How the product and the baseline do on the same wave.
struct Agreement {
  double difference = 0;     ///< of the displacements, L2, relative
  double product_error = 0;  ///< of the displacement along the bar against d'Alembert's, L2, relative
  double baseline_error = 0;
};

/// A pulse of velocity in the middle of a slender free bar parts in two that run to the ends, come back, and are
/// compared with each other and with the exact solution u(x, t) = sum over the images of 1/2 c int v0.
inline Agreement compare_on_a_bar_wave() {
  const double length = 0.4, width = 5e-3, pulse = 0.06;
  const int layers = 80;
  scene::Scene scene = block_scene({length, width, width}, {layers, 1, 1}, {});
  scene.time.step_scale = 0.5;  // a bar of one element across has higher frequencies than its elements
  const scene::Material& steel = scene.materials[0];
  const double speed = std::sqrt(steel.youngs_modulus / steel.density);
  scene.time.end = 1.2 * length / speed;
  Model model;
  build_model(scene, model);

  const auto start = [&](const Vec3& x) {
    const double s = (x[0] - 0.5 * length) / pulse;
    return Vec3{std::fabs(s) < 0.5 ? 0.5 * (1 + std::cos(2 * M_PI * s)) : 0.0, 0, 0};
  };
  set_velocity(model, start);
  const Baseline b = build_baseline(model);
  {
    const auto velocity = to_host(b.velocity);
    for (int n = 0; n < b.node_count; ++n) velocity(n, 0) = start(model.assembly.nodes[n])[0];
    Kokkos::deep_copy(b.velocity, velocity);
  }

  Loop loop(model);
  loop.steps(model.step_count);
  baseline_steps(b, model.step_size, 0, model.step_count);

  // Integral of the pulse from its middle to a place.
  const auto integral = [&](double y) {
    const double s = std::fmax(-0.5, std::fmin(0.5, (y - 0.5 * length) / pulse));
    return pulse * (0.5 * s + std::sin(2 * M_PI * s) / (4 * M_PI));
  };
  // Free ends reflect like images of the same sign.
  const auto exact = [&](double x, double t) {
    double sum = 0;
    for (int image = -3; image <= 3; ++image)
      for (double y : {2 * image * length + x, 2 * image * length - x})
        sum += integral(y + speed * t) - integral(y - speed * t);
    return sum / (2 * speed);
  };
  std::vector<int> all(model.assembly.nodes.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<int>(n);
  const auto product = node_field(model, model.ties, NodeField::displacement, all).values;
  const auto place = to_host(b.position);
  const double time = static_cast<double>(model.step_count) * model.step_size;
  double square = 0, exact_square = 0, apart = 0, off_product = 0, off_baseline = 0;
  for (int n = 0; n < b.node_count; ++n) {
    const Vec3& X = model.assembly.nodes[n];
    for (int i = 0; i < 3; ++i) {
      const double u = product[3 * n + i], w = place(n, i) - X[i];
      square += u * u;
      apart += (u - w) * (u - w);
    }
    const double right = exact(X[0], time);
    exact_square += right * right;
    off_product += std::pow(product[3 * n] - right, 2);
    off_baseline += std::pow(place(n, 0) - X[0] - right, 2);
  }
  return {std::sqrt(apart / square), std::sqrt(off_product / exact_square), std::sqrt(off_baseline / exact_square)};
}

}  // namespace railwave::bench
