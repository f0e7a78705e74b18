// What loads and prescribed motions do is among the histories: work of a load, reaction and work of a prescribed
// motion.
#include <algorithm>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fstream>

#include "library/simulation.hpp"
#include "tests/library/driven_block.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;
using Catch::Approx;

namespace {

constexpr double mass = 7.8;          // kg, of driven_block
constexpr double acceleration = 2e3;  // m/s2
constexpr double gravity = 9.81;

/// The block without its load; what moves `target` along z, at a speed that grows evenly from nothing.
std::string moved_block(const std::string& target, const std::string& directions) {
  std::string text = verify::driven_block;
  text.erase(text.find("[curves.pull]"), text.find("[time]") - text.find("[curves.pull]"));
  return text + R"([node_sets.all]
part = "block"
box = [[-1, -1, -1], [1, 1, 1]]
[gravity]
acceleration = [0, 0, -9.81]
[curves.faster]
type = "table"
points = [[0, 0], [1, 2000]]
[prescribed_motion.lift]
curve = "faster"
velocity = [0, 0, 1]
target = ")" +
         target + "\"\ndirections = " + directions + "\n";
}

struct Case {
  TemporaryFolder folder;
  std::string path;
  explicit Case(const std::string& text) : path((folder.path() / "block.toml").string()) {
    std::ofstream(path) << text;
  }
};

double vertical(const Simulation& run, const std::string& name) { return run.values(name)[2]; }

}  // namespace

TEST_CASE("what lifts all of a block is its mass times acceleration and gravity") {
  const Case rigid(moved_block("block.all", R"(["x", "y", "z"])"));
  Simulation run(rigid.path, 1e-5);
  for (int k = 0; k < 20; ++k) {
    run.advance();
    // Weight and inertia: rounding of places, over the step's square, is 1e-17 / 1e-11 of the acceleration.
    CHECK(vertical(run, "prescribed_motion.lift.reaction") == Approx(mass * (acceleration + gravity)).epsilon(1e-7));
    CHECK(std::fabs(run.values("prescribed_motion.lift.reaction")[0]) < 1e-6 * mass * acceleration);
    // As it moves, at the instant: not half a step late, nor as its nodes would move without what moves them.
    CHECK(vertical(run, "set.block.z_max.velocity") == Approx(acceleration * run.time()).epsilon(1e-7));
    CHECK(vertical(run, "set.block.z_max.acceleration") == Approx(acceleration).epsilon(1e-7));
  }
}

TEST_CASE("the impulse of a reaction is the momentum of the body that it moves") {
  const Case elastic(moved_block("block.z_min", R"(["z"])"));
  Simulation run(elastic.path, 1e-9, {"output.history_sets=[\"block.all\"]"});  // a step each
  double impulse = 0, place = 0, step = 0, largest = 0;
  while (run.time() < 5e-4) {
    // What acts at an instant does so from the middle of the step before to that of the step behind.
    const double time = run.time(), force = vertical(run, "prescribed_motion.lift.reaction") - mass * gravity;
    run.advance();
    impulse += 0.5 * (step + run.time() - time) * force;
    step = run.time() - time;
    largest = std::max(largest, std::fabs(force));
    const double now = vertical(run, "set.block.all.displacement");
    const double momentum = mass * (now - place) / step;  // momentum in the middle of the step
    place = now;
    CHECK(momentum == Approx(impulse).margin(1e-9 * largest * 5e-4));
  }
  CHECK(impulse == Approx(mass * acceleration * run.time()).epsilon(0.1));  // but for the block's own vibration
  CHECK(largest > 1.2 * mass * acceleration);                               // which is there
}

TEST_CASE("works of prescribed motions and of loads are the account's external work") {
  const Case lifted(moved_block("block.z_min", R"(["z"])"));
  Simulation lift(lifted.path, 1e-5, {"output.history_sets=[\"block.all\"]"});
  const Case pulled(verify::driven_block);
  Simulation pull(pulled.path, 1e-5);
  for (int k = 0; k < 30; ++k) {
    lift.advance();
    const double sunk = vertical(lift, "set.block.all.displacement");
    CHECK(lift.values("prescribed_motion.lift.work")[0] - mass * gravity * sunk ==
          Approx(lift.values("energy.external_work")[0]).epsilon(1e-12));
    CHECK(std::fabs(lift.values("energy.balance_error")[0]) < 1e-3 * lift.values("energy.external_work")[0]);
    pull.drive("pull", 1e3 * (k % 4));
    pull.advance();
    CHECK(pull.values("load.pull.work")[0] == pull.values("energy.external_work")[0]);
  }
  CHECK(pull.values("load.pull.work")[0] > 0);
}
