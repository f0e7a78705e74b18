#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <random>

#include "model/host_copy.hpp"
#include "solve/checkpoint/run_state.hpp"
#include "solve/time_loop.hpp"
#include "tests/solve/moved_blocks.hpp"
#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

int edges_of(const Model& model) {
  int sum = 0;
  for (const ElementGroup& group : model.elements) {
    const auto count = to_host(group.blocks.edge_count);
    for (std::size_t p = 0; p < count.extent(0); ++p) sum += count(p);
  }
  return sum;
}

/// Moves nodes of the model out of their places, the same whatever it computes with.
void distort(Model& model) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> spread(-1, 1);
  const auto position = to_host(model.nodes.position), velocity = to_host(model.nodes.velocity);
  for (int n = 0; n < model.nodes.count; ++n)
    for (int i = 0; i < 3; ++i) {
      position(n, i) += 2e-6 * spread(generator);
      velocity(n, i) = 0.1 * spread(generator);
    }
  Kokkos::deep_copy(model.nodes.position, position);
  Kokkos::deep_copy(model.nodes.velocity, velocity);
}

}  // namespace

TEST_CASE("blocks with edge groups move their nodes as blocks without") {
  if (on_device) SKIP("edge groups are for processors");
  scene::Scene scene = block_scene({0.019, 0.009, 0.007}, {19, 9, 7}, 2e-6);
  SECTION("viscous") {}
  SECTION("stiffness") { set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.1); }
  const auto end = [&](bool with_edges) {
    Model model;
    build_model(scene, model);
    CHECK(edges_of(model) > 0);
    if (!with_edges)
      for (ElementGroup& group : model.elements) group.blocks.edge_stride = 0;
    distort(model);
    run(model, {});
    return end_of(model);
  };
  const End with = end(true), without = end(false);
  REQUIRE(with.steps == without.steps);
  REQUIRE(with.steps > 10);
  double largest = 0, moved = 0;
  for (std::size_t k = 0; k < with.velocity.size(); ++k) {
    largest = std::fmax(largest, std::fabs(with.velocity[k] - without.velocity[k]));
    moved = std::fmax(moved, std::fabs(without.velocity[k]));
  }
  // Rounding of positions of 20 mm, 1e-18 m of elements of 1 mm, grows little in so few steps.
  CHECK(moved > 0.1);
  CHECK(largest > 0);
  CHECK(largest < 1e-10 * moved);
}

TEST_CASE("a state whose elements lie in another order is refused") {
  Model model;
  build_model(block_scene({0.004, 0.004, 0.004}, {4, 4, 4}, 1e-6), model);
  RunState state;
  save_model_state(model, state);
  CHECK_NOTHROW(restore_model_state(model, state));
  int found = 0;
  for (RunState::Values& values : state.values)
    if (values.name == "elements_in_rows") {
      values.bytes[0] ^= 1;
      ++found;
    }
  CHECK(found == 1);
  CHECK_THROWS_WITH(restore_model_state(model, state), Catch::Matchers::ContainsSubstring("order of elements"));
}
