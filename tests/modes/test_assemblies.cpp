#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/modes/mode_models.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

TEST_CASE("Blocks tied over meshes that match vibrate as one block", "[modes]") {
  TiedBlocks blocks;
  blocks.coarse = blocks.fine = {4, 4, 4};
  const auto tied = elastic_frequencies(blocks.scene(1e-5), 30000, 6);
  const auto whole = elastic_frequencies(mode_block({0.06, 0.06, 0.12}, {4, 4, 8}, 0.05), 30000, 6);
  REQUIRE(tied.size() == whole.size());
  REQUIRE(tied.size() > 5);
  for (std::size_t k = 0; k < tied.size(); ++k) CHECK_THAT(tied[k], WithinRel(whole[k], 1e-8));
}

TEST_CASE("Blocks tied over meshes that don't match vibrate nearly as one block", "[modes]") {
  TiedBlocks blocks;
  blocks.coarse = {4, 4, 4};
  blocks.fine = {8, 8, 8};
  const auto tied = elastic_frequencies(blocks.scene(1e-5), 23000, 6);
  const auto whole = elastic_frequencies(mode_block({0.06, 0.06, 0.12}, {8, 8, 16}, 0.05), 23000, 6);
  REQUIRE(tied.size() >= 4);
  for (std::size_t k = 0; k < 4; ++k) CHECK_THAT(tied[k], WithinRel(whole[k], 0.03));
}

TEST_CASE("A block that slides on oblique planes vibrates as one that slides along the axes", "[modes]") {
  // Held along one direction only: by a plane's normal for the block as it lies, and for the block and the plane turned
  // alike.
  scene::Scene straight = mode_block({0.1, 0.06, 0.04}, {5, 3, 2}, 0.05), turned_one = straight;
  hold(straight, "block.x_min", {true, false, false});
  hold(turned_one, "block.x_min", {true, false, false});
  turned_one.parts[0].angle_of_attack = 0.3;
  turned_one.constraints[0].axes = {{{std::cos(0.3), std::sin(0.3), 0}, {-std::sin(0.3), std::cos(0.3), 0}, {0, 0, 1}}};
  const auto a = elastic_frequencies(straight, 40000, 3), b = elastic_frequencies(turned_one, 40000, 3);
  REQUIRE(a.size() == b.size());
  REQUIRE(a.size() > 5);
  for (std::size_t k = 0; k < a.size(); ++k) CHECK_THAT(b[k], WithinRel(a[k], 1e-8));
}

TEST_CASE("Two masses on springs", "[modes]") {
  // A block so stiff that it is a mass, and a point mass on it: f from the two by two problem along each axis.
  scene::Scene scene = mode_block({0.1, 0.1, 0.1}, {2, 2, 2}, 0.1);
  add_point(scene, "mass", 20, {0.05, 0.05, 0.3});
  add_spring(scene, "block", "mass", {0, 0, 2e5});
  add_spring(scene, "ground", "block", {0, 0, 1e6});
  const double m1 = 7.8, m2 = 20, k1 = 1e6, k2 = 2e5;
  const double trace = (k1 + k2) / m1 + k2 / m2, product = k1 * k2 / (m1 * m2),
               root = std::sqrt(trace * trace / 4 - product);
  // Rigid: two ways and three turns of the block, two ways of the mass.
  const auto f = elastic_frequencies(scene, 200, 7);
  REQUIRE(f.size() == 2);
  CHECK_THAT(f[0], WithinRel(std::sqrt(trace / 2 - root) / (2 * M_PI), 1e-4));
  CHECK_THAT(f[1], WithinRel(std::sqrt(trace / 2 + root) / (2 * M_PI), 1e-4));
}

TEST_CASE("Small pivots and springs of 1 to 1e8: a chain of masses and a body that is nearly free", "[modes]") {
  // The middle of the interval in which the chain's central modes are sought is all but twice k/m, the diagonal of
  // every mass: without pivoting the factors are of no use there. See eigenpairs_below for the intervals.
  constexpr int count = 244;
  constexpr double k = 3e8, mass = 0.7, soft = 1e-8;
  scene::Scene scene = mode_block({0.1, 0.1, 0.1}, {1, 1, 1}, 0.1);
  hold(scene, "block", {true, true, true});
  const auto add_mass = [&](const std::string& name, double x) {
    add_point(scene, name, mass, {x, 0, 1});
    hold(scene, name, {false, true, true});
  };
  for (int i = 0; i < count; ++i) {
    add_mass("m" + std::to_string(i), 0.1 * i);
    add_spring(scene, i == 0 ? "ground" : "m" + std::to_string(i - 1), "m" + std::to_string(i), {k, 0, 0});
  }
  add_spring(scene, "m" + std::to_string(count - 1), "ground", {k, 0, 0});
  add_mass("nearly_free", 100);
  add_spring(scene, "nearly_free", "ground", {soft * k, 0, 0});
  Model model;
  build_model(scene, model);

  std::vector<double> exact{std::sqrt(soft * k / mass) / (2 * M_PI)};
  for (int j = 1; j <= count; ++j) exact.push_back(std::sqrt(k / mass) / M_PI * std::sin(j * M_PI / (2 * (count + 1))));
  for (const double share : {0.0, 1e-12, 1e-9, 1e-7, 1e-3}) {
    const double limit = 2 * k / mass / 0.40625 * (1 - share);
    const ModeList list = modes_below(model, std::sqrt(limit) / (2 * M_PI));
    INFO("off by " << share << ": relative residual " << list.solves.before << ", " << list.solves.after << " after "
                   << list.solves.refinements);
    CHECK(list.solves.after < 1e-8);
    REQUIRE(list.modes.size() == exact.size());
    double worst = 0;
    for (std::size_t j = 0; j < exact.size(); ++j)
      worst = std::max(worst, std::fabs(list.modes[j].frequency / exact[j] - 1));
    CHECK(worst < 1e-9);
  }
}
