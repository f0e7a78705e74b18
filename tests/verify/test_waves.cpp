#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <set>

#include "source_folder.hpp"
#include "tests/verify/march.hpp"
#include "tests/verify/scene_entries.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// A straight bar of the mesh, and the wave to stand in it.
struct Bar {
  int axis = 0;
  double start = 0, length = 0;
  int layers = 0;  ///< of elements along it

  /// Half waves over the bar: 20 elements a wavelength, or more where the bar is short.
  int half_waves() const { return std::max(1, layers / 10); }
  double wave_number() const { return M_PI * half_waves() / length; }
  double elements_a_wave() const { return 2.0 * layers / half_waves(); }
};

Bar find_bar(const Assembly& assembly) {
  Bar bar;
  for (int i = 0; i < 3; ++i) {
    std::set<long> places;  // in micrometres
    for (const Vec3& x : assembly.nodes) places.insert(std::lround(1e6 * x[i]));
    const double length = 1e-6 * static_cast<double>(*places.rbegin() - *places.begin());
    if (length <= bar.length) continue;
    bar = {i, 1e-6 * static_cast<double>(*places.begin()), length, static_cast<int>(places.size()) - 1};
  }
  return bar;
}

/// Which way the material moves, against the bar's axis; and which ways all nodes are held.
enum class Wave { bar, dilatational, shear };

double theory(Wave wave, const scene::Material& m) {
  if (wave == Wave::bar) return std::sqrt(m.youngs_modulus / m.density);
  if (wave == Wave::shear) return std::sqrt(m.youngs_modulus / (2 * (1 + m.poissons_ratio) * m.density));
  return m.dilatational_speed();
}

/// The allowed error of 0.5 % at 20 elements a wavelength is held at any number, by the scheme's second order.
void check_speed(double ratio, const Bar& bar) {
  const double coarser = 20 / bar.elements_a_wave();
  CHECK(std::fabs(ratio - 1) < 5e-3 * coarser * coarser);
}

/// Speed of a standing wave between free ends, from its frequency over seven periods, relative to theory.
double relative_speed(scene::Scene scene, Wave wave) {
  const Bar bar = find_bar(assemble(scene));
  const int moved = wave == Wave::shear ? (bar.axis + 1) % 3 : bar.axis;
  if (wave != Wave::bar) hold(scene, scene.parts[0].name, {moved != 0, moved != 1, moved != 2});
  const double speed = theory(wave, scene.materials[0]);
  scene.time.end = 7 * 2 * M_PI / (bar.wave_number() * speed);
  Model model;
  build_model(scene, model);
  const auto shape = [&](const Vec3& x) { return std::cos(bar.wave_number() * (x[bar.axis] - bar.start)); };
  set_velocity(model, [&](const Vec3& x, int) {
    Vec3 v{};
    v[moved] = 1e-3 * shape(x);
    return v;
  });
  const auto nodes = all_nodes(model);
  std::vector<double> amplitude;
  march(model, model.step_count, [&] {
    const auto u = node_field(model, model.ties, NodeField::displacement, nodes).values;
    double sum = 0;
    for (int n : nodes) sum += model.mass[n] * u[3 * n + moved] * shape(model.assembly.nodes[n]);
    amplitude.push_back(sum);
  });
  return angular_frequency(amplitude, model.step_size) / (bar.wave_number() * speed);
}

}  // namespace

TEST_CASE("bar, P and S waves of 20 elements run within 0.5 % of their speeds") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness})
    for (Wave wave : {Wave::bar, Wave::dilatational, Wave::shear}) {
      // A bar wave has the bar's speed only where the bar is thin: lateral inertia slows it by (nu k r)^2 / 2, here
      // 0.06 %.
      const double width = wave == Wave::bar ? 0.005 : 0.01;
      scene::Scene scene = block_scene({0.4, width, width}, {40, 1, 1}, 1);
      // A bar of one free element across has higher frequencies than V / A_max tells.
      scene.time.step_scale = wave == Wave::bar ? 0.6 : 0.9;
      set_hourglass(scene.parts[0], hourglass, hourglass == scene::HourglassType::viscous ? 0.1 : 0.05);
      const double ratio = relative_speed(scene, wave);
      INFO("wave " << static_cast<int>(wave) << ", hourglass type " << static_cast<int>(hourglass)
                   << ": speed / theory " << ratio);
      check_speed(ratio, find_bar(assemble(scene)));
    }
}

namespace {

void check_wave_in_file(const std::string& path, double scale) {
  for (Wave wave : {Wave::dilatational, Wave::shear}) {
    scene::Scene scene = block_scene({1, 1, 1}, {1, 1, 1}, 1);
    scene.meshes[0].type = scene::MeshType::file;
    scene.meshes[0].file.path = path;
    scene.meshes[0].file.scale = scale;
    const double ratio = relative_speed(scene, wave);
    INFO(path << ", wave " << static_cast<int>(wave) << ": speed / theory " << ratio);
    check_speed(ratio, find_bar(assemble(scene)));
  }
}

}  // namespace

TEST_CASE("P and S waves run as fast in meshes made by Gmsh and in the manner of CalculiX") {
  const std::string folder = source_folder + "/tests/mesh_files/data/";
  for (const char* file : {"block_ascii.msh", "block_binary.msh"}) check_wave_in_file(folder + file, 1.0);
  check_wave_in_file(folder + "cantilever.inp", 1e-3);
}

// Not of this project: tests/mesh_files/calculix_examples.sh fetches CalculiX's own examples and calls this.
TEST_CASE("P and S waves in the bar that RAILWAVE_WAVE_MESH names", "[.others]") {
  const char* path = std::getenv("RAILWAVE_WAVE_MESH");
  REQUIRE(path != nullptr);
  check_wave_in_file(path, 1.0);
}
