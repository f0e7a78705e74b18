#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

constexpr double yield = 400e6, tangent = 21e9;

struct PullPoint {
  double strain, stress;
};

/// A bar pulled slowly along x by a traction on its end, free to contract: logarithmic strain and mean true stress,
/// with the imbalance of energies over the work done.
std::vector<PullPoint> pull(scene::Precision precision, double& imbalance, double& plastic) {
  const double length = 0.02;
  scene::Scene scene = yielding_bar(yield, tangent, 2.5e-3);
  scene.solver.precision = precision;
  add_ramp(scene, "on", 0, 2.5e-3);
  add_traction(scene, "block.x_max", {600e6, 0, 0}, "on");
  Model model;
  build_model(scene, model);
  std::vector<PullPoint> points;
  const auto end_face = model.assembly.node_sets.at("block.x_max");
  const auto elements = all_elements(model);
  march(model, model.step_count, [&] {
    if (model.step % 20 != 0) return;
    const auto stress = element_stress(model, model.nodes, elements).values;
    double sum = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) sum += stress[6 * e];
    points.push_back({std::log1p(mean(model, NodeField::displacement, end_face)[0] / length), sum / elements.size()});
  });
  const EnergyAccount energy = account_energies(model, model.step_size);
  imbalance = std::fabs(balance_total(energy)) / energy.external_work;
  plastic = energy.plastic / (length * 1e-4);
  // The equivalent plastic strain is what the strain has beyond its elastic part.
  const double expected = points.back().strain - points.back().stress / 210e9;
  for (double strain : element_plastic_strain(model, elements).values) CHECK_THAT(strain, WithinRel(expected, 5e-3));
  return points;
}

/// Slope of a straight line through the points between two stresses.
double slope(const std::vector<PullPoint>& points, double from, double to) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const PullPoint& p : points) {
    if (p.stress < from || p.stress > to) continue;
    n += 1, x += p.strain, y += p.stress, xx += p.strain * p.strain, xy += p.strain * p.stress;
  }
  REQUIRE(n > 10);
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace

TEST_CASE("a bar pulled past yield stiffens along its two slopes and keeps its energy account") {
  for (const auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    double imbalance = 1, plastic = 0;
    const auto points = pull(precision, imbalance, plastic);
    const double elastic_slope = slope(points, 50e6, 350e6), plastic_slope = slope(points, 440e6, 560e6);
    INFO("slopes " << elastic_slope << ", " << plastic_slope << "; imbalance " << imbalance << ", plastic " << plastic);
    CHECK_THAT(elastic_slope, WithinRel(210e9, 5e-3));
    CHECK_THAT(plastic_slope, WithinRel(tangent, 5e-3));
    CHECK(imbalance < 1e-3);
    // Work of the flow: the trapezium under the hardening line.
    const double hardening = 210e9 * tangent / (210e9 - tangent);
    const double flow = points.back().strain - points.back().stress / 210e9;
    CHECK_THAT(plastic, WithinRel((yield + 0.5 * hardening * flow) * flow, 1e-2));
  }
}

TEST_CASE("a bar that hits a wall spends its energy in plastic flow, and none is lost") {
  const double length = 0.032, width = 0.008, speed = 100;
  scene::Scene scene = block_scene({width, width, length}, {4, 4, 16}, 5e-5);
  scene.materials[0].yield_stress = yield;
  scene.materials[0].tangent_modulus = 1e9;
  scene.time.step_scale = 0.4;
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  hold(scene, "block.z_min", {false, false, true});
  Model model;
  build_model(scene, model);
  set_velocity(model, [&](const Vec3& x, int) { return Vec3{0, 0, x[2] > 0 ? -speed : 0}; });
  double first = 0, worst = 0, before = 0, least_growth = 0;
  march(model, model.step_count, [&] {
    const EnergyAccount energy = account_energies(model, model.step_size);
    const double total = balance_total(energy);
    if (model.step == 0) first = total;
    worst = std::max(worst, std::fabs(total - first) / first);
    least_growth = std::min(least_growth, energy.plastic - before);
    before = energy.plastic;
  });
  const EnergyAccount last = account_energies(model, model.step_size);
  const auto foot = model.assembly.node_sets.at("block.z_min"), top = model.assembly.node_sets.at("block.z_max");
  const auto half_width = [&](const std::vector<int>& nodes) {
    double low = 1, high = -1;
    const auto x = node_field(model, model.ties, NodeField::position, nodes).values;
    for (std::size_t k = 0; k < nodes.size(); ++k) low = std::min(low, x[3 * k]), high = std::max(high, x[3 * k]);
    return 0.5 * (high - low);
  };
  INFO("imbalance " << worst << ", plastic share " << last.plastic / first << ", hourglass " << last.hourglass / first
                    << ", internal " << last.internal / first << ", kinetic " << last.kinetic / first << ", foot "
                    << half_width(foot) << ", top " << half_width(top) << ", shortening "
                    << mean(model, NodeField::displacement, top)[2] / length);
  CHECK(worst < 1e-2);
  CHECK(least_growth >= 0);
  CHECK(last.plastic > 0.85 * first);
  CHECK(half_width(foot) > 1.1 * 0.5 * width);
  CHECK(half_width(top) < 1.01 * 0.5 * width);
  // Taylor's estimate of a bar's final length, exp(-rho v^2 / 2 sigma), is 0.907 of the first.
  const double shortening = -mean(model, NodeField::displacement, top)[2] / length;
  CHECK(shortening > 0.06);
  CHECK(shortening < 0.12);
}

TEST_CASE("only the parts that yield have history, and what is left out says so") {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {2, 2, 2}, 1e-5);
  Model elastic;
  build_model(scene, elastic);
  CHECK(elastic.left_out.front().rfind("plasticity", 0) == 0);
  CHECK(elastic.elements[0].material.history.extent(0) == 0);
  CHECK(element_plastic_strain(elastic, all_elements(elastic)).values == std::vector<double>(8, 0.0));
  scene.materials[0].yield_stress = yield;
  Model plastic;
  build_model(scene, plastic);
  for (const std::string& what : plastic.left_out) CHECK(what.rfind("plasticity", 0) != 0);
  CHECK(plastic.elements[0].material.flows());
  CHECK(device_bytes(plastic) > device_bytes(elastic));
}
