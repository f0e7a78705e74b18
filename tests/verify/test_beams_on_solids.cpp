#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "tests/verify/beam_scene.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A coarse ring around the y axis, four beams from its centre to the bore, and a torque on the centre (thesis
/// fig. 3.8).
scene::Scene spoked_ring(double end) {
  scene::Scene scene;
  scene.path = "ring";
  scene.materials.push_back(steel());
  scene::MeshSource mesh;
  mesh.name = "ring";
  mesh.type = scene::MeshType::roller;
  scene::RollerMesh& ring = mesh.roller;
  ring.radius = 0.4;
  ring.bore_radius = 0.32;
  ring.side_start = -0.03;
  ring.side_end = 0.03;
  ring.ring = true;
  ring.zone_size = ring.coarse_size = 0.03;
  ring.zone_start = -0.03;
  ring.zone_end = 0.03;
  ring.zone_width = 0.06;
  ring.zone_layers = 1;
  scene.meshes.push_back(mesh);
  scene::Part part;
  part.name = "ring";
  part.mesh = "ring";
  part.material = "steel";
  scene.parts.push_back(part);
  scene.points.push_back(massless("axle", {0, 0, 0}));
  scene::Beam spokes = round_beam("axle", "ring.bore", 0.03, 3);
  spokes.name = "spokes";
  spokes.count = 4;
  spokes.orientation = Vec3{0, 1, 0};
  scene.beams.push_back(spokes);
  add_torque(scene, "axle", 2000, {0, 1, 0});
  scene.time.end = end;
  scene.output.history_interval = end / 10;
  return scene;
}

double axial_force(const BeamResultants& beam, int element) { return beam.force[3 * element]; }

}  // namespace

TEST_CASE("four spokes lie evenly around in the plane of the axle, and carry a torque into the ring without loss") {
  const scene::Scene scene = spoked_ring(1e-3);
  Model model;
  build_model(scene, model);
  REQUIRE(model.assembly.beam_chains.size() == 4);
  std::vector<Vec3> ends;
  for (const auto& chain : model.assembly.beam_chains) ends.push_back(model.assembly.nodes[chain.nodes.back()]);
  for (int k = 0; k < 4; ++k) {
    CHECK_THAT(norm(ends[k]), WithinRel(0.32, 1e-2));
    CHECK(std::fabs(dot(ends[k], ends[(k + 1) % 4])) < 0.1 * 0.32 * 0.32);
  }
  march(model, model.step_count, [&] {
    if (model.step % 100 != 0 || model.step == 0) return;
    // Spins and velocities are those of half a step before.
    const double given = 2000 * (model.time - 0.5 * model.step_size);
    CHECK_THAT(momenta(model).angular[1], WithinRel(given, 1e-9));
    CHECK_THAT(norm(momenta(model).linear), WithinAbs(0, 1e-9 * given));
  });
}

TEST_CASE("the account of a spoked ring closes, in every precision, and the axle turns as far") {
  std::vector<double> angle;
  for (auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    scene::Scene scene = spoked_ring(2e-3);
    scene.solver.precision = precision;
    scene.time.step_scale = 0.5;
    Model model;
    build_model(scene, model);
    Recorder recorder;
    REQUIRE(run(model, {&recorder}).completed);
    const EnergyAccount& last = recorder.samples.back().energy;
    CHECK(last.external_work > 1);
    CHECK(std::fabs(last.balance_error) < 5e-3 * last.external_work);
    angle.push_back(rotation(model, "axle")[1]);
  }
  CHECK(angle[0] > 1e-4);
  CHECK_THAT(angle[1], WithinRel(angle[0], 1e-4));
  CHECK_THAT(angle[2], WithinRel(angle[0], 1e-4));
}

TEST_CASE("a ring that rolls with its spokes feels no more in them than rotation asks for") {
  scene::Scene scene = spoked_ring(1e-3);
  scene.loads.clear();
  add_motion(scene, {"ring", "axle"}, {24, 0, 0}, {0, 60, 0}).centre = Vec3{0, 0, 0};
  scene.settle.active = true;
  scene.settle.tolerance = 1e-4;
  scene.settle.max_steps = 100000;
  Model model;
  build_model(scene, model);
  REQUIRE(settle_whole(model).settled);
  set_initial_motion(model, model.nodes, model.beams);
  // rho omega^2 r^2 is a bar or two here: the rest is what finds no balance at the start.
  const double scale = 7800 * 60 * 60 * 0.4 * 0.4 * M_PI * 0.03 * 0.03;
  double bent = 0, pulled = 0;
  march(model, model.step_count, [&] {
    if (model.step % 50 != 0) return;
    const BeamResultants now = beam_resultants(*model.beams, model.nodes).front();
    for (std::size_t i = 0; i < now.force.size(); ++i) {
      (i % 3 == 0 ? pulled : bent) = std::max(i % 3 == 0 ? pulled : bent, std::fabs(now.force[i]));
      bent = std::max(bent, std::fabs(now.moment[i]) / 0.3);
    }
  });
  CHECK(pulled < 3 * scale);
  CHECK(pulled > 0.1 * scale);
  CHECK(bent < 0.02 * scale);
}

TEST_CASE("a bolt has its pretension when all has settled, and a millisecond later still") {
  // Viscous hourglass control holds nothing at rest, as what settles has it: that is what the bolt's force swings by.
  for (const auto& [control, bound] :
       {std::pair{scene::HourglassType::stiffness, 1e-3}, {scene::HourglassType::viscous, 1e-2}}) {
    scene::Scene scene = bolted_cube(12500, 1e-3);
    scene.output.history_interval = 1e-5;
    set_hourglass(scene.parts[0], control, control == scene::HourglassType::viscous ? 0.1 : 0.05);
    scene.settle.active = true;
    scene.settle.tolerance = 1e-5;
    scene.settle.max_steps = 100000;
    Model model;
    build_model(scene, model);
    Recorder recorder;
    REQUIRE(run(model, {&recorder}).completed);
    double largest = 0;
    for (const HistorySample& sample : recorder.samples)
      for (int e = 0; e < 4; ++e) largest = std::max(largest, std::fabs(axial_force(sample.beams[0], e) / 12500 - 1));
    CHECK(largest < bound);
    // The washers press the cube together with as much.
    double pressed = 0;
    for (double s : element_stress(model, model.nodes, all_elements(model)).values)
      pressed = std::max(pressed, std::fabs(s));
    CHECK(pressed > 0.5 * 12500 / (0.08 * 0.08));
  }
}

TEST_CASE("without settling a bolt begins with its pretension as it lies, and loses some to what it presses together") {
  scene::Scene scene = bolted_cube(12500, 2e-4);
  scene.output.history_interval = 2e-6;
  Model model;
  build_model(scene, model);
  compute_forces(model);
  for (int e = 0; e < 4; ++e)
    CHECK_THAT(axial_force(beam_resultants(*model.beams, model.nodes).front(), e), WithinRel(12500.0, 1e-12));
  Recorder recorder;
  REQUIRE(run(model, {&recorder}).completed);
  double sum = 0;
  for (const HistorySample& sample : recorder.samples) sum += axial_force(sample.beams[0], 1);
  const double mean_force = sum / static_cast<double>(recorder.samples.size());
  CHECK(mean_force < 0.99 * 12500);
  CHECK(mean_force > 0.5 * 12500);
  const EnergyAccount& last = recorder.samples.back().energy;
  CHECK(std::fabs(last.balance_error) < 0.02 * last.internal);
}

TEST_CASE("beams that cannot be laid, and rotations where there are none, are refused") {
  const auto refused = [](const scene::Scene& scene, const std::string& why, const std::string& mend) {
    Model model;
    CHECK_THROWS_MATCHES(build_model(scene, model), InputError,
                         MessageMatches(ContainsSubstring(why) && ContainsSubstring(mend)));
  };
  scene::Scene scene = spoked_ring(1e-4);
  scene.beams[0].orientation.reset();
  refused(scene, "[beams.spokes] count", "needs `orientation`");
  scene = spoked_ring(1e-4);
  scene.beams[0].count = 100000;
  refused(scene, "[beams.spokes] count", "lower it");
  scene = spoked_ring(1e-4);
  scene.points.push_back(massless("beside", {0, 0.2, 0}));
  scene.beams[0].to = "beside";
  scene.beams[0].count.reset();
  refused(scene, "orientation: lies along the beam", "across it");
  scene = spoked_ring(1e-4);
  scene.beams[0].from = "ring.bore";
  refused(scene, "[beams.spokes] from", "a set of one node");
  scene = spoked_ring(1e-4);
  scene.points.push_back(massless("lonely", {0, 1, 0}));
  refused(scene, "[points.lonely] mass: is 0", "give it a mass");
  scene = spoked_ring(1e-4);
  scene.points.push_back(massless("lonely", {0, 1, 0}));
  scene.points.back().mass = 1;
  scene.loads[0].target = "lonely";
  refused(scene, "[loads.load on axle] target: 'lonely' is one node", "[beams.NAME]");
  scene = spoked_ring(1e-4);
  scene.constraints.push_back({});
  scene.constraints.back().target = "ring.tread";
  scene.constraints.back().fixed_rotation = {true, false, false};
  refused(scene, "fixed_rotation: no beam ends at 'ring.tread'", "leave it out");
}
