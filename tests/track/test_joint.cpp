#include <fmt/format.h>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <cmath>
#include <sstream>

#include "solve/tasks/beam_forces.hpp"
#include "tests/case/temporary_case.hpp"
#include "tests/track/beam_on_supports.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double weight = 5e4;

/// The joint on its two timber sleepers alone, as coarse as it may be, a weight on the rail's end before the gap.
scene::Scene joint(const std::string& keys, const std::string& settle) {
  std::ostringstream text;
  text << R"([tracks.track]
start = -0.4
end = 0.4
gap_position = 0
pair_position = 0
zone_size = 0.007
zone_start = -0.028
zone_end = 0.028
zone_layers = 1
coarse_size = 0.05
core_size = 0.06
section_size = 0.012
fishplates = true
)" << keys
       << R"(
[node_sets.loaded]
part = "track_rail"
surface = "head"
box = [[-0.03, -1, -1], [1, 1, 1]]
[loads.weight]
type = "nodal_force"
target = "track_rail.loaded"
force = [0, 0, -5e4]
[gravity]
acceleration = [0, 0, -9.81]
[settle]
)" << settle
       << R"(
[time]
end = 1e-5
)";
  return read_case(test::TemporaryCase(text.str()).path());
}

double axial_force(const Model& model, const std::string& name) {
  const auto all = beam_resultants(*model.beams, model.nodes);
  for (std::size_t b = 0; b < all.size(); ++b)
    if (model.scene.beams[b].name == name) return all[b].force[0];
  return std::nan("");
}

/// Vertical displacement of the head just before and just behind the gap.
std::array<double, 2> deflections(const Model& model) {
  const auto of = [&](const char* set) {
    return mean(model, NodeField::displacement, model.assembly.node_sets.at(set))[2];
  };
  return {of("track_rail.end"), of("track_rail_2.start")};
}

/// @param ballast_error relative, of what the ballast carries
void check_settled(Model& model, double ballast_error) {
  const SettleReport settled = settle_whole(model);
  INFO("settled after " << settled.steps << " evaluations, unbalance " << settled.unbalance);
  CHECK(settled.settled);
  compute_forces(model);
  CHECK_THAT(ballast_force(model), WithinRel(weight + 9.81 * total_mass(model), ballast_error));
  for (const char* bolt : {"track_bolt_1", "track_bolt_2", "track_bolt_3", "track_bolt_4"})
    CHECK_THAT(axial_force(model, bolt), WithinRel(12.5e3, 0.01));
}

}  // namespace

TEST_CASE(
    "a glued joint settles: its bolts have their pretension, the ballast carries all weight, both rails go down "
    "together",
    "[long]") {
  Model model;
  build_model(joint("", "method = \"newton\"\ntolerance = 1e-6"), model);
  check_settled(model, 1e-4);
  const auto [before, behind] = deflections(model);
  INFO("rail ends " << 1e3 * before << " and " << 1e3 * behind << " mm");
  CHECK(behind / before < 1);
  CHECK(behind / before > 0.99);
}

TEST_CASE("plates in contact carry the load over as well, with more give") {
  // With friction many nodes slip, and Newton's method settles it without first; without, a node rests in an edge.
  for (const char* friction : {"true", "false"}) {
    INFO("settles with friction: " << friction);
    Model model;
    build_model(joint("fishplate_fit = \"contact\"\n",
                      fmt::format("method = \"newton\"\ntolerance = 1e-3\nfriction = {}\n", friction)),
                model);
    check_settled(model, 2e-3);
    const auto [before, behind] = deflections(model);
    INFO("rail ends " << 1e3 * before << " and " << 1e3 * behind << " mm");
    CHECK(behind / before < 0.99);
    CHECK(behind / before > 0.9);
  }
}
