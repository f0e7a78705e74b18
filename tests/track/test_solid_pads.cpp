#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <sstream>

#include "case/solid_pad.hpp"
#include "tests/case/temporary_case.hpp"
#include "tests/track/beam_on_supports.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// Rail pads as bodies, tied to foot and sleeper, against springs of the same stiffness.
namespace {

scene::Material& material_of(scene::Scene& scene, const std::string& name) {
  return *std::find_if(scene.materials.begin(), scene.materials.end(), [&](const auto& m) { return m.name == name; });
}

const std::string coarse = "zone_size = 0.007\nzone_layers = 1\ncoarse_size = 0.05\nsection_size = 0.012\n";

/// A piece of rail as long as the pad, all but rigid, on a sleeper that is held; the rail moves along one axis only.
scene::Scene one_pad(const std::string& pad, int axis, double inclination = 0) {
  std::ostringstream text;
  text << "[sleepers.concrete]\n"
       << pad << "[tracks.track]\nstart = -0.08\nend = 0.08\npositions = [0]\nzone_start = -0.028\nzone_end = 0.028\n"
       << coarse << "core_size = 0.03\ninclination = " << inclination << "\n[time]\nend = 1\n";
  scene::Scene scene = read_case(test::TemporaryCase(text.str()).path());
  scene.connectors.erase(std::remove_if(scene.connectors.begin(), scene.connectors.end(),
                                        [](const auto& c) { return c.name == "track_ballast_1"; }),
                         scene.connectors.end());
  scene.constraints.clear();
  hold(scene, "track_sleeper_1", {true, true, true});
  std::array<bool, 3> guide{true, true, true};
  guide[axis] = false;
  hold(scene, "track_rail", guide);
  material_of(scene, "track_steel").youngs_modulus *= 100;
  return scene;
}

/// N/m of that seat along the axis.
double stiffness_of(scene::Scene scene, int axis) {
  const double force = -3e3;
  Vec3 applied{0, 0, 0};
  applied[axis] = force;
  add_force(scene, "track_rail.foot", applied);
  scene.settle.active = true;
  scene.settle.method = scene::SettleMethod::newton;
  scene.settle.tolerance = 1e-5;
  scene.time.end = 1e-6;
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO(report.steps << " evaluations, unbalance " << report.unbalance);
  REQUIRE(report.settled);
  return force / mean(model, NodeField::displacement, model.assembly.node_sets.at("track_rail.foot"))[axis];
}

scene::Scene loaded_track(const std::string& sleeper, double inclination, const std::string& more = "") {
  std::ostringstream text;
  text << "[sleepers.concrete]\n"
       << sleeper << "[tracks.track]\nstart = -1.5\nend = 1.5\nzone_start = -0.028\nzone_end = 0.028\n"
       << coarse << "core_size = 0.06\ninclination = " << inclination << "\n"
       << more
       << "[node_sets.loaded]\npart = \"track_rail\"\nbox = [[-0.0051, -1, -1], [0.0051, 1, 1]]\n[time]\nend = 1e-5\n";
  return read_case(test::TemporaryCase(text.str()).path());
}

/// m, of the rail under a force between two sleepers.
double deflection(const std::string& sleeper, double inclination) {
  scene::Scene scene = loaded_track(sleeper, inclination);
  const double weight = 1e5;
  add_force(scene, "track_rail.loaded", {0, 0, -weight});
  scene.settle.active = true;
  scene.settle.method = scene::SettleMethod::newton;
  scene.settle.tolerance = 1e-7;
  Model model;
  build_model(scene, model);
  const SettleReport report = settle_whole(model);
  INFO(report.steps << " evaluations, unbalance " << report.unbalance);
  REQUIRE(report.settled);
  compute_forces(model);
  CHECK_THAT(ballast_force(model) / weight, WithinAbs(1, 1e-6));
  return -mean(model, NodeField::displacement, model.assembly.node_sets.at("track_rail.loaded"))[2];
}

}  // namespace

TEST_CASE("a solid pad is as stiff as the fastening that it stands for") {
  for (const char* kind : {"", "base = \"timber\"\n"}) {
    const Vec3 table = *kind == 0 ? Vec3{100e6, 100e6, 195e6} : Vec3{150e6, 150e6, 86.7e6};
    for (double inclination : {0.0, 0.025})
      for (int axis = 0; axis < 3; ++axis) {
        const double found = stiffness_of(one_pad(std::string(kind) + "pad = \"solid\"\n", axis, inclination), axis);
        WARN(kind << "inclination " << inclination << ", along "
                  << "xyz"[axis] << ": " << found / 1e6 << " MN/m, the table's " << table[axis] / 1e6 << " ("
                  << 100 * (found / table[axis] - 1) << " %)");
        CHECK_THAT(found, WithinRel(table[axis], 0.02));
      }
  }
}

TEST_CASE("a solid pad of any Poisson's ratio and number of layers is as stiff as a bonded layer") {
  const case_file::BondedLayer layer{0.16, case_file::foot_width("54E1"), 0.007};
  for (double ratio : {0.0, 0.3, 0.45})
    for (int layers : {2, 4}) {
      std::ostringstream pad;
      pad << "pad = \"solid\"\npad_modulus = 5e7\npad_poissons_ratio = " << ratio << "\npad_layers = " << layers
          << "\n";
      const double found = stiffness_of(one_pad(pad.str(), 2), 2), theory = 5e7 * layer.vertical_stiffness(ratio);
      const double along = stiffness_of(one_pad(pad.str(), 1), 1), shear = 5e7 * layer.shear_stiffness(ratio);
      WARN("ratio " << ratio << ", " << layers << " layers: " << found / 1e6 << " MN/m, layer " << theory / 1e6 << " ("
                    << 100 * (found / theory - 1) << " %); along " << along / 1e6 << ", layer " << shear / 1e6 << " ("
                    << 100 * (along / shear - 1) << " %)");
      CHECK_THAT(found, WithinRel(theory, 0.03));
      CHECK_THAT(along, WithinRel(shear, 0.03));
    }
}

TEST_CASE("a track on solid pads gives way as one on springs does, and its ballast bears the load") {
  for (double inclination : {0.0, 0.025}) {
    const double springs = deflection("", inclination), solid = deflection("pad = \"solid\"\n", inclination);
    WARN("inclination " << inclination << ": " << 1e3 * springs << " mm on springs, " << 1e3 * solid << " mm on pads ("
                        << 100 * (solid / springs - 1) << " %)");
    CHECK_THAT(solid, WithinRel(springs, 0.02));
  }
}

namespace {

/// Half cycles of a damped swing about zero: its frequency and decay, 1/s.
struct Swing {
  double frequency, decay;
};

Swing swing_of(const std::vector<double>& u, double interval) {
  double first = 0, last = 0, least = 1, most = 0;
  for (std::size_t k = 1; k + 1 < u.size(); ++k) {
    const double size = std::fabs(u[k]);
    if (!(size > std::fabs(u[k - 1]) && size >= std::fabs(u[k + 1]))) continue;
    if (most == 0) first = k * interval, most = size;
    last = k * interval, least = size;
  }
  return {angular_frequency(u, interval), std::log(most / least) / (last - first)};
}

}  // namespace

TEST_CASE("oscillator: a block on a solid pad", "[oscillators]") {
  scene::Scene scene = one_pad("pad = \"solid\"\n", 2);
  const auto pad =
      *std::find_if(scene.parts.begin(), scene.parts.end(), [](const auto& p) { return p.name == "track_pad_1"; });
  const scene::Scene block = block_scene({0.16, 0.14, 0.1}, {4, 4, 2}, 1);
  scene.meshes.push_back(block.meshes[0]);
  scene.parts = {block.parts[0], pad};
  scene.parts[0].position = {-0.08, -0.07, 0};
  scene.materials.push_back(block.materials[0]);
  const double mass = 200, volume = 0.16 * 0.14 * 0.1, stiffness = 195e6, damping = 67.5e3;
  scene.materials.back().youngs_modulus = 1e13;
  scene.materials.back().density = mass / volume;
  scene.ties = {scene.ties[0]};
  scene.ties[0].master = "block.z_min";
  scene.connectors.clear();
  scene.constraints.clear();
  hold(scene, "track_pad_1.z_min", {true, true, true});
  hold(scene, "block", {true, true, false});
  scene.initial_motions.clear();
  add_motion(scene, {"block"}, {0, 0, -0.1});
  scene.time.end = 0.025;
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  std::vector<double> u;
  march(model, model.step_count,
        [&] { u.push_back(mean(model, NodeField::displacement, model.assembly.node_sets.at("block"))[2]); });
  const Swing found = swing_of(u, model.step_size);
  const double swinging = mass + mass_of(model, "track_pad_1") / 3, decay = 0.5 * damping / swinging;
  const double frequency = std::sqrt(stiffness / swinging - decay * decay);
  WARN("block on a solid pad: " << found.frequency / (2 * M_PI) << " Hz, theory " << frequency / (2 * M_PI) << " Hz ("
                                << 100 * (found.frequency / frequency - 1) << " %); decay " << found.decay
                                << " 1/s, theory " << decay << " 1/s (" << 100 * (found.decay / decay - 1)
                                << " %); step " << 1e9 * model.step_size << " ns");
  CHECK_THAT(found.frequency, WithinRel(frequency, 0.01));
  CHECK_THAT(found.decay, WithinRel(decay, 0.02));
}

namespace {

struct Response {
  std::vector<double> times, values;  ///< s; m, of the struck section
  EnergyAccount last;
  double worst_balance = 0, step = 0;

  double at(double time) const {
    std::size_t k = 1;
    while (k + 1 < times.size() && times[k] < time) ++k;
    return values[k - 1] + (time - times[k - 1]) / (times[k] - times[k - 1]) * (values[k] - values[k - 1]);
  }
};

/// The rail struck between two sleepers by a half sine of 10 kN and 0.5 ms, over 4 ms.
Response struck(const std::string& sleeper) {
  scene::Scene scene = loaded_track(sleeper, 0.025);
  scene::Curve blow;
  blow.name = "blow";
  blow.type = scene::CurveType::half_sine;
  blow.duration = 5e-4;
  scene.curves.push_back(blow);
  add_force(scene, "track_rail.loaded", {0, 0, -1e4}, "blow");
  scene.time.end = 4e-3;
  scene.output.history_interval = 2e-5;
  scene.output.history_sets = {"track_rail.loaded"};
  Model model;
  build_model(scene, model);
  Recorder recorder;
  const RunSummary summary = run(model, {&recorder});
  INFO(summary.reason);
  REQUIRE(summary.completed);
  Response response;
  for (const HistorySample& sample : recorder.samples) {
    response.times.push_back(sample.time);
    response.values.push_back(sample.sets[0].displacement[2]);
    response.worst_balance = std::max(response.worst_balance, std::fabs(sample.energy.balance_error));
  }
  response.last = recorder.samples.back().energy;
  response.step = model.step_size;
  return response;
}

}  // namespace

TEST_CASE("a struck track on solid pads answers as one on springs does, and its account closes", "[long]") {
  const Response springs = struck(""), solid = struck("pad = \"solid\"\n"),
                 dashpots = struck("pad = \"solid\"\npad_damping = 0\n");
  for (const Response* pads : {&solid, &dashpots}) {
    double off = 0, whole = 0;
    for (std::size_t k = 0; k < springs.values.size(); ++k) {
      off += std::pow(pads->at(springs.times[k]) - springs.values[k], 2);
      whole += std::pow(springs.values[k], 2);
    }
    WARN("off by " << 100 * std::sqrt(off / whole) << " % of the response; balance off by "
                   << pads->worst_balance / pads->last.external_work << " of the work done; step " << 1e9 * pads->step
                   << " ns, on springs " << 1e9 * springs.step << " ns");
    CHECK(std::sqrt(off / whole) < 0.05);
    CHECK(pads->worst_balance < 1e-3 * pads->last.external_work);
    CHECK(pads->last.kinetic < 0.5 * pads->last.external_work);
  }
}
