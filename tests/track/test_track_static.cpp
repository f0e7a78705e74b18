#include <Eigen/Dense>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "case/expand_tracks.hpp"
#include "case/read_case.hpp"
#include "mesh/section_properties.hpp"
#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// A short half track of table 4.1, as coarse as it may be, with a vertical load on the rail above or between sleepers.
scene::Scene loaded_track(const std::string& load_place, double force) {
  const auto path = std::filesystem::temp_directory_path() / ("railwave_track_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(path) << R"([tracks.track]
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
box = )" << load_place << R"(
[loads.weight]
type = "nodal_force"
target = "track_rail.loaded"
force = [0, 0, )" << force << R"(]
[settle]
tolerance = 1e-6
max_steps = 60000
[time]
end = 1e-5
)";
  scene::Scene scene = read_case(path.string());
  std::filesystem::remove(path);
  return scene;
}

/// Timoshenko's beam of n equal elements with exact nodal values: deflection and slope at each node.
Eigen::MatrixXd beam_stiffness(int elements, double length, double bending, double shear) {
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(2 * elements + 2, 2 * elements + 2);
  const double l = length / elements, phi = 12 * bending / (shear * l * l), a = 6 * l, b = (4 + phi) * l * l, c = (2 - phi) * l * l;
  Eigen::Matrix4d one;
  one << 12, a, -12, a, a, b, -a, c, -12, -a, 12, -a, a, c, -a, b;
  one *= bending / ((1 + phi) * l * l * l);
  for (int e = 0; e < elements; ++e) whole.block<4, 4>(2 * e, 2 * e) += one;
  return whole;
}

/// Deflection of a sleeper's seat under a unit force spread over the foot: half a beam on a bed, without slope at the middle of
/// the track.
double seat_compliance(const scene::Sleeper& kind, const scene::Material& material, double rail_distance, double foot) {
  const int elements = 200;
  const double area = *kind.width * *kind.height, bending = material.youngs_modulus * area * *kind.height * *kind.height / 12;
  Eigen::MatrixXd k = beam_stiffness(elements, *kind.half_length, bending, 5.0 / 6 * material.shear_modulus() * area);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(k.rows());
  for (int n = 0; n <= elements; ++n) {
    k(2 * n, 2 * n) += *kind.ballast_stiffness / elements * (n == 0 || n == elements ? 0.5 : 1);
    if (std::fabs(*kind.half_length * n / elements - rail_distance) <= 0.5 * foot) load[2 * n] = 1;
  }
  load /= load.sum();
  k(1, 1) *= 1e9;
  return load.dot(k.ldlt().solve(load));
}

/// Deflection of a rail on discrete supports under a unit force at x = load.
double beam_deflection(const scene::Scene& scene, const Model& model, double load) {
  const scene::Track& track = scene.tracks[0];
  const scene::Material& steel = scene.materials[model.assembly.parts[0].material];
  Mesh rail;
  rail.nodes = model.assembly.nodes;
  rail.elements = model.assembly.elements;
  const SectionProperties section = section_properties(rail, model.assembly.surfaces.at("track_rail.start_face"));
  const int elements = 480;
  const double start = track.rail.start, length = track.rail.end - start;
  // Cowper's shear coefficient for rails is close to 0.4 (vertical, 54E1).
  Eigen::MatrixXd k = beam_stiffness(elements, length, steel.youngs_modulus * section.moment_y, 0.4 * steel.shear_modulus() * section.area);
  const scene::Sleeper kind = case_file::sleeper_of(scene, track.sleeper);
  const auto& concrete = *std::find_if(scene.materials.begin(), scene.materials.end(), [](const auto& m) { return m.name == "track_concrete"; });
  const double seat = seat_compliance(kind, concrete, track.rail_distance, 0.14);
  const double support = 1 / (1 / (*kind.fastening_stiffness)[2] + seat);
  const auto node_at = [&](double x) { return static_cast<int>(std::lround((x - start) / length * elements)); };
  for (const auto& place : case_file::sleeper_places(track)) k(2 * node_at(place.x), 2 * node_at(place.x)) += support;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(k.rows());
  force[2 * node_at(load)] = 1;
  return k.ldlt().solve(force)[2 * node_at(load)];
}

double ballast_force(const Model& model) {
  const auto force = to_host(model.connectors.arrays.force);
  double sum = 0;
  for (int c = 0; c < model.connectors.arrays.count; ++c)
    if (model.scene.connectors[model.connectors.cells[c].connector].name.find("ballast") != std::string::npos) sum += force(c, 2);
  return sum;
}

void check_deflection(double load_place, const std::string& box) {
  const double weight = 1e5;
  const scene::Scene scene = loaded_track(box, -weight);
  Model model;
  build_model(scene, model);
  const auto& section = model.assembly.node_sets.at("track_rail.loaded");
  const SettleReport settled = settle(model, [](const SettleReport&) { return true; });
  INFO("settled after " << settled.steps << " steps, unbalance " << settled.unbalance);
  compute_forces(model);
  CHECK_THAT(ballast_force(model) / weight, WithinAbs(1, 1e-6));
  const double deflection = -mean(model, NodeField::displacement, section)[2] / weight;
  const double theory = beam_deflection(scene, model, load_place);
  INFO("deflection " << 1e3 * weight * deflection << " mm, beam on supports " << 1e3 * weight * theory << " mm, ballast " << ballast_force(model) << " N");
  CHECK_THAT(deflection, WithinRel(theory, 0.03));
}

}  // namespace

TEST_CASE("a rail between two sleepers gives way as a beam on discrete supports does", "[long]") {
  check_deflection(0, "[[-0.0051, -1, -1], [0.0051, 1, 1]]");
}
