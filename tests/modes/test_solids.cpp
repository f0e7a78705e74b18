#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/modes/mode_models.hpp"
#include "tests/modes/timoshenko.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

// Natural frequencies (Hz) of steel bodies against series values (E 210 GPa, nu 0.3, 7800 kg/m3). A one-point element
// bends only by its hourglass stiffness: a coefficient of about a quarter makes that of a cube right.
namespace {

/// @param worst share by which one of them may differ
void compare(const char* what, const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() >= expected.size());
  double worst = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    INFO(what << ", mode " << k + 1);
    CHECK_THAT(found[k], WithinRel(expected[k], 0.01));
    if (const double off = found[k] / expected[k] - 1; std::fabs(off) > std::fabs(worst)) worst = off;
  }
  WARN(what << ": the worst of " << expected.size() << " frequencies is off by " << 100 * worst << " %");
}

}  // namespace

TEST_CASE("Modes of a free cube", "[modes]") {
  // One eighth of it, its motion symmetric or antisymmetric about each of the planes that cut it out; three of the
  // eight kinds of symmetry differ from others by the axes' names only.
  std::vector<double> found;
  for (int antisymmetric = 0; antisymmetric <= 3; ++antisymmetric) {
    scene::Scene scene = mode_block({0.05, 0.05, 0.05}, {12, 12, 12}, 0.25);
    for (int axis = 0; axis < 3; ++axis) {
      std::array<bool, 3> held{false, false, false};
      held[axis] = true;
      if (axis < antisymmetric) held = {!held[0], !held[1], !held[2]};
      hold(scene, std::string("block.") + "xyz"[axis] + "_min", held);
    }
    const bool alike = antisymmetric == 0 || antisymmetric == 3;
    for (double f : elastic_frequencies(scene, 24700, alike ? 0 : 1)) found.insert(found.end(), alike ? 1 : 3, f);
  }
  std::sort(found.begin(), found.end());
  // Rayleigh and Ritz with polynomials of degree 11. 22754.15 is Lame's, c_s / (sqrt 2 L), exactly: one motion for each
  // pair of axes.
  std::vector<double> expected;
  for (const auto& [count, f] : std::vector<std::pair<int, double>>{
           {2, 14627.74}, {3, 19697.43}, {3, 20031.5}, {3, 22754.15}, {3, 23420.43}, {3, 24545.45}})
    expected.insert(expected.end(), count, f);
  CHECK(found.size() == expected.size());
  compare("free cube, 24 x 24 x 24 by eighths", found, expected);
}

TEST_CASE("Modes of a free beam", "[modes]") {
  const auto found = elastic_frequencies(mode_block({1, 0.05, 0.05}, {80, 8, 8}, 0.1), 2650, 6);
  compare("free beam, 80 x 8 x 8", found, {264.33, 264.33, 717.12, 717.12, 1374.95, 1374.95, 1477.69});
  CHECK_THAT(found.back(), WithinRel(2593.89, 0.01));  // axial
}

TEST_CASE("Modes of a free disc", "[modes]") {
  scene::Scene scene = mode_block({1, 1, 1}, {1, 1, 1}, 0.05);
  scene.meshes[0].type = scene::MeshType::cylinder;
  scene.meshes[0].cylinder = {0.46, 0.05, 16, 20, 6, 1, 0.35};
  // Nodal diameters and circles (2,0), (0,1), (3,0), (1,1), (4,0).
  compare("free disc, 6 elements through it", elastic_frequencies(scene, 1300, 6),
          {311.1, 311.1, 522.54, 709.9, 709.9, 1158.5, 1158.5, 1221.7, 1221.7});
}

TEST_CASE("Modes of a clamped beam", "[modes]") {
  scene::Scene scene = mode_block({1, 0.05, 0.05}, {80, 8, 8}, 0.1);
  hold(scene, "block.x_min", {true, true, true});
  const double nu = steel().poissons_ratio;
  const Cantilever exact{1, 0.05 * 0.05, std::pow(0.05, 4) / 12, 10 * (1 + nu) / (12 + 11 * nu), steel()};
  const auto f = exact.frequencies(3);
  compare("clamped beam, 80 x 8 x 8", elastic_frequencies(scene, 720, 0), {f[0], f[0], f[1], f[1], f[2], f[2]});
}

TEST_CASE("Modes of a clamped beam of beam elements", "[modes]") {
  scene::Scene scene = beam_scene({1, 0, 0}, 0.025, 40, 1e-3);
  clamp(scene, "root");
  // Modes are of parts: a small block, held, beside it.
  scene::Scene block = block_scene({0.01, 0.01, 0.01}, {1, 1, 1}, 1e-3);
  scene.meshes = block.meshes;
  scene.parts = block.parts;
  scene.parts[0].position = {0, 1, 0};
  hold(scene, "block", {true, true, true});
  const double nu = steel().poissons_ratio, area = M_PI * 0.025 * 0.025;
  const Cantilever exact{1, area, area * 0.025 * 0.025 / 4, 6 * (1 + nu) / (7 + 6 * nu), steel()};
  const auto f = exact.frequencies(2);
  compare("clamped beam of 40 beam elements", elastic_frequencies(scene, 300, 0), {f[0], f[0], f[1], f[1]});
}
