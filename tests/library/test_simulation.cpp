#include "library/simulation.hpp"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "case/error.hpp"
#include "tests/library/driven_block.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;

namespace {

constexpr double window = 2e-5;
constexpr double mass = 7.8;  // kg

struct Block {
  TemporaryFolder folder;
  std::string path;
  Block() : path((folder.path() / "block.toml").string()) { std::ofstream(path) << verify::driven_block; }
};

/// Velocities of so many windows, the force growing from one to the next.
std::vector<double> velocities(Simulation& run, int windows) {
  std::vector<double> found;
  for (int k = 0; k < windows; ++k) {
    run.drive("pull", 1000.0 * (k % 5));
    run.advance();
    found.push_back(run.values("set.block.z_max.velocity")[2]);
  }
  return found;
}

}  // namespace

TEST_CASE("a driven force accelerates a block") {
  const Block block;
  Simulation run(block.path, window);
  CHECK(run.time() == 0);
  run.drive("pull", 5000);
  REQUIRE(run.advance());
  CHECK(run.time() == Catch::Approx(window).epsilon(0.2));  // whole steps
  const double first = run.time();
  CHECK(run.values("load.pull.force")[2] == Catch::Approx(5000).epsilon(1e-9));
  while (run.time() < 40 * window) run.advance();
  // What was pushed on it: a ramp over one window, then all of it.
  const double impulse = 5000 * (run.time() - 0.5 * first);
  const auto moved = run.field("displacement", "block");
  double mean = 0;
  for (std::size_t n = 2; n < moved.size(); n += 3) mean += moved[n] / (static_cast<double>(moved.size()) / 3);
  CHECK(mean == Catch::Approx(0.5 * impulse * run.time() / mass).epsilon(0.05));
  CHECK(run.coordinates("block").size() == moved.size());
  CHECK(run.field("stress", "block").size() == 27 * 6);
}

TEST_CASE("a state that is restored goes on as it did, bit for bit") {
  const Block block;
  Simulation run(block.path, window);
  velocities(run, 7);
  const SimulationState state = run.save();
  const double time = run.time();
  const std::vector<double> stress = run.field("stress", "block");
  const std::vector<double> first = velocities(run, 8);
  run.drive("pull", -1e5);
  run.advance();
  run.restore(state);
  CHECK(run.time() == time);
  CHECK(run.field("stress", "block") == stress);
  CHECK(velocities(run, 8) == first);
}

TEST_CASE("a simulation ends where its case does") {
  const Block block;
  Simulation run(block.path, window, {"time.end=1e-4"});
  const SimulationState state = run.save();
  while (run.advance()) {
  }
  CHECK(run.end() == "completed");
  CHECK(run.time() == Catch::Approx(1e-4).epsilon(0.05));
  CHECK_THROWS_WITH(run.advance(), ContainsSubstring("has ended: completed"));
  run.restore(state);
  CHECK(run.end().empty());
  CHECK(run.advance());
}

TEST_CASE("what a simulation does not have is named with what it has") {
  const Block block;
  Simulation run(block.path, window);
  CHECK_THROWS_WITH(run.values("set.block.velocity"), ContainsSubstring("known are energy.kinetic"));
  CHECK_THROWS_WITH(run.drive("push", 1), ContainsSubstring("no curve push") && ContainsSubstring("pull"));
  CHECK_THROWS_WITH(run.drive("pull", std::nan("")), ContainsSubstring("a finite number is wanted"));
  CHECK_THROWS_WITH(run.field("velocity", "block"), ContainsSubstring("displacement of block"));
  CHECK_THROWS_AS(Simulation(block.path, 0.0), InputError);
  CHECK_THROWS_WITH(Simulation(block.path, window, {"time.ende=1"}), ContainsSubstring("ende"));
}
