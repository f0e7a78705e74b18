#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <sstream>

#include "tests/case/temporary_case.hpp"
#include "tests/track/beam_on_supports.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A short half track of table 4.1, as coarse as it may be, with a vertical load on the rail above or between sleepers.
scene::Scene loaded_track(const std::string& load_place, double force) {
  std::ostringstream text;
  text << R"([tracks.track]
start = -2.4
end = 2.4
first_sleeper = -2.1
zone_size = 0.007
zone_start = -0.028
zone_end = 0.028
zone_layers = 1
coarse_size = 0.05
core_size = 0.06
section_size = 0.012
inclination = 0
[node_sets.loaded]
part = "track_rail"
box = )"
       << load_place << R"(
[loads.weight]
type = "nodal_force"
target = "track_rail.loaded"
force = [0, 0, )"
       << force << R"(]
[settle]
tolerance = 1e-6
max_steps = 60000
[time]
end = 1e-5
)";
  return read_case(test::TemporaryCase(text.str()).path());
}

void check_deflection(double load_place, const std::string& box) {
  const double weight = 1e5;
  const scene::Scene scene = loaded_track(box, -weight);
  Model model;
  build_model(scene, model);
  const auto& section = model.assembly.node_sets.at("track_rail.loaded");
  const SettleReport settled = settle_whole(model);
  INFO("settled after " << settled.steps << " steps, unbalance " << settled.unbalance);
  compute_forces(model);
  CHECK_THAT(ballast_force(model) / weight, WithinAbs(1, 1e-6));
  const double deflection = -mean(model, NodeField::displacement, section)[2] / weight;
  const double theory = BeamOnSupports(scene, model, "track_rail", "track_concrete").deflection(load_place, 1);
  INFO("deflection " << 1e3 * weight * deflection << " mm, beam on supports " << 1e3 * weight * theory
                     << " mm, ballast " << ballast_force(model) << " N");
  CHECK_THAT(deflection, WithinRel(theory, 0.03));
}

}  // namespace

TEST_CASE("a rail between two sleepers gives way as a beam on discrete supports does", "[long]") {
  check_deflection(0, "[[-0.0051, -1, -1], [0.0051, 1, 1]]");
}
