#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cstring>

#include "output/settled_file.hpp"
#include "solve/statics/settle.hpp"
#include "solve/time_loop.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

/// A small block on a larger one under its weight, with friction.
std::string two_blocks(const std::string& algorithm, const std::string& method) {
  return R"([materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.upper]
type = "box"
size = [0.04, 0.04, 0.01]
divisions = [5, 7, 2]
[meshes.lower]
type = "box"
size = [0.08, 0.08, 0.02]
divisions = [8, 8, 3]
[parts.upper]
mesh = "upper"
material = "steel"
hourglass = "stiffness"
position = [-0.02, -0.02, 0]
[parts.lower]
mesh = "lower"
material = "steel"
hourglass = "stiffness"
position = [-0.04, -0.04, -0.02]
[constraints.ground]
target = "lower.z_min"
fixed = ["x", "y", "z"]
[contacts.touch]
slave = "upper.z_min"
master = "lower.z_max"
friction = 0.3
algorithm = ")" +
         algorithm + R"("
[gravity]
acceleration = [0, 0, -1e5]
[initial_motion.slide]
parts = ["upper"]
velocity = [1, 0, 0]
[settle]
method = ")" +
         method + R"("
tolerance = 1e-4
[time]
end = 2e-5
step_scale = 0.6
)";
}

/// What a joint is made of: a fine block tied into a rail-like one between non-reflecting ends on springs, a block that
/// presses on it with friction, and a bolt through the rail with its pretension.
std::string assembly(const std::string& method) {
  return R"([materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.rail]
type = "box"
size = [0.24, 0.06, 0.06]
divisions = [12, 3, 3]
[meshes.zone]
type = "box"
size = [0.06, 0.06, 0.02]
divisions = [7, 7, 2]
[meshes.upper]
type = "box"
size = [0.03, 0.03, 0.01]
divisions = [4, 4, 2]
[parts.rail]
mesh = "rail"
material = "steel"
hourglass = "stiffness"
[parts.zone]
mesh = "zone"
material = "steel"
hourglass = "stiffness"
position = [0.05, 0, 0.06]
[parts.upper]
mesh = "upper"
material = "steel"
hourglass = "stiffness"
position = [0.063, 0.014, 0.08]
[ties.zone]
slave = "zone.z_min"
master = "rail.z_max"
[non_reflecting.near]
target = "rail.x_min"
[non_reflecting.far]
target = "rail.x_max"
[node_sets.under_head]
part = "rail"
surface = "z_max"
box = [[0.155, 0, 0], [0.205, 1, 1]]
[node_sets.under_nut]
part = "rail"
surface = "z_min"
box = [[0.155, 0, -1], [0.205, 1, 1]]
[points.head]
mass = 0
position = [0.18, 0.03, 0.08]
[points.nut]
mass = 0.1
position = [0.18, 0.03, -0.02]
[beams.shank]
from = "nut"
to = "head"
material = "steel"
radius = 0.012
divisions = 4
pretension = 12500
[beams.washer]
from = "head"
to = "rail.under_head"
material = "steel"
radius = 0.01
[beams.washer_below]
from = "nut"
to = "rail.under_nut"
material = "steel"
radius = 0.01
[connectors.bed]
from = "ground"
to = "rail.z_min"
stiffness = [0, 0, 1e8]
spread = [4, 1]
[contacts.touch]
slave = "upper.z_min"
master = "zone.z_max"
friction = 0.3
[loads.press]
type = "nodal_force"
target = "upper.z_max"
force = [0, 0, -2000]
[gravity]
acceleration = [0, 0, -1000]
[settle]
method = ")" +
         method + R"("
tolerance = 1e-5
max_steps = 100000
[time]
end = 2e-5
step_scale = 0.6
)";
}

struct Recorder : RunObserver {
  std::vector<HistorySample> samples;
  SettleReport report;
  void settled(const Model&, const SettleReport& settled_report) override { report = settled_report; }
  void history(const Model&, const HistorySample& sample) override { samples.push_back(sample); }
};

/// A run of a case with its states kept beside it.
Recorder run_case(const test::TemporaryCase& file, std::vector<std::string> overrides = {}) {
  overrides.push_back("output.file=" + (file.folder() / "results.h5").string());
  const scene::Scene scene = read_case(file.path(), overrides);
  Model model;
  build_model(scene, model);
  Recorder recorder;
  SettledFiles settled("test");
  run(model, {&recorder}, &settled);
  return recorder;
}

bool bitwise_equal(const Recorder& a, const Recorder& b) {
  if (a.samples.size() != b.samples.size()) return false;
  for (std::size_t k = 0; k < a.samples.size(); ++k) {
    if (std::memcmp(&a.samples[k].energy, &b.samples[k].energy, sizeof(EnergyAccount)) != 0) return false;
    for (std::size_t c = 0; c < a.samples[k].beams.size(); ++c)
      if (a.samples[k].beams[c].force != b.samples[k].beams[c].force ||
          a.samples[k].beams[c].moment != b.samples[k].beams[c].moment)
        return false;
    for (std::size_t c = 0; c < a.samples[k].contacts.size(); ++c) {
      const ContactTotals &one = a.samples[k].contacts[c], &other = b.samples[k].contacts[c];
      if (one.normal_force != other.normal_force || one.tangential_force != other.tangential_force ||
          one.nodes_in_contact != other.nodes_in_contact || one.nodes_slipping != other.nodes_slipping)
        return false;
    }
  }
  return true;
}

std::filesystem::path kept_file(const test::TemporaryCase& file) {
  for (const auto& entry : std::filesystem::directory_iterator(file.folder()))
    if (entry.path().filename().string().rfind("settled-", 0) == 0) return entry.path();
  return {};
}

}  // namespace

TEST_CASE("a run from the kept state is bitwise the run that settled itself") {
  for (const char* algorithm : {"penalty", "multiplier"})
    for (const char* method : {"newton", "relaxation"}) {
      INFO(algorithm << ", " << method);
      const test::TemporaryCase file(two_blocks(algorithm, method));
      const Recorder first = run_case(file), second = run_case(file), without = run_case(file, {"settle.cache=false"});
      REQUIRE(first.report.settled);
      CHECK(first.report.taken_from.empty());
      CHECK(first.report.steps > 0);
      CHECK(second.report.settled);
      CHECK(second.report.taken_from == kept_file(file).string());
      CHECK(second.report.steps == 0);
      CHECK(without.report.taken_from.empty());
      CHECK(first.samples.size() > 10);
      CHECK(bitwise_equal(first, second));
      CHECK(bitwise_equal(first, without));
    }
}

TEST_CASE(
    "the kept state covers bolts, ties, ends, springs and contact: a run from it is bitwise the one that settled "
    "itself") {
  for (const char* method : {"newton", "relaxation"}) {
    INFO(method);
    const test::TemporaryCase file(assembly(method));
    const Recorder first = run_case(file), second = run_case(file);
    INFO(first.report.steps << " evaluations in " << first.report.iterations << " steps, unbalance "
                            << first.report.unbalance << "; " << first.report.adrift);
    WARN(method << ": " << first.report.steps << " evaluations in " << first.report.iterations << " steps");
    REQUIRE(first.report.settled);
    CHECK(second.report.taken_from == kept_file(file).string());
    CHECK(second.report.steps == 0);
    REQUIRE(first.samples.size() > 10);
    CHECK(bitwise_equal(first, second));
    // It begins at rest: the bolt with its pretension, the upper block with its weight on the zone.
    const double weight = 2000 + 1e3 * 7800 * 0.03 * 0.03 * 0.01;
    for (const HistorySample& sample : first.samples) {
      for (int e = 0; e < 4; ++e) CHECK(std::fabs(sample.beams[0].force[3 * e] / 12500 - 1) < 0.02);
      CHECK(std::fabs(sample.contacts[0].normal_force[2] / weight - 1) < 5e-3);
    }
  }
}

TEST_CASE("the kept state holds for other times and velocities, for no other loads, meshes or precision") {
  const test::TemporaryCase file(two_blocks("penalty", "newton"));
  run_case(file);
  CHECK(run_case(file, {"time.end=1e-5", "title=other", "initial_motion.slide.velocity=[2, 0, 0]",
                        "output.history_interval=1e-6"})
            .report.taken_from != "");
  for (const char* change :
       {"gravity.acceleration=[0, 0, -1.1e5]", "solver.precision=mixed", "meshes.upper.divisions=[5, 6, 2]",
        "contacts.touch.friction=0.2", "settle.tolerance=2e-4"}) {
    INFO(change);
    CHECK(run_case(file, {change}).report.taken_from.empty());
  }
}

TEST_CASE("a damaged state is reported and settled anew") {
  const test::TemporaryCase file(two_blocks("penalty", "newton"));
  const Recorder first = run_case(file);
  const auto kept = kept_file(file);
  const std::string sound = text_of(kept);
  for (int kind = 0; kind < 3; ++kind) {
    std::string damaged = sound;
    if (kind == 0) damaged.resize(damaged.size() / 2);
    if (kind == 1) damaged = "not HDF5 at all";
    if (kind == 2) {
      // A bit of a place, where it lies in the file: 0.04 is a corner's coordinate of the lower block.
      const double corner = -0.04;
      char bytes[sizeof corner];
      std::memcpy(bytes, &corner, sizeof corner);
      const auto at = damaged.find(std::string(bytes, sizeof corner));
      REQUIRE(at != std::string::npos);
      damaged[at] = static_cast<char>(damaged[at] ^ 1);
    }
    file.write(kept.filename().string(), damaged);
    const Recorder again = run_case(file);
    // A text is somebody's own: it stays.
    REQUIRE(again.report.remarks.size() == (kind == 1 ? 2 : 1));
    if (kind == 1)
      CHECK_THAT(again.report.remarks[1],
                 ContainsSubstring("could not be kept") && ContainsSubstring("is there already"));
    CHECK_THAT(again.report.remarks[0], ContainsSubstring(kept.string()) && ContainsSubstring("cannot be used") &&
                                            ContainsSubstring("settles anew"));
    if (kind == 2) CHECK_THAT(again.report.remarks[0], ContainsSubstring("checksum"));
    CHECK(again.report.taken_from.empty());
    CHECK(bitwise_equal(first, again));
    if (kind == 1)
      CHECK(text_of(kept) == damaged);
    else
      CHECK(text_of(kept).size() == sound.size());  // and the file is sound again
  }
}

TEST_CASE("settling that was stopped goes on from its last state") {
  for (const char* method : {"newton", "relaxation"}) {
    INFO(method);
    const test::TemporaryCase file(two_blocks("penalty", method));
    const scene::Scene scene = read_case(file.path(), {"output.file=" + (file.folder() / "results.h5").string()});
    SettledFiles settled("test");
    int whole = 0, done = 0;
    {
      Model model;
      build_model(scene, model);
      whole = settle(model, [](const auto&) { return true; }).steps;
    }
    {
      Model model;
      build_model(scene, model);
      const SettleReport report =
          come_to_rest(model, &settled, [&](const SettleReport& so_far) { return so_far.steps < whole / 2; });
      CHECK_FALSE(report.settled);
      done = report.steps;
    }
    CHECK(done > 0);
    Model model;
    build_model(scene, model);
    const SettleReport report = come_to_rest(model, &settled, [](const auto&) { return true; });
    CHECK(report.settled);
    CHECK(report.begun_from == kept_file(file).string());
    CHECK(report.steps < whole);
  }
}

TEST_CASE("scenes that roll at other speeds have settled states of their own") {
  // Centrifugal forces of 1 m/s and 60 m/s on a roller's sector differ, and so do their equilibria.
  const test::TemporaryCase file(R"([materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.roller]
type = "roller"
radius = 0.4
bore_radius = 0.36
arc_start = -0.03
arc_end = 0.03
zone_size = 0.004
coarse_size = 0.02
zone_layers = 2
[parts.roller]
mesh = "roller"
material = "steel"
hourglass = "stiffness"
[constraints.bore]
target = "roller.bore"
fixed = ["y"]
[connectors.axle]
from = "ground"
to = "roller.bore"
stiffness = [1e9, 0, 1e9]
[initial_motion.roll]
parts = ["roller"]
velocity = [1, 0, 0]
rolling = true
around = "roller.bore"
[settle]
[time]
end = 2e-6
)");
  const Recorder slow = run_case(file), fast = run_case(file, {"initial_motion.roll.velocity[0]=60"});
  REQUIRE(fast.report.settled);
  CHECK(slow.report.taken_from.empty());
  CHECK(fast.report.taken_from.empty());
  CHECK(fast.samples.front().energy.internal > 100 * slow.samples.front().energy.internal);
  const Recorder again = run_case(file, {"initial_motion.roll.velocity[0]=60"});
  CHECK_FALSE(again.report.taken_from.empty());
  CHECK(bitwise_equal(fast, again));
}

TEST_CASE("with settle.keep_unsettled false an interrupted settling leaves nothing, and none is taken up") {
  const test::TemporaryCase file(two_blocks("penalty", "newton"));
  const auto settle = [&](bool keep, int most) {
    const scene::Scene scene =
        read_case(file.path(), {"output.file=" + (file.folder() / "results.h5").string(),
                                std::string("settle.keep_unsettled=") + (keep ? "true" : "false")});
    Model model;
    build_model(scene, model);
    SettledFiles settled("test");
    return come_to_rest(model, &settled, [&](const SettleReport& so_far) { return so_far.steps < most; });
  };
  constexpr int all = 1000000;
  CHECK_FALSE(settle(false, 5).settled);
  CHECK(kept_file(file).empty());
  CHECK_FALSE(settle(true, 5).settled);
  CHECK_FALSE(kept_file(file).empty());
  const SettleReport whole = settle(false, all);
  CHECK(whole.settled);
  CHECK(whole.begun_from.empty());
  CHECK(settle(true, all).taken_from == kept_file(file).string());
}
