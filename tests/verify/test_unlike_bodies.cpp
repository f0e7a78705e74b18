// Contact by multipliers between bodies of very unlike stiffness and density.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fstream>

#include "library/simulation.hpp"
#include "tests/temporary_folder.hpp"

using namespace railwave;

namespace {

/// A steel cube that falls on foam, which weighs next to nothing.
const std::string steel_on_foam = R"(
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[materials.foam]
youngs_modulus = 1e5
poissons_ratio = 0.1
density = 30
[meshes.plate]
type = "box"
size = [0.1, 0.1, 0.05]
divisions = [4, 4, 3]
[meshes.cube]
type = "box"
size = [0.05, 0.05, 0.05]
divisions = [4, 4, 4]
[parts.plate]
mesh = "plate"
material = "foam"
[parts.cube]
mesh = "cube"
material = "steel"
position = [0.025, 0.025, 0.050001]
[node_sets.all]
part = "cube"
box = [[-1, -1, -1], [1, 1, 1]]
[constraints.floor]
target = "plate.z_min"
fixed = ["x", "y", "z"]
[initial_motion.fall]
parts = ["cube"]
velocity = [0, 0, -0.5]
[time]
end = 2e-5
[output]
history_sets = ["cube.all"]
[contacts.blow]
friction = 0.2
)";

void check_blow(const std::string& sides) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "blow.toml").string();
  std::ofstream(path) << steel_on_foam << sides;
  Simulation run(path, 1e-9);  // a step each
  const double mass = 7800 * 0.05 * 0.05 * 0.05, before = run.values("energy.kinetic")[0];
  double impulse = 0, largest = 0, time = 0, worst = 0, step = 0;
  const double upwards = sides.find("slave = \"cube") == 0 ? 1 : -1;  // of what acts on the slave
  while (run.time() < 1.9e-5) {
    const double force = upwards * run.values("contact.blow.normal_force")[2];
    largest = std::max(largest, force);
    worst = std::max(worst, std::fabs(upwards * run.values("contact.blow.master_force")[2] + force));
    run.advance();
    impulse += 0.5 * (step + run.time() - time) * force;
    step = run.time() - time;
    time = run.time();
  }
  INFO("largest force " << largest << " N, both sides differ by " << worst << " N");
  CHECK(largest > 100);
  CHECK(worst < 0.01 * largest);  // but for what friction has along z on faces that tilt
  // It bounces off nothing: the cube has lost what it gave, and what was given went as far as it was booked.
  const double lost = mass * (run.values("set.cube.all.velocity")[2] + 0.5);
  CHECK(std::fabs(lost - impulse) < 0.01 * impulse);
  const double given = before - run.values("energy.kinetic")[0];
  INFO("imbalance " << run.values("energy.balance_error")[0] << " J of " << given << " J");
  CHECK(given > 1e-5);
  CHECK(std::fabs(run.values("energy.balance_error")[0]) < 0.02 * given);
}

}  // namespace

TEST_CASE("a stiff body's blow on a soft one is as hard on both sides, whichever is the slave") {
  SECTION("the stiff one") { check_blow("slave = \"cube.z_min\"\nmaster = \"plate.z_max\"\n"); }
  SECTION("the soft one") { check_blow("slave = \"plate.z_max\"\nmaster = \"cube.z_min\"\n"); }
}
