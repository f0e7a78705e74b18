#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "model/elements/relative_coordinates.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;

namespace {

/// Steps whose size need not stay, the last one sampled and the others not.
void march_steps(Model& model, const std::vector<double>& sizes) {
  StepPlans plans(model);
  Instant instant;
  for (std::size_t k = 0; k <= sizes.size(); ++k) {
    instant.step = k < sizes.size() ? sizes[k] : sizes.back();
    plans.compute_forces(instant, k < sizes.size() ? StepKind::advancing : StepKind::sampled);
    if (k == sizes.size()) return;
    plans.advance(instant);
    model.time += instant.step;
    instant.elapsed = instant.step;
  }
}

struct State {
  std::vector<double> position, velocity;
};

/// By where the nodes were: their order is another in single precision on a processor.
State state_of(const Model& model) {
  std::vector<int> nodes = all_nodes(model);
  std::sort(nodes.begin(), nodes.end(),
            [&](int a, int b) { return model.assembly.nodes[a] < model.assembly.nodes[b]; });
  return {node_field(model, model.ties, NodeField::position, nodes).values,
          node_field(model, model.ties, NodeField::velocity, nodes).values};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return largest;
}

double largest_of(const std::vector<double>& a) { return largest_difference(a, std::vector<double>(a.size(), 0.0)); }

/// A free block that flies and turns at once and rings a little.
scene::Scene flying_block(scene::HourglassType hourglass) {
  scene::Scene scene = block_scene({0.12, 0.1, 0.08}, {9, 8, 7}, 1e-3);
  set_hourglass(scene.parts[0], hourglass, 0.05);
  scene.solver.precision = scene::Precision::single_precision;
  scene.time.step = 1.5e-6;  // a search ends somewhat apart in another order of nodes
  scene.parts[0].position = {0.4, -0.3, 0.2};
  add_motion(scene, {"block"}, {28, -3, 5}, {20, 100, -35});
  return scene;
}

State flown(scene::Scene scene, scene::Precision precision, const std::function<std::vector<double>(double)>& sizes) {
  scene.solver.precision = precision;
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  march_steps(model, sizes(model.step_size));
  return state_of(model);
}

}  // namespace

TEST_CASE("a co-rotating frame's velocities of half steps are its motion's differences") {
  FrameMotion motion;
  motion.axis = {{2 / 7.0, -3 / 7.0, 6 / 7.0}};
  motion.speed = 90;
  motion.centre = {{0.1, 0.7, -0.4}};
  motion.velocity = {{25, -2, 3}};
  const Vector3 X{{0.5, 0.3, 0.1}};
  for (double h : {1e-4, 1e-7}) {
    const double t = 0.37;
    const Vector3 now = frame_at(motion, t, h).position(X), then = frame_at(motion, t + h, h).position(X);
    const Vector3 difference = (1 / h) * (then - now);
    const Vector3 after = motion.velocity + (motion.rate_after(h) * motion.turn(t)) * (X - motion.centre);
    const Vector3 before = frame_at(motion, t + h, h).velocity_of(X);
    // The difference of places itself is rounded to 1e-16 m over h.
    CHECK(norm(after - difference) < 1e-12 + 3e-15 / h);
    CHECK(norm(after - before) < 1e-12);
  }
  // No step behind: the velocity of the instant itself.
  const Vector3 arm = X - motion.centre;
  CHECK(norm(frame_at(motion, 0, 0).velocity_of(X) - motion.velocity - motion.speed * cross(motion.axis, arm)) < 1e-12);
}

TEST_CASE("a flying, turning block in single precision does what it does in double") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    const scene::Scene scene = flying_block(hourglass);
    // The step changes on the way, in the midst of a block of the frames' steps and at its end.
    const auto sizes = [](double step) {
      std::vector<double> all(3000, step);
      for (std::size_t k = 0; k < all.size(); ++k) all[k] *= k < 1000 ? 1 : k < 1009 ? 0.7 : k < 1640 ? 0.85 : 0.95;
      return all;
    };
    const State wide = flown(scene, scene::Precision::double_precision, sizes);
    const State narrow = flown(scene, scene::Precision::single_precision, sizes);
    // It tumbles, as it does not turn about a principal axis: the nodes leave the frame by a millimetre.
    const double moved = largest_difference(narrow.position, wide.position);
    const double speed = largest_difference(narrow.velocity, wide.velocity);
    INFO("hourglass type " << static_cast<int>(hourglass) << ": positions differ by " << moved << " m, velocities by "
                           << speed << " m/s");
    CHECK(moved < 1e-7 * 0.12);
    CHECK(speed < 1e-4 * 36);
    CHECK(largest_of(wide.velocity) > 30);
  }
}

TEST_CASE("a cube that flies and turns stays within its own ringing of the co-rotating frame") {
  scene::Scene scene = flying_block(scene::HourglassType::viscous);
  scene.meshes[0].box.size = {0.1, 0.1, 0.1};
  scene.meshes[0].box.divisions = {8, 8, 8};
  const auto steady = [](double step) { return std::vector<double>(4000, step); };
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  march_steps(model, steady(model.step_size));
  const auto nodes = to_host(model.relative.node);
  double displacement = 0, velocity = 0;
  for (std::size_t n = 0; n < nodes.extent(0); ++n)
    for (int i = 0; i < 3; ++i) {
      displacement = std::max(displacement, std::fabs(static_cast<double>(nodes(n).displacement[i])));
      velocity = std::max(velocity, std::fabs(static_cast<double>(nodes(n).velocity[i])));
    }
  const State wide = flown(scene, scene::Precision::double_precision, steady), narrow = state_of(model);
  const double moved = largest_difference(narrow.position, wide.position);
  INFO("largest d " << displacement << " m, largest w " << velocity << " m/s; positions differ from double ones by "
                    << moved << " m");
  // Centrifugal forces stretch it by rho omega^2 L^3 / E or so.
  CHECK(displacement < 7800 * 110.0 * 110.0 * 1e-3 / 210e9);
  CHECK(displacement > 1e-9);
  CHECK(velocity < 0.1);
  CHECK(moved < 1e-6 * displacement + 4000 * 1e-13);
}

TEST_CASE("a wave in a bar in single precision is the wave in double") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    std::vector<double> amplitude[2];
    for (int k : {0, 1}) {
      scene::Scene scene = block_scene({0.4, 0.01, 0.01}, {80, 2, 2}, 3e-4);
      set_hourglass(scene.parts[0], hourglass, 0.05);
      if (k == 1) scene.solver.precision = scene::Precision::single_precision;
      Model model;
      build_model(scene, model);
      const auto shape = [](const Vec3& x) { return std::cos(2 * M_PI * x[0] / 0.4); };
      set_velocity(model, [&](const Vec3& x, int) { return Vec3{0.1 * shape(x), 0, 0}; });
      const auto nodes = all_nodes(model);
      march(model, model.step_count, [&] {
        const auto u = node_field(model, model.ties, NodeField::displacement, nodes).values;
        double sum = 0;
        for (int n : nodes) sum += model.mass[n] * u[3 * n] * shape(model.assembly.nodes[n]);
        amplitude[k].push_back(sum / total_mass(model));
      });
    }
    const double largest = largest_of(amplitude[0]), error = largest_difference(amplitude[0], amplitude[1]);
    INFO("hourglass type " << static_cast<int>(hourglass) << ": amplitude " << largest << " m, differs by " << error
                           << " m");
    CHECK(error < 1e-5 * largest);
    CHECK(largest > 1e-7);
  }
}
