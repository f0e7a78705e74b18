#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/graded_bar.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double length = 0.1;
constexpr auto precisions = {scene::Precision::double_precision, scene::Precision::mixed,
                             scene::Precision::single_precision};

/// A bar along z without lateral contraction, held across its lower end, and its first mode of angular frequency w.
struct Bar {
  scene::Scene scene;
  double frequency;

  Bar(int divisions, double periods) : scene(block_scene({0.01, 0.01, length}, {1, 1, divisions}, 1)) {
    scene.materials[0].poissons_ratio = 0;
    frequency = M_PI / (2 * length) * std::sqrt(scene.materials[0].youngs_modulus / scene.materials[0].density);
    scene.time.end = periods * 2 * M_PI / frequency;
    hold(scene, "block.z_min", {false, false, true});
  }
};

void start_in_first_mode(Model& model, double speed) {
  set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, speed * std::sin(M_PI * x[2] / (2 * length))}; });
}

struct Decay {
  double ratio;       ///< of critical damping, from the peaks
  double imbalance;   ///< of the energy, over what there was
  double dissipated;  ///< by the account, over what is no longer there
};

Decay decay_of(const scene::Scene& scene) {
  Model model;
  build_model(scene, model);
  start_in_first_mode(model, 0.1);
  const auto end_face = model.assembly.node_sets.at("block.z_max");
  std::vector<double> u;
  EnergyAccount first, last;
  double worst = 0;
  march(model, model.step_count, [&] {
    u.push_back(mean(model, NodeField::displacement, end_face)[2]);
    last = account_energies(model, model.step_size);
    if (model.step == 0) first = last;
    worst = std::max(worst, std::fabs(balance_total(last) - balance_total(first)) / balance_total(first));
  });
  std::vector<double> peaks;
  for (std::size_t k = 1; k + 1 < u.size(); ++k) {
    const double a = std::fabs(u[k - 1]), b = std::fabs(u[k]), c = std::fabs(u[k + 1]);
    if (b > a && b >= c) peaks.push_back(b + (c - a) * (c - a) / (8 * (2 * b - a - c)));
  }
  REQUIRE(peaks.size() >= 6);
  const double decrement = std::log(peaks.front() / peaks.back()) / static_cast<double>(peaks.size() - 1) / M_PI;
  return {decrement / std::sqrt(1 + decrement * decrement), worst,
          last.damping / (first.kinetic - last.kinetic - last.internal - last.hourglass)};
}

/// Any motion of a free block after many steps of a size, over that at the start. (The scheme's kinetic energy is
/// negative where velocities change their sign with every step.)
double growth(const scene::Scene& scene, double share_of_step) {
  Model model;
  build_model(scene, model);
  model.step_size = share_of_step * model.stable_step.limit;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1e-3, 1e-3);
  set_velocity(model, [&](const Vec3&, int) { return Vec3{any(random), any(random), any(random)}; });
  double first = 0, last = 0;
  march(model, 3000, [&] {
    if (model.step % 1000 != 0) return;
    last = std::fabs(account_energies(model, model.step_size).kinetic);
    if (model.step == 0) first = last;
  });
  return last / first;
}

}  // namespace

TEST_CASE("a bar's mode decays as Rayleigh's two constants say, and the account has what it lost") {
  for (const auto precision : precisions)
    for (const bool stiffness : {true, false}) {
      Bar bar(32, 4);
      bar.scene.solver.precision = precision;
      const double ratio = 0.03;
      if (stiffness)
        bar.scene.parts[0].stiffness_damping = 2 * ratio / bar.frequency;
      else
        bar.scene.parts[0].mass_damping = 2 * ratio * bar.frequency;
      const Decay decay = decay_of(bar.scene);
      INFO("precision " << static_cast<int>(precision) << (stiffness ? ", stiffness" : ", mass") << ": ratio "
                        << decay.ratio << ", imbalance " << decay.imbalance << ", dissipated " << decay.dissipated);
      CHECK_THAT(decay.ratio, WithinRel(ratio, 0.01));
      CHECK(decay.imbalance < 1e-3);
      CHECK_THAT(decay.dissipated, WithinRel(1.0, 2e-3));
    }
}

TEST_CASE("mass damping slows a body that flies, in every precision, and the account has what it lost") {
  for (const auto precision : precisions) {
    scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {4, 4, 4}, 5e-4);
    scene.solver.precision = precision;
    scene.parts[0].mass_damping = 1000;
    const Vec3 start{3, -30, 12};
    add_motion(scene, {"block"}, start, {20, 5, -9});
    Model model;
    build_model(scene, model);
    set_initial_motion(model, model.nodes, model.beams);
    EnergyAccount first, last;
    Vec3 speed{};
    march(model, model.step_count, [&] {
      if (model.step != 0 && model.step != model.step_count) return;
      last = account_energies(model, model.step_size);
      speed = mean(model, NodeField::velocity, all_nodes(model));
      if (model.step == 0) first = last;
    });
    for (int i = 0; i < 3; ++i) CHECK_THAT(speed[i], WithinRel(start[i] * std::exp(-0.5), 2e-3));
    INFO("precision " << static_cast<int>(precision) << ", imbalance "
                      << (balance_total(last) - balance_total(first)) / first.kinetic);
    CHECK_THAT(balance_total(last) / first.kinetic, WithinRel(1.0, 1e-4));
    CHECK_THAT(last.damping / first.kinetic, WithinRel(1 - std::exp(-1.0), 5e-3));
  }
}

TEST_CASE("a body that turns feels nothing of stiffness damping") {
  for (const auto precision : precisions) {
    scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {3, 3, 3}, 1e-3);
    scene.solver.precision = precision;
    scene.parts[0].stiffness_damping = 1e-6;
    scene.settle.active = false;
    add_motion(scene, {"block"}, {30, 0, 0}, {0, 60, 0});
    Model model;
    build_model(scene, model);
    set_initial_motion(model, model.nodes, model.beams);
    EnergyAccount first, last;
    march(model, model.step_count, [&] {
      if (model.step != 0 && model.step != model.step_count) return;
      last = account_energies(model, model.step_size);
      if (model.step == 0) first = last;
    });
    INFO("precision " << static_cast<int>(precision) << ": damping " << last.damping / first.kinetic);
    CHECK(std::fabs(last.damping) < 1e-5 * first.kinetic);
    CHECK_THAT(last.kinetic / first.kinetic, WithinRel(1.0, 1e-4));
  }
}

TEST_CASE("the stable step knows the damping: below it motions die, above they grow") {
  enum class Kind { stiffness, mass, bulk };
  for (const Kind kind : {Kind::stiffness, Kind::mass, Kind::bulk}) {
    scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {5, 5, 5}, 1e-3);
    set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
    double undamped = 0, damped = 0;
    for (const auto estimate :
         {scene::StepEstimate::global, scene::StepEstimate::eigenvalue, scene::StepEstimate::element}) {
      scene.solver.step_estimate = estimate;
      scene::Scene with = scene;
      if (kind == Kind::stiffness) with.parts[0].stiffness_damping = 4e-6;
      if (kind == Kind::mass) with.parts[0].mass_damping = 4e5;
      if (kind == Kind::bulk) with.parts[0].linear_bulk_viscosity = 0.5;
      Model plain, model;
      build_model(scene, plain);
      build_model(with, model);
      undamped = plain.stable_step.limit, damped = model.stable_step.limit;
      INFO("kind " << static_cast<int>(kind) << ", estimate " << static_cast<int>(estimate) << ": " << damped << " of "
                   << undamped);
      CHECK(damped < 0.8 * undamped);
      CHECK(growth(with, 0.95) < 1);
      if (estimate == scene::StepEstimate::global && kind != Kind::bulk) {
        const double after = growth(with, 1.05);
        CHECK((after > 1e3 || !std::isfinite(after)));
      }
    }
  }
}

TEST_CASE("bulk viscosity presses where volume shrinks, and only there") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  scene::Part& part = scene.parts[0];
  set_hourglass(part, scene::HourglassType::stiffness, 0.05);
  part.linear_bulk_viscosity = 0.06;
  part.quadratic_bulk_viscosity = 1.5;
  Model model;
  build_model(scene, model);
  const auto power = [&](double rate) {
    set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, rate * x[2]}; });
    compute_forces(model);
    const auto all = all_nodes(model);
    const auto a = node_field(model, model.ties, NodeField::acceleration, all).values;
    double sum = 0;
    for (int n : all) sum += model.mass[n] * a[3 * n + 2] * rate * model.assembly.nodes[n][2];
    return sum;
  };
  const scene::Material& material = scene.materials[0];
  const double d = 800, l = 0.05,
               q = material.density * l * (1.5 * l * d * d + 0.06 * material.dilatational_speed() * d);
  CHECK_THAT(power(-d), WithinRel(-q * d * 1e-3, 1e-10));
  CHECK_THAT(power(d), WithinAbs(0, 1e-6));
}

TEST_CASE("only damped parts have damping, and what is left out says so") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  scene.parts.push_back(scene.parts[0]);
  scene.parts[1].name = "other";
  scene.parts[1].position = {1, 0, 0};
  Model plain;
  build_model(scene, plain);
  REQUIRE(plain.elements.size() == 1);
  CHECK_FALSE(plain.elements[0].damping.active());
  scene.parts[1].stiffness_damping = 1e-7;
  Model model;
  build_model(scene, model);
  REQUIRE(model.elements.size() == 2);
  CHECK(model.elements[0].damping.active() != model.elements[1].damping.active());
  const auto tasks = [](Model& of) { return make_plan(of, StepKind::sampled).forces.size(); };
  CHECK(tasks(model) == tasks(plain) + 2);
  CHECK(device_bytes(model) > device_bytes(plain));
}

TEST_CASE("a pulse loses as much to damping with subcycling as without, and its balance holds") {
  double dissipated[2] = {}, first[2] = {};
  for (const bool subcycling : {false, true}) {
    GradedBar bar(6, 10, 1e-4);
    bar.scene.parts[0].stiffness_damping = 2e-7;
    bar.scene.parts[0].mass_damping = 500;
    hold(bar.scene, "block", {false, true, true});
    Model model;
    bar.build(model, subcycling);
    CHECK((model.subcycling.levels > 1) == subcycling);
    Pulse{0.06, 1e-6, 0.15, bar.wave_speed()}.set(model);
    Recorder recorder;
    run(model, {&recorder});
    const EnergyAccount &begin = recorder.samples.front().energy, &end = recorder.samples.back().energy;
    first[subcycling] = begin.kinetic + begin.internal;
    dissipated[subcycling] = end.damping;
    INFO("subcycling " << subcycling << ": dissipated " << end.damping / first[subcycling] << ", balance error "
                       << end.balance_error / first[subcycling] << ", updates " << model.subcycling.gain()
                       << " times fewer");
    CHECK(end.damping > 0.05 * first[subcycling]);
    CHECK(std::fabs(end.balance_error) < 1e-2 * first[subcycling]);
  }
  CHECK_THAT(dissipated[1], WithinRel(dissipated[0], 0.02));
}
