#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "case/read_case.hpp"
#include "source_folder.hpp"
#include "tests/track/beam_on_supports.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE(
    "a wheel at rest on the track of table 4.1: the ballast carries the weight of all, the rail bends as a beam on "
    "supports",
    "[long]") {
  scene::Scene scene =
      read_case(source_folder + std::string("/cases/track.toml"),
                {"settle.tolerance=2e-5", "meshes.wheel.zone_size=0.004", "tracks.track.zone_size=0.004",
                 "meshes.wheel.section_size=0.012", "tracks.track.section_size=0.012", "meshes.wheel.zone_layers=1",
                 "tracks.track.zone_layers=1"});
  scene.initial_motions.clear();
  scene::NodeSet under;
  under.name = "under_wheel";
  under.part = "track_rail";
  under.surface = "foot";
  under.box = {{{-0.021, -1, -1}, {0.021, 1, 1}}};
  scene.node_sets.push_back(under);
  Model model;
  build_model(scene, model);
  const SettleReport settled = settle_whole(model);
  INFO(settled.steps << " evaluations in " << settled.iterations << " steps, unbalance " << settled.unbalance);
  CHECK(settled.settled);
  compute_forces(model);
  const double gravity = -scene.gravity[2], weight = gravity * total_mass(model);
  CHECK_THAT(ballast_force(model) / weight, WithinAbs(1, 1e-6));
  double wheel = 0;
  for (const char* part : {"wheel", "sprung_mass"})
    for (int n : model.assembly.node_sets.at(part)) wheel += gravity * model.mass[n];
  const double contact = contact_totals(model, model.contacts, 0).normal_force[2];
  const double deflection =
      -mean(model, NodeField::displacement, model.assembly.node_sets.at("track_rail.under_wheel"))[2];
  const double theory = BeamOnSupports(scene, model, "track_rail", "track_concrete").deflection(0, wheel, gravity);
  INFO("weight " << weight << " N, ballast " << ballast_force(model) << " N; wheel " << wheel << " N, contact "
                 << contact << " N; deflection " << 1e3 * deflection << " mm, beam on supports " << 1e3 * theory
                 << " mm");
  CHECK_THAT(deflection, WithinRel(theory, 0.03));
  WARN("weight " << weight << " N, ballast over it less 1: " << ballast_force(model) / weight - 1 << "; wheel " << wheel
                 << " N, contact " << contact << " N; deflection " << 1e3 * deflection << " mm, beam on supports "
                 << 1e3 * theory << " mm; " << settled.steps << " evaluations, " << settled.wall_seconds << " s");
}
