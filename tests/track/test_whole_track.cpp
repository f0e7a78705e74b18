#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <sstream>

#include "tests/case/temporary_case.hpp"
#include "tests/track/beam_on_supports.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// Whole sleepers under two rails, against half a track where that is exact.
namespace {

constexpr double force = 5e4;

scene::Scene track(bool whole, const std::string& sleeper = "") {
  std::ostringstream text;
  text << "[sleepers.concrete]\nbase = \"concrete\"\n"
       << sleeper
       << "[tracks.track]\nstart = -0.9\nend = 0.9\nzone_size = 0.007\nzone_layers = 1\ncoarse_size = "
          "0.05\nsection_size = 0.012\nzone_start = -0.028\n"
          "zone_end = 0.028\ncore_size = 0.06\n"
       << (whole ? "both_rails = true\n" : "");
  for (const char* rail : {"track_rail", "track_far_rail"})
    if (whole || rail[6] == 'r')
      text << "[node_sets.loaded_" << rail << "]\npart = \"" << rail
           << "\"\nsurface = \"running_surface\"\nbox = [[-0.0051, -3, -1], [0.0051, 3, 1]]\n";
  text << "[settle]\nmethod = \"newton\"\ntolerance = 1e-7\n[time]\nend = 1e-5\n";
  return read_case(test::TemporaryCase(text.str()).path());
}

std::string loaded(const char* rail) { return std::string(rail) + ".loaded_" + rail; }

void settle_under_load(const scene::Scene& scene, Model& model) {
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO(report.steps << " evaluations, unbalance " << report.unbalance << "; " << report.adrift);
  REQUIRE(report.settled);
  compute_forces(model);
}

Vec3 moved(const Model& model, const char* rail) {
  return mean(model, NodeField::displacement, model.assembly.node_sets.at(loaded(rail)));
}

/// Displacements of both rails under forces on both.
std::array<Vec3, 2> under(const Vec3& near, const Vec3& far, const std::string& sleeper = "") {
  scene::Scene scene = track(true, sleeper);
  add_force(scene, loaded("track_rail"), near);
  add_force(scene, loaded("track_far_rail"), far);
  Model model;
  settle_under_load(scene, model);
  return {moved(model, "track_rail"), moved(model, "track_far_rail")};
}

Vec3 mirrored(const Vec3& a) { return {a[0], -a[1], a[2]}; }

}  // namespace

TEST_CASE("a whole track under equal loads is two halves; under opposite ones it is softer") {
  const Vec3 load{0, 3e3, -force};
  scene::Scene half = track(false);
  add_force(half, loaded("track_rail"), load);
  Model model;
  settle_under_load(half, model);
  const Vec3 of_half = moved(model, "track_rail");
  const auto equal = under(load, mirrored(load));
  CHECK(norm(equal[0] - of_half) < 1e-6 * norm(of_half));
  CHECK(norm(equal[1] - mirrored(of_half)) < 1e-6 * norm(of_half));
  CHECK_THAT(ballast_force(model) / force, WithinAbs(1, 1e-6));

  const auto opposite = under(load, mirrored(-1 * load));
  CHECK(norm(opposite[0] + mirrored(opposite[1])) < 0.01 * norm(opposite[0]));  // as far as all is linear
  // One loaded rail is half of each.
  const auto one = under(load, {0, 0, 0});
  CHECK(norm(one[0] - 0.5 * (equal[0] + opposite[0])) < 0.01 * norm(one[0]));
  CHECK(norm(one[1] - 0.5 * (equal[1] + opposite[1])) < 0.01 * norm(one[0]));
  WARN("vertical mm: half track " << 1e3 * of_half[2] << ", equal loads " << 1e3 * equal[0][2] << " (off by "
                                  << norm(equal[0] - of_half) / norm(of_half) << "), opposite " << 1e3 * opposite[0][2]
                                  << ", one rail " << 1e3 * one[0][2] << " and " << 1e3 * one[1][2]
                                  << "; lateral: " << 1e3 * of_half[1] << ", " << 1e3 * equal[0][1] << ", "
                                  << 1e3 * opposite[0][1] << ", " << 1e3 * one[0][1] << " and " << 1e3 * one[1][1]);
  CHECK(std::fabs(opposite[0][2]) > 1.02 * std::fabs(equal[0][2]));
}

TEST_CASE("a whole track on laterally springy ballast yields as that does") {
  scene::Scene scene = track(true, "ballast_lateral_stiffness = 20e6\n");
  for (const char* rail : {"track_rail", "track_far_rail"}) add_force(scene, loaded(rail), {0, force, 0});
  Model model;
  settle_under_load(scene, model);
  double aside = 0;
  for (int k = 1; k <= 3; ++k)
    aside += mean(model, NodeField::displacement,
                  model.assembly.node_sets.at("track_sleeper_" + std::to_string(k) + ".z_min"))[1] /
             3;
  // Two halves each.
  CHECK_THAT(aside, WithinRel(2 * force / (6 * 20e6), 1e-3));
  const auto held = under({0, force, 0}, {0, force, 0});
  CHECK(std::fabs(held[0][1]) < std::fabs(moved(model, "track_rail")[1]) - 0.5 * aside);
}
