// Every output holds at the instant that it is given for, although the scheme has velocities half a step before.
// Against exact motions at two steps: what was of another instant by a share of the step would fall with the step, and
// what is of its own falls with the square.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include "library/simulation.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double mass = 7.8;     // kg
constexpr double window = 4e-5;  // s
constexpr double spring = 1.5e8, speed = 2, spin = 300;

/// A block of 0.1 m with a spring from all of it to the ground along x, which keeps it rigid.
const std::string block_on_spring = R"(
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.block]
type = "box"
size = [0.1, 0.1, 0.1]
divisions = [2, 2, 2]
[parts.block]
mesh = "block"
material = "steel"
[node_sets.all]
part = "block"
box = [[-1, -1, -1], [1, 1, 1]]
[connectors.spring]
from = "ground"
to = "block.all"
stiffness = [1.5e8, 0, 0]
[probes.corner]
part = "block"
position = [0.1, 0.1, 0.1]
quantities = ["displacement", "velocity", "acceleration"]
[time]
end = 1e-3
[output]
history_sets = ["block.all"]
field_sets = ["block"]
fields = ["velocity", "acceleration"]
)";

class Case {
 public:
  explicit Case(const std::string& text) : path_((folder_.path() / "block.toml").string()) {
    std::ofstream(path_) << text;
  }
  const std::string& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

/// What is asked of a simulation at an instant, less what it should be.
using Deviations = std::function<std::map<std::string, double>(const Simulation& run, double time)>;

std::map<std::string, double> worst_of(const Case& scene, double step, const Deviations& deviations) {
  Simulation run(scene.path(), window, {"time.step=" + std::to_string(1e6 * step) + "e-6"});
  std::map<std::string, double> worst;
  while (run.time() < 9.5e-4) {
    run.advance();
    for (const auto& [name, off] : deviations(run, run.time())) worst[name] = std::max(worst[name], std::fabs(off));
  }
  return worst;
}

/// Each falls to a quarter with half the step, or is there to rounding.
void check_second_order(const Case& scene, const std::map<std::string, double>& size, const Deviations& deviations) {
  const auto coarse = worst_of(scene, 4e-6, deviations), fine = worst_of(scene, 2e-6, deviations);
  for (const auto& [name, off] : coarse) {
    const double rounding = 1e-9 * size.at(name);
    INFO(name << ": off by " << off << " and " << fine.at(name) << " of " << size.at(name));
    if (off < rounding) continue;
    CHECK(off < 2e-3 * size.at(name));
    CHECK_THAT(off / fine.at(name), WithinAbs(4, 0.3));
  }
}

double along_x(const Simulation& run, const std::string& name) { return run.values(name)[0]; }

}  // namespace

TEST_CASE("velocities and energies of what moves freely are those of the output's instant, to second order") {
  const Case scene(block_on_spring + R"(
[initial_motion.thrown]
parts = ["block"]
velocity = [2, 0, 0]
)");
  const double w = std::sqrt(spring / mass);
  check_second_order(scene,
                     {{"velocity", speed},
                      {"velocity of a point", speed},
                      {"field of velocities", speed},
                      {"acceleration", speed * w},
                      {"field of accelerations", speed * w},
                      {"kinetic energy", 0.5 * mass * speed * speed}},
                     [w](const Simulation& run, double t) {
                       const double v = speed * std::cos(w * t), a = -speed * w * std::sin(w * t);
                       return std::map<std::string, double>{
                           {"velocity", along_x(run, "set.block.all.velocity") - v},
                           {"velocity of a point", along_x(run, "set.block.corner.velocity") - v},
                           {"field of velocities", run.field("velocity", "block")[0] - v},
                           {"acceleration", along_x(run, "set.block.all.acceleration") - a},
                           {"field of accelerations", run.field("acceleration", "block")[0] - a},
                           {"kinetic energy", run.values("energy.kinetic")[0] - 0.5 * mass * v * v}};
                     });
}

TEST_CASE("of nodes whose motion is prescribed too, with the work that it takes") {
  const std::string driven = R"(
[curves.push]
type = "half_sine"
duration = 1.2e-3
[prescribed_motion.driver]
target = "block.all"
curve = "push"
)";
  const double w = M_PI / 1.2e-3;
  const Case pushed(block_on_spring + driven + "velocity = [2, 0, 0]\n");
  check_second_order(pushed,
                     {{"velocity", speed},
                      {"velocity of a point", speed},
                      {"field of velocities", speed},
                      {"acceleration", speed * w},
                      {"field of accelerations", speed * w},
                      {"kinetic energy", 0.5 * mass * speed * speed},
                      {"external work", 0.5 * mass * speed * speed},
                      {"work of the motion", 0.5 * mass * speed * speed},
                      {"reaction", mass * speed * w}},
                     [w](const Simulation& run, double t) {
                       const double v = speed * std::sin(w * t), a = speed * w * std::cos(w * t);
                       const double u = speed / w * (1 - std::cos(w * t));
                       const double work = 0.5 * mass * v * v + 0.5 * spring * u * u;
                       return std::map<std::string, double>{
                           {"velocity", along_x(run, "set.block.all.velocity") - v},
                           {"velocity of a point", along_x(run, "set.block.corner.velocity") - v},
                           {"field of velocities", run.field("velocity", "block")[0] - v},
                           {"acceleration", along_x(run, "set.block.all.acceleration") - a},
                           {"field of accelerations", run.field("acceleration", "block")[0] - a},
                           {"kinetic energy", run.values("energy.kinetic")[0] - 0.5 * mass * v * v},
                           {"external work", run.values("energy.external_work")[0] - work},
                           {"work of the motion", run.values("prescribed_motion.driver.work")[0] - work},
                           {"reaction", along_x(run, "prescribed_motion.driver.reaction") - (mass * a + spring * u)}};
                     });
}

TEST_CASE("of nodes that a prescribed motion turns: the first one lies opposite to the probe's corner") {
  const Case turned(block_on_spring + R"(
[curves.turn]
type = "half_sine"
duration = 1.2e-3
[prescribed_motion.driver]
target = "block.all"
curve = "turn"
angular_velocity = [0, 0, 300]
)");
  const double w = M_PI / 1.2e-3;
  check_second_order(turned,
                     {{"velocity of a point", spin * 0.05},
                      {"field of velocities", spin * 0.05},
                      {"acceleration of a point", spin * 0.05 * w},
                      {"field of accelerations", spin * 0.05 * w}},
                     [w](const Simulation& run, double t) {
                       const double rate = spin * std::sin(w * t), growth = spin * w * std::cos(w * t);
                       const double angle = M_PI / 4 + spin / w * (1 - std::cos(w * t)), arm = 0.05 * std::sqrt(2.0);
                       const double v = -rate * arm * std::sin(angle);
                       const double a = -growth * arm * std::sin(angle) - rate * rate * arm * std::cos(angle);
                       return std::map<std::string, double>{
                           {"velocity of a point", along_x(run, "set.block.corner.velocity") - v},
                           {"field of velocities", run.field("velocity", "block")[0] + v},
                           {"acceleration of a point", along_x(run, "set.block.corner.acceleration") - a},
                           {"field of accelerations", run.field("acceleration", "block")[0] + a}};
                     });
}

TEST_CASE("of nodes that go to a place along a cosine, across while they are free along the spring") {
  constexpr double way = 1e-4, lasts = 8e-4, w = M_PI / lasts;
  const Case moved(block_on_spring + R"(
[curves.go]
type = "cosine_ramp"
duration = 8e-4
[prescribed_motion.driver]
target = "block.all"
displacement = [0, 1e-4, 0]
displacement_curve = "go"
directions = ["y"]
[initial_motion.thrown]
parts = ["block"]
velocity = [2, 0, 0]
)");
  const double free = std::sqrt(spring / mass);
  check_second_order(moved,
                     {{"velocity", way * w},
                      {"field of velocities", way * w},
                      {"acceleration", way * w * w},
                      {"field of accelerations", way * w * w},
                      {"velocity along the spring", speed},
                      {"kinetic energy", 0.5 * mass * speed * speed}},
                     [free](const Simulation& run, double t) {
                       const bool there = t > lasts + 1e-9;  // at its end still the acceleration of before
                       const double v = there ? 0 : 0.5 * way * w * std::sin(w * t),
                                    a = there ? 0 : 0.5 * way * w * w * std::cos(w * t);
                       const double along = speed * std::cos(free * t);
                       return std::map<std::string, double>{
                           {"velocity", run.values("set.block.all.velocity")[1] - v},
                           {"field of velocities", run.field("velocity", "block")[1] - v},
                           {"acceleration", run.values("set.block.all.acceleration")[1] - a},
                           {"field of accelerations", run.field("acceleration", "block")[1] - a},
                           {"velocity along the spring", run.field("velocity", "block")[0] - along},
                           {"kinetic energy", run.values("energy.kinetic")[0] - 0.5 * mass * (v * v + along * along)}};
                     });
}

TEST_CASE("what is driven window by window has the window's velocity, acceleration and reaction at its end") {
  const std::string driven = R"(
[curves.given]
type = "table"
points = [[0, 0]]
[prescribed_motion.driver]
target = "block.all"
)";
  const auto reaction_at = [](const Simulation& run, double a) {
    return mass * a + spring * along_x(run, "set.block.all.displacement");
  };
  SECTION("a velocity") {
    const Case scene(block_on_spring + driven + "curve = \"given\"\nvelocity = [1, 0, 0]\n");
    Simulation run(scene.path(), window);
    for (const double v : {0.5, 2.0, -1.0, 0.25}) {
      const double before = along_x(run, "set.block.all.velocity"), began = run.time();
      run.drive("given", v);
      run.advance();
      const double a = (v - before) / (run.time() - began);
      CHECK_THAT(along_x(run, "set.block.all.velocity"), WithinAbs(v, 1e-9));
      CHECK_THAT(run.field("velocity", "block")[0], WithinAbs(v, 1e-9));
      CHECK_THAT(along_x(run, "set.block.all.acceleration"), WithinRel(a, 1e-9));
      CHECK_THAT(run.field("acceleration", "block")[0], WithinRel(a, 1e-9));
      CHECK_THAT(along_x(run, "prescribed_motion.driver.reaction"), WithinRel(reaction_at(run, a), 1e-9));
      CHECK_THAT(run.values("energy.kinetic")[0], WithinRel(0.5 * mass * v * v, 1e-9));
      CHECK(std::fabs(run.values("energy.balance_error")[0]) < 1e-3 * mass);
    }
  }
  SECTION("a displacement") {
    const Case scene(block_on_spring + driven + "displacement_curve = \"given\"\ndisplacement = [1, 0, 0]\n");
    Simulation run(scene.path(), window);
    double before = 0;
    for (const double u : {2e-5, 1e-4, -3e-5}) {
      const double began = run.time();
      run.drive("given", u);
      run.advance();
      const double v = (u - before) / (run.time() - began);
      before = u;
      CHECK_THAT(along_x(run, "set.block.all.displacement"), WithinRel(u, 1e-9));
      CHECK_THAT(along_x(run, "set.block.all.velocity"), WithinRel(v, 1e-9));
      CHECK_THAT(run.field("velocity", "block")[0], WithinRel(v, 1e-9));
      CHECK_THAT(along_x(run, "prescribed_motion.driver.reaction"), WithinRel(reaction_at(run, 0), 1e-9));
      CHECK_THAT(run.values("energy.kinetic")[0], WithinRel(0.5 * mass * v * v, 1e-9));
      CHECK(std::fabs(run.values("energy.balance_error")[0]) < 1e-3 * mass * v * v);
    }
  }
}
