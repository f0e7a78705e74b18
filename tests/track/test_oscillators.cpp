#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <sstream>

#include "case/expand.hpp"
#include "tests/case/temporary_case.hpp"
#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

// Each spring-dashpot pair of track and vehicle carries one mass that can move one way only: frequency and decay of
// theory.
namespace {

/// An oscillator's mass, stiffness and dashpot, and what theory makes of them.
struct Oscillator {
  double mass, stiffness, damping;  // kg, N/m, N s/m

  double undamped() const { return std::sqrt(stiffness / mass); }
  double share() const { return damping / (2 * std::sqrt(stiffness * mass)); }
  double frequency() const { return undamped() * std::sqrt(1 - share() * share()); }  // rad/s
  double decay() const { return share() * undamped(); }                               // 1/s
};

/// Decay rate of a damped swing: its extremes, each the top of a parabola through three values, fall by exp(-decay
/// pi/frequency) from one to the next of either sign.
double decay_rate(const std::vector<double>& u, double interval) {
  std::vector<std::array<double, 2>> extremes;
  for (std::size_t k = 1; k + 1 < u.size(); ++k) {
    const double a = std::fabs(u[k - 1]), b = std::fabs(u[k]), c = std::fabs(u[k + 1]);
    if (!(b > a && b >= c)) continue;
    const double bend = a - 2 * b + c, slope = 0.5 * (c - a);
    extremes.push_back({interval * (static_cast<double>(k) - slope / bend), b - 0.5 * slope * slope / bend});
  }
  REQUIRE(extremes.size() > 3);
  return std::log(extremes.front()[1] / extremes.back()[1]) / (extremes.back()[0] - extremes.front()[0]);
}

void check_oscillator(const char* name, scene::Scene scene, const Oscillator& theory, const std::string& what,
                      int axis) {
  add_motion(scene, {what}, {0, 0, 0}).velocity[axis] = 1e-3 * theory.undamped();
  // So many swings that the last is still a hundredth of the first.
  const double swings = std::min(10.0, 4.6 * theory.frequency() / (2 * M_PI * theory.decay()));
  scene.time.end = swings * 2 * M_PI / theory.frequency();
  Model model;
  build_model(scene, model);
  set_initial_motion(model, model.nodes, model.beams);
  std::vector<double> u;
  march(model, model.step_count,
        [&] { u.push_back(mean(model, NodeField::displacement, model.assembly.node_sets.at(what))[axis]); });
  const double frequency = angular_frequency(u, model.step_size), decay = decay_rate(u, model.step_size);
  const auto percent = [](double found, double expected) { return 100 * (found / expected - 1); };
  WARN(name << ": " << frequency / (2 * M_PI) << " Hz, theory " << theory.frequency() / (2 * M_PI) << " Hz ("
            << percent(frequency, theory.frequency()) << " %); decay " << decay << " 1/s, theory " << theory.decay()
            << " 1/s (" << percent(decay, theory.decay()) << " %)");
  CHECK_THAT(frequency, WithinRel(theory.frequency(), 1e-3));
  CHECK_THAT(decay, WithinRel(theory.decay(), 0.01));
}

void hold_other_directions(scene::Scene& scene, const std::string& what, int axis) {
  hold(scene, what, {axis != 0, axis != 1, axis != 2});
}

/// A block with all of its nodes held.
scene::Scene held_block() {
  scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {1, 1, 1}, 1);
  scene.materials[0].youngs_modulus = 1;  // only the step knows of it
  hold(scene, "block", {true, true, true});
  return scene;
}

/// A track of one sleeper of that kind under a short rail.
scene::Scene one_sleeper(const std::string& kind) {
  std::ostringstream text;
  text << "[tracks.track]\nstart = -0.3\nend = 0.3\nzone_start = -0.05\nzone_end = 0.05\nsleeper = \"" << kind
       << "\"\n[time]\nend = 1\n";
  return read_case(test::TemporaryCase(text.str()).path());
}

template <class Entry>
void keep(std::vector<Entry>& entries, const std::vector<std::string>& names) {
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const Entry& entry) {
                                 return std::find(names.begin(), names.end(), entry.name) == names.end();
                               }),
                entries.end());
}

}  // namespace

TEST_CASE("oscillator: a sprung mass on the primary suspension", "[oscillators]") {
  const Oscillator theory{10900, 1.15e6, 2.5e3};
  scene::Scene scene = held_block();
  add_point(scene, "body", theory.mass, {0.05, 0.05, 1});
  add_spring(scene, "block.z_max", "body", {0, 0, theory.stiffness}, {0, 0, theory.damping});
  scene.time.step = 1e-3;
  check_oscillator("suspension", scene, theory, "body", 2);
}

TEST_CASE("oscillator: a stiff block on the fastening of table 4.1, along each of its axes", "[oscillators]") {
  for (const char* kind : {"concrete", "timber"})
    for (int axis = 0; axis < 3; ++axis) {
      scene::Scene track = one_sleeper(kind);
      const auto fastening = std::find_if(track.connectors.begin(), track.connectors.end(),
                                          [](const auto& c) { return c.name == "track_fastening_1"; });
      const double length = (*fastening->area)[1][0] - (*fastening->area)[0][0], width = 0.14, height = 0.1,
                   mass = 2000;
      scene::Scene scene = block_scene({length, width, height}, {4, 4, 2}, 1);
      scene.parts[0].position = {-0.5 * length, -0.5 * width, 0};
      scene.materials[0].density = mass / (length * width * height);
      scene.materials[0].youngs_modulus = 1e14;  // a thousandth of the fastening's give and less
      scene.connectors = {*fastening};
      scene.connectors[0].from = "ground";
      scene.connectors[0].to = "block.z_min";
      hold_other_directions(scene, "block", axis);
      const Oscillator theory{mass, fastening->stiffness[axis], fastening->damping[axis]};
      check_oscillator((std::string("fastening, ") + kind + ", along " + "xyz"[axis]).c_str(), scene, theory, "block",
                       axis);
    }
}

TEST_CASE("oscillator: a sleeper on its ballast", "[oscillators]") {
  for (const char* kind : {"concrete", "timber"}) {
    scene::Scene scene = one_sleeper(kind);
    keep(scene.parts, {"track_sleeper_1"});
    keep(scene.connectors, {"track_ballast_1"});
    keep(scene.constraints, {"track_bed_1", "track_centre_1"});
    const scene::Sleeper sleeper = case_file::sleeper_of(scene, kind);
    const auto material = std::find_if(scene.materials.begin(), scene.materials.end(),
                                       [&](const auto& m) { return m.name == scene.parts[0].material; });
    // Dashpots take the velocity of half a step before: with share of critical d that is a mass less by the share d
    // omega step. A sleeper alone would allow 20 us, 0.2 % off in frequency; runs go at the rail's step, a tenth of a
    // microsecond or some.
    scene.time.step = 2e-6;
    const double mass = material->density * *sleeper.width * *sleeper.half_length * *sleeper.height;
    check_oscillator((std::string("ballast, ") + kind).c_str(), scene,
                     {mass, *sleeper.ballast_stiffness, *sleeper.ballast_damping}, "track_sleeper_1", 2);
  }
}
