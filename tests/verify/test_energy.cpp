#include <catch2/catch_test_macros.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Worst imbalance of a free vibration over its largest energy.
double imbalance(const scene::Scene& scene, const std::function<Vec3(const Vec3&, int)>& velocity) {
  Model model;
  build_model(scene, model);
  set_velocity(model, velocity);
  double first = 0, worst = 0, largest = 0;
  march(model, model.step_count, [&] {
    const EnergyAccount energy = account_energies(model, model.step_size);
    const double total = balance_total(energy);
    if (model.step == 0) first = total;
    worst = std::max(worst, std::fabs(total - first));
    largest = std::max(largest, largest_energy(energy));
  });
  return worst / largest;
}

/// The central difference keeps v(n-1/2) M v(n+1/2)/2 and the elastic energy exactly while motion is small. What
/// viscous control takes is booked with the last velocity's force, not the mean of two steps: an error of (omega
/// step)^2/4 of what fast motion loses, and of first order where the loss grows or falls.
void check_balance(scene::Scene scene, const std::function<Vec3(const Vec3&, int)>& velocity) {
  const auto at = [&](double step_scale) {
    scene.time.step_scale = step_scale;
    return imbalance(scene, velocity);
  };
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  const double exact = at(0.9);
  set_hourglass(scene.parts[0], scene::HourglassType::viscous, 0.1);
  const double coarse = at(0.9), half = at(0.45), tenth = at(0.09);
  INFO("imbalance: stiffness " << exact << ", viscous " << coarse << ", half the step " << half << ", a tenth "
                               << tenth);
  CHECK(exact < 1e-6);
  CHECK(coarse / half > 3);
  CHECK(half / tenth > 5);
  CHECK(tenth < 1e-3);
}

}  // namespace

TEST_CASE("the energies of a stretching block balance, the better the shorter the step") {
  const scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {8, 8, 8}, 4e-4);
  check_balance(scene, [](const Vec3& x, int) {
    return 0.01 *
           Vec3{std::cos(M_PI * x[0] / 0.1), 0.5 * std::cos(M_PI * x[1] / 0.1), -0.7 * std::cos(M_PI * x[2] / 0.1)};
  });
}

TEST_CASE("the energies of a swinging cantilever balance, the better the shorter the step") {
  // Two periods of its first bending mode, 3.52 sqrt(E I / rho A) / L^2.
  const double length = 0.2, height = 0.04;
  const double omega = 3.516 * std::sqrt(210e9 / 7800 / 12) * height / (length * length);
  scene::Scene scene = block_scene({length, 0.02, height}, {20, 2, 4}, 2 * 2 * M_PI / omega);
  hold(scene, "block.x_min", {true, true, true});
  check_balance(scene, [&](const Vec3& x, int) { return Vec3{0, 0, 0.1 * x[0] * x[0] / (length * length)}; });
}
