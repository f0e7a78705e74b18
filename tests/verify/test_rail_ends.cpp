#include <catch2/catch_test_macros.hpp>

#include "tests/verify/march.hpp"
#include "tests/verify/open_ends.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// Faces in the plane x = `place`.
std::vector<Face> faces_at(const Assembly& assembly, double place) {
  std::vector<Face> faces;
  for (int e = 0; e < static_cast<int>(assembly.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      bool there = true;
      for (int n : assembly.face_nodes({e, side})) there = there && std::fabs(assembly.nodes[n][0] - place) < 1e-9;
      if (there) faces.push_back({e, side});
    }
  return faces;
}

/// A packet in the middle of a coarse 54E1 rail: a velocity along `direction`, a Gaussian times a cosine, which parts
/// into two that run to both ends.
struct Packet {
  Vec3 direction;
  double wavelength, deviation;  ///< m
  double time;                   ///< s
  double half_length = 2;        ///< m, of the rail
  double element = 0.04;         ///< m, along the rail
  double fine = 0.006;           ///< m, of a few elements in the middle, which set the step
};

/// What waits for it at both ends.
struct RailEnds {
  bool dashpots = true;
  double layer = 0;  ///< m; 0: none
  double reflection = 0.1;
};

/// Share of a packet's energy that is left in the rail.
double left_in_rail(const Packet& packet, const RailEnds& ends) {
  scene::Scene scene = block_scene({1, 1, 1}, {1, 1, 1}, packet.time);
  scene.meshes[0].type = scene::MeshType::rail;
  scene::RailMesh& rail = scene.meshes[0].rail;
  rail.start = -packet.half_length;
  rail.end = packet.half_length;
  rail.zone_size = packet.fine;
  rail.section_size = std::max(0.01, packet.fine);
  rail.coarse_size = rail.core_size = packet.element;
  rail.zone_start = -packet.fine;
  rail.zone_end = packet.fine;
  rail.zone_width = 3 * packet.fine;
  rail.zone_layers = 1;
  rail.web_columns = 2;
  rail.inclination = 0;
  set_hourglass(scene.parts[0], scene::HourglassType::stiffness, 0.05);
  Assembly assembly = assemble(scene);
  for (double side : {rail.start, rail.end}) {
    const std::string end = side < 0 ? "block.near" : "block.far";
    assembly.surfaces[end] = faces_at(assembly, side);
    if (ends.dashpots) add_dashpots(scene, end);
    if (ends.layer > 0) add_layer(scene, end, ends.layer, ends.reflection);
  }
  Model model;
  build_model(scene, assembly, model);
  set_velocity(model, [&](const Vec3& x, int) {
    return (std::exp(-0.5 * std::pow(x[0] / packet.deviation, 2)) * std::cos(2 * M_PI * x[0] / packet.wavelength)) *
           packet.direction;
  });
  const auto energy = [&] {
    const EnergyAccount now = account_energies(model, model.step_size);
    return now.kinetic + now.internal + now.hourglass;
  };
  double first = -1;
  march(model, model.step_count, [&] {
    if (first < 0) first = energy();
  });
  return energy() / first;
}

/// Of a Timoshenko beam of steel with a 54E1 rail's section: the length of its bending waves of a frequency, m, and how
/// fast their packets go, m/s.
struct BendingWave {
  double length, speed;
};

BendingWave bending_wave(double second_moment, double shear_coefficient, double frequency) {
  const double area = 6.98e-3, e = 210e9, density = 7800, g = e / 2.6;
  const auto frequency_of = [&](double k) {
    // (k^2 EI + GA_s - rho I w^2)(k^2 GA_s - rho A w^2) = (k GA_s)^2, the lower root.
    const double s = shear_coefficient * g * area;
    const double a = density * second_moment * density * area,
                 b = density * area * (k * k * e * second_moment + s) + density * second_moment * k * k * s,
                 c = k * k * k * k * e * second_moment * s;
    return std::sqrt((b - std::sqrt(b * b - 4 * a * c)) / (2 * a)) / (2 * M_PI);
  };
  double low = 1e-3, high = 1e3;
  for (int i = 0; i < 100; ++i) (frequency_of(0.5 * (low + high)) < frequency ? low : high) = 0.5 * (low + high);
  const double k = 0.5 * (low + high);
  return {2 * M_PI / k, 2 * M_PI * (frequency_of(1.001 * k) - frequency_of(0.999 * k)) / (0.002 * k)};
}

}  // namespace

TEST_CASE("a rail's ends let axial and bending packets out", "[long]") {
  const double axial = left_in_rail({{1, 0, 0}, 1.5, 0.5, 1.2e-3}, {});
  const double vertical = left_in_rail({{0, 0, 1}, 0.5, 0.4, 3e-3}, {}),
               lateral = left_in_rail({{0, 1, 0}, 0.5, 0.4, 4e-3}, {});
  UNSCOPED_INFO("left in the rail: axial " << axial << ", vertical bending " << vertical << ", lateral bending "
                                           << lateral);
  // Uniform over the section, the axial packet is not a pure bar wave: some of it bends and thickens the rail.
  CHECK(axial < 0.05);
  CHECK(vertical < 0.1);
  CHECK(lateral < 0.1);
  // They would be there if the ends were free.
  CHECK(left_in_rail({{0, 0, 1}, 0.5, 0.4, 3e-3}, {false}) > 0.99);
}

TEST_CASE("layers of 2.5 m before a rail's ends take 99 % of bending and axial waves from 300 Hz up", "[long]") {
  const RailEnds layered{true, 2.5};
  // A packet uniform over the section is no pure wave: its slower parts need so long to the ends.
  const double longest = 0.01;
  for (double frequency : {300.0, 1000.0, 3000.0})
    for (bool vertical : {true, false}) {
      const BendingWave wave =
          vertical ? bending_wave(2.337e-5, 0.4, frequency) : bending_wave(4.19e-6, 0.6, frequency);
      // Most of the energy lies within 10 % of the wave number. Packets may go to the end and back to the middle.
      const double deviation = 1.2 * wave.length, half = 3 * deviation + layered.layer;
      const Packet packet{{0, vertical ? 0.0 : 1.0, vertical ? 1.0 : 0.0},
                          wave.length,
                          deviation,
                          std::max(2 * half / wave.speed, longest),
                          half,
                          std::max(0.03, std::min(0.08, wave.length / 16)),
                          0.007};
      const double left = left_in_rail(packet, layered);
      UNSCOPED_INFO(frequency << " Hz, " << (vertical ? "vertical" : "lateral") << ", waves of " << wave.length
                              << " m: left in the rail " << left);
      CHECK(left < 0.01);
    }
  const double axial = left_in_rail({{1, 0, 0}, 1.5, 0.5, longest, 4.5, 0.08, 0.007}, layered);
  UNSCOPED_INFO("axial: left in the rail " << axial);
  CHECK(axial < 0.01);
}
