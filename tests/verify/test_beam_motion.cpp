#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/beam_scene.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Determinant of moment and shear force at the free end for two independent motions of the clamped one, by Runge and
/// Kutta: w' = phi + Q/(k G A), phi' = M/(E I), Q' = - rho A omega^2 w, M' = - Q - rho I omega^2 phi.
double free_end(double omega, double length, double radius) {
  const double A = M_PI * radius * radius, I = M_PI / 4 * std::pow(radius, 4), EI = 210e9 * I;
  const double shear = 6 * 1.3 / 8.8 * (210e9 / 2.6) * A, squared = 7800 * omega * omega;
  using State = std::array<double, 4>;
  const auto slope = [&](const State& s) {
    return State{s[1] + s[3] / shear, s[2] / EI, -s[3] - squared * I * s[1], -squared * A * s[0]};
  };
  const auto ahead = [](const State& s, double h, const State& k) {
    State next{};
    for (int i = 0; i < 4; ++i) next[i] = s[i] + h * k[i];
    return next;
  };
  State end[2];
  for (int motion : {0, 1}) {
    State s{0, 0, motion == 0 ? 1.0 : 0.0, motion == 1 ? 1.0 : 0.0};
    const int steps = 400;
    const double h = length / steps;
    for (int n = 0; n < steps; ++n) {
      const State a = slope(s), b = slope(ahead(s, h / 2, a)), c = slope(ahead(s, h / 2, b)), d = slope(ahead(s, h, c));
      for (int i = 0; i < 4; ++i) s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
    end[motion] = s;
  }
  return end[0][2] * end[1][3] - end[0][3] * end[1][2];
}

double first_frequency(double length, double radius) {
  double low = 1, high = 1;
  const double sign = free_end(low, length, radius);
  while (sign * free_end(high, length, radius) > 0) high += 5;
  for (int i = 0; i < 60; ++i) (sign * free_end((low + high) / 2, length, radius) > 0 ? low : high) = (low + high) / 2;
  return low;
}

}  // namespace

TEST_CASE("the first frequency of a cantilever, stocky or slender, is Timoshenko's within a hundredth") {
  const double length = 1;
  for (double radius : {0.02, 0.08}) {
    const double expected = first_frequency(length, radius);
    scene::Scene scene = beam_scene({0, length, 0}, radius, 16, 2.2 * 2 * M_PI / expected);
    clamp(scene, "root");
    Model model;
    build_model(scene, model);
    // About the static shape under a force at the tip, as velocities: all but the first mode have little in it.
    set_velocity(model, [&](const Vec3& x, int) { return Vec3{0.1 * x[1] * x[1] * (3 * length - x[1]), 0, 0}; });
    const auto spin = to_host(model.beams->arrays.spin);
    const auto node = to_host(model.beams->arrays.node);
    for (int b = 0; b < model.beams->arrays.node_count; ++b) {
      const double y = model.assembly.nodes[node(b)][1];
      spin(b, 2) = -0.1 * (6 * length * y - 3 * y * y);
    }
    Kokkos::deep_copy(model.beams->arrays.spin, spin);
    std::vector<double> tip;
    march(model, model.step_count, [&] { tip.push_back(to_host(model.nodes.position)(node_of(model, "tip"), 0)); });
    CHECK_THAT(angular_frequency(tip, model.step_size), WithinRel(expected, 0.01));
  }
}

TEST_CASE("a beam in any rigid place and rotation is free of stress, and a bent one has the stresses that it has") {
  const auto axes = oblique_axes();
  scene::Scene scene = beam_scene(0.7 * axes[0], 0.02, 5, 1e-3);
  Model model;
  build_model(scene, model);
  const BeamArrays& beams = model.beams->arrays;
  const auto node = to_host(beams.node);
  for (double bent : {0.0, 0.1}) {
    BeamResultants before;
    for (double angle : {0.0, 1.0, 3.1, 5.0, 6.3, 40.0}) {
      const Vec3 about = (1 / 3.0) * Vec3{1, -2, 2};
      const Quaternion turn = turn_about({{angle * about[0], angle * about[1], angle * about[2]}});
      const auto position = to_host(model.nodes.position);
      const auto rotation = to_host(beams.rotation);
      for (int b = 0; b < beams.node_count; ++b) {
        const Vec3 X = model.assembly.nodes[node(b)];
        const double s = dot(X, axes[0]);
        const Vec3 x = X + bent * s * s * axes[1], own = 2 * bent * s * axes[2];
        const Vector3 place = turned(turn, Vector3{{x[0], x[1], x[2]}});
        const Quaternion q = turn * turn_about({{own[0], own[1], own[2]}});
        for (int i = 0; i < 3; ++i) position(node(b), i) = place[i] + 10.0 * i;
        rotation(b, 0) = q.w;
        for (int i = 0; i < 3; ++i) rotation(b, 1 + i) = q.v[i];
      }
      Kokkos::deep_copy(model.nodes.position, position);
      Kokkos::deep_copy(beams.rotation, rotation);
      compute_forces(model);
      const BeamResultants now = beam_resultants(*model.beams, model.nodes).front();
      const double scale = 210e9 * M_PI * 0.02 * 0.02;  // N, of a strain of one
      if (bent == 0) {
        CHECK(largest_of(now) < 1e-13 * scale);
        CHECK(account_energies(model, model.step_size).internal < 1e-20 * scale);
      } else if (angle == 0) {
        before = now;
        CHECK(largest_of(now) > 1e-4 * scale);
      }
      for (std::size_t i = 0; bent > 0 && i < now.force.size(); ++i) {
        CHECK_THAT(now.force[i], WithinAbs(before.force[i], 1e-13 * scale));
        CHECK_THAT(now.moment[i], WithinAbs(before.moment[i], 1e-13 * scale));
      }
    }
  }
}

TEST_CASE("a beam that spins about its axis for many turns stays free of stress") {
  const auto axes = oblique_axes();
  const double turning = 2000;  // rad/s
  scene::Scene scene = beam_scene(0.5 * axes[0], 0.02, 6, 20 * 2 * M_PI / turning);
  add_motion(scene, {"root", "tip"}, {5, 0, -3}, turning * axes[0]).centre = 0.25 * axes[0];
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  double largest = 0;
  march(model, model.step_count,
        [&] { largest = std::max(largest, largest_of(beam_resultants(*model.beams, model.nodes).front())); });
  CHECK(largest < 1e-11 * 210e9 * M_PI * 0.02 * 0.02);
}

TEST_CASE("a beam that spins like a propeller is stretched by rho omega^2 (L^2 - s^2) / 2 A and keeps its spin") {
  const double length = 1, radius = 0.02, turning = 300;
  scene::Scene scene = beam_scene({length, 0, 0}, radius, 16, 3 * 2 * M_PI / turning);
  add_motion(scene, {"root", "tip"}, {0, 0, 0}, {0, 0, turning}).centre = Vec3{length / 2, 0, 0};
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  double sum = 0, shear = 0;
  long samples = 0;
  march(model, model.step_count, [&] {
    const BeamResultants now = beam_resultants(*model.beams, model.nodes).front();
    sum += (now.force[3 * 7] + now.force[3 * 8]) / 2;
    shear = std::max(shear, std::fabs(now.force[3 * 4 + 1]));
    ++samples;
  });
  const double expected = 7800 * M_PI * radius * radius * turning * turning * length * length / 8;
  CHECK_THAT(sum / static_cast<double>(samples), WithinRel(expected, 0.01));
  CHECK(shear < 0.01 * expected);
}

TEST_CASE("a beam that bends and tumbles in free flight keeps both momenta to rounding, and its energy") {
  const auto axes = oblique_axes();
  scene::Scene scene = beam_scene(0.8 * axes[0], 0.01, 8, 0.02);
  scene.points[1].mass = 0.3;
  scene.time.step_scale = 0.5;
  Model model;
  build_model(scene, model);
  // Bends it by a fifth of its length and more.
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> speed(-20, 20);
  set_velocity(model, [&](const Vec3& x, int) {
    const double s = dot(x, axes[0]);
    return Vec3{3, 1, 2} + cross({30, 50, -80}, x) + 60 * std::sin(6 * s) * axes[1] + 40 * std::cos(5 * s) * axes[2] +
           0.05 * Vec3{speed(generator), speed(generator), speed(generator)};
  });
  compute_forces(model);
  const auto start = momenta(model);
  double size = 0, energy = 0, elastic = 0, drift = 0, sway = 0, turned_away = 0;
  march(model, model.step_count, [&] {
    const Momenta now = momenta(model);
    const EnergyAccount account = account_energies(model, model.step_size);
    if (size == 0) {
      size = norm(start.linear);
      energy = balance_total(account);
    }
    elastic = std::max(elastic, account.internal);
    drift = std::max(drift, norm(now.linear - start.linear));
    turned_away = std::max(turned_away, norm(now.angular - start.angular));
    sway = std::max(sway, std::fabs(balance_total(account) - energy));
  });
  CHECK(elastic > 0.2 * energy);
  CHECK(drift < 1e-12 * size);
  CHECK(turned_away < 1e-12 * norm(start.angular) + 1e-12 * size);
  CHECK(sway < 2e-3 * energy);
}

TEST_CASE("an element alone is stable up to L / sqrt(E/rho), and not beyond") {
  for (double length : {0.02, 0.3})
    for (double share : {0.98, 1.02}) {
      scene::Scene scene = beam_scene({length, 0, 0}, 0.01, 1, 1);
      Model model;
      build_model(scene, model);
      const double limit = length / std::sqrt(210e9 / 7800);
      CHECK_THAT(model.stable_step.limit, WithinRel(limit, 1e-12));
      model.step_size = share * limit;
      set_velocity(model, [&](const Vec3& x, int) { return Vec3{1e-3 * x[0] / length, 2e-3 * x[0], -1e-3}; });
      march(model, 2000, [] {});
      const double moved = norm(displacement(model, "tip")) / length;
      if (share < 1)
        CHECK(moved < 1e-2);
      else
        CHECK(!(moved < 1e-2));
    }
}
