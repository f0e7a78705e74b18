#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <complex>

#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/checks/doubts.hpp"
#include "tests/verify/open_ends.hpp"
#include "tests/verify/two_blocks.hpp"

/// Absorbing layers before the ends of bars and beams, against the theory of a bar whose mass damping grows with the
/// cube of the way.
using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

enum class Wave { plane, bar, bending };

/// A bar along x, 10 mm thick, with packets of waves of length 0.1 m that leave its middle to both sides.
struct Bar {
  Wave wave = Wave::bar;
  double layer = 0.1;  ///< m; 0: none
  bool dashpots = false;
  double reflection = 0.01;
  scene::Precision precision = scene::Precision::double_precision;
  bool subcycling = false;
  double element = 0.004;  ///< m, along the bar; of bending 0.0025

  static constexpr double wavelength = 0.1, thickness = 0.01, deviation = 0.1, free_length = 0.6;

  double length() const { return free_length + 2 * layer; }
  double modulus(const scene::Material& m) const {
    return wave == Wave::plane ? m.dilatational_modulus() : m.youngs_modulus;
  }
  double speed(const scene::Material& m) const {
    const double c = std::sqrt(modulus(m) / m.density), k = 2 * M_PI / wavelength;
    return wave == Wave::bending ? 2 * c * k * thickness / std::sqrt(12.0) : c;  // group velocity
  }

  scene::Scene scene() const {
    const bool bends = wave == Wave::bending;
    const int across = wave == Wave::plane ? 1
                       : bends             ? 4
                                           : 2,
              along = static_cast<int>(std::lround(length() / (bends ? 0.0025 : element)));
    scene::Scene made = block_scene({length(), thickness, thickness}, {along, bends ? 1 : across, across}, 1);
    set_hourglass(made.parts[0], scene::HourglassType::stiffness, 0.05);
    // Until packets that came back from the ends would be in the middle again.
    made.time.end = (bends ? 1.5 : 1.05) * length() / speed(made.materials[0]);
    made.solver.precision = precision;
    made.solver.subcycling = subcycling;
    if (wave == Wave::plane) hold(made, "block", {false, true, true});
    for (const char* end : {"block.x_min", "block.x_max"}) {
      if (layer > 0) add_layer(made, end, layer, reflection);
      if (dashpots) add_dashpots(made, end);
    }
    return made;
  }

  /// Velocities of the packet, as far as a thin bar's section goes along: thinner where it gets longer, turned where it
  /// bends.
  void start(Model& model) const {
    const double middle = 0.5 * length(), k = 2 * M_PI / wavelength;
    const double thinning = wave == Wave::bar ? model.scene.materials[0].poissons_ratio : 0;
    const auto packet = [&](double x) {
      return std::exp(-0.5 * std::pow((x - middle) / deviation, 2)) * std::cos(k * (x - middle));
    };
    const auto slope = [&](double x) { return (packet(x + 1e-6) - packet(x - 1e-6)) / 2e-6; };
    set_velocity(model, [&](const Vec3& x, int) {
      const double y = x[1] - 0.5 * thickness, z = x[2] - 0.5 * thickness;
      if (wave == Wave::bending) return Vec3{-z * slope(x[0]), 0, packet(x[0])};
      return Vec3{packet(x[0]), -thinning * y * slope(x[0]), -thinning * z * slope(x[0])};
    });
  }

  /// Of the packets' amplitude what came back: the root of the share of their energy that is still in the bar.
  double returned(double* balance = nullptr, double* taken = nullptr) const {
    Model model;
    build_model(scene(), model);
    start(model);
    double first = -1, total = 0, error = 0;
    EnergyAccount energy;
    march(model, model.step_count, [&] {
      if (model.step % 16 != 0 && model.step != model.step_count) return;
      energy = account_energies(model, model.step_size);
      if (first < 0) {
        first = energy.kinetic + energy.internal + energy.hourglass;
        total = balance_total(energy);
      }
      error = std::fmax(error, std::fabs(balance_total(energy) - total));
    });
    if (balance) *balance = error / first;
    if (taken) *taken = energy.damping / first;
    return std::sqrt((energy.kinetic + energy.internal + energy.hourglass) / first);
  }
};

/// The same by theory for longitudinal waves of one length: rho (u'' + alpha u') = E d2u/dx2 in the layer, whose end is
/// free or has the continuum's dashpots. The layer is a stack of thin ones with each its own wave number, passed from
/// the end to its beginning.
/// @param faster C_d over the wave's speed
double theory(double lengths, double reflection, double faster, bool dashpots) {
  using Complex = std::complex<double>;
  constexpr int slices = 2000;
  const Complex i(0, 1);
  // In wavelengths, and so that the wave's speed is 1.
  const double omega = 2 * M_PI, step = lengths / slices, rate = 4 * faster * std::log(1 / reflection) / lengths;
  Complex u = 1, slope = dashpots ? -i * omega * faster : Complex(0);
  for (int s = slices - 1; s >= 0; --s) {
    const double share = (s + 0.5) / slices;
    const Complex k = std::sqrt(omega * omega - i * omega * rate * share * share * share);
    const Complex c = std::cos(k * step), d = std::sin(k * step);
    const Complex before = c * u - d / k * slope;
    slope = k * d * u + c * slope;
    u = before;
  }
  const Complex ratio = slope / u;
  return std::abs((ratio + i * omega) / (i * omega - ratio));
}

/// Of a packet of the bar: its waves' lengths differ, each with its share of the energy.
double theory_of_packet(double lengths, double reflection, double faster, bool dashpots) {
  const double k0 = 2 * M_PI / Bar::wavelength;
  double sum = 0, energy = 0;
  for (double off = -3; off <= 3; off += 0.25) {
    const double weight = std::exp(-off * off),
                 back = theory(lengths * (1 + off / (k0 * Bar::deviation)), reflection, faster, dashpots);
    sum += weight;
    energy += weight * back * back;
  }
  return std::sqrt(energy / sum);
}

}  // namespace

TEST_CASE(
    "a layer of one and a half wavelengths sends less than 2 % of a bar's packet back, where dashpots alone send 7 %") {
  const scene::Material m = steel();
  const double faster = m.dilatational_speed() / std::sqrt(m.youngs_modulus / m.density);
  for (bool dashpots : {false, true}) {
    Bar bar;
    bar.dashpots = dashpots;
    bar.layer = 1.5 * Bar::wavelength;
    double balance = 0, taken = 0;
    const double found = bar.returned(&balance, &taken),
                 wanted = theory_of_packet(1.5, bar.reflection, faster, dashpots);
    UNSCOPED_INFO("dashpots " << dashpots << ": returned " << found << ", by theory " << wanted << "; damping took "
                              << taken << ", balance " << balance);
    CHECK(found < 0.02);
    // By 0.007 with elements of a twenty-fifth of the wavelength: see below.
    CHECK_THAT(found, WithinAbs(wanted, 0.01));
    CHECK_THAT(taken, WithinAbs(1 - found * found, 1e-5));
    CHECK(balance < 1e-6);
  }
  Bar alone;
  alone.layer = 0;
  alone.dashpots = true;
  const double found = alone.returned(), impedances = (faster - 1) / (faster + 1);
  UNSCOPED_INFO("dashpots alone: returned " << found << ", by impedances " << impedances);
  CHECK(found > 0.8 * impedances);
}

TEST_CASE("what plane waves of the continuum leave in layers of several lengths is what theory says") {
  for (double lengths : {0.5, 1.0, 2.0}) {
    Bar bar;
    bar.wave = Wave::plane;
    bar.element = 0.002;
    bar.layer = lengths * Bar::wavelength;
    const double found = bar.returned(), wanted = theory_of_packet(lengths, bar.reflection, 1, false);
    UNSCOPED_INFO(lengths << " wavelengths: returned " << found << ", by theory " << wanted);
    // Over elements of a fiftieth of the wavelength damping grows in steps, of which the theory knows nothing: of twice
    // the size they send back 0.009 more at one wavelength.
    CHECK_THAT(found, WithinAbs(wanted, 0.005 + 0.05 * wanted));
  }
}

TEST_CASE("a layer of two wavelengths sends less than 2 % of bending waves back") {
  Bar beam;
  beam.wave = Wave::bending;
  beam.layer = 2 * Bar::wavelength;
  const double found = beam.returned();
  UNSCOPED_INFO("bending: returned " << found);
  CHECK(found < 0.02);
}

TEST_CASE("layers do the same in single precision and with subcycling") {
  for (auto precision : {scene::Precision::mixed, scene::Precision::single_precision}) {
    Bar bar;
    bar.layer = 1.5 * Bar::wavelength;
    bar.precision = precision;
    CHECK(bar.returned() < 0.02);
  }
  Bar paced;
  paced.subcycling = true;
  paced.layer = 1.5 * Bar::wavelength;
  CHECK(paced.returned() < 0.02);
}

TEST_CASE("damping grows with the cube of the way to the end, and nodes beyond the layer have none") {
  Bar bar;
  Model model;
  build_model(bar.scene(), model);
  const double rate = 4 * steel().dilatational_speed() * std::log(1 / bar.reflection) / bar.layer;
  REQUIRE(model.absorbing.zones.size() == 2);
  CHECK_THAT(model.absorbing.zones[0].rate, WithinRel(rate, 1e-12));
  for (int n = 0; n < model.node_count(); ++n) {
    const double x = model.assembly.nodes[n][0], away = std::fmin(x, bar.length() - x);
    const double share = std::fmax(0, 1 - away / bar.layer);
    CHECK_THAT(model.absorbing.rate[n], WithinAbs(rate * share * share * share, 1e-9 * rate));
  }
  // The elements beyond are computed as without.
  REQUIRE(model.elements.size() == 2);
  CHECK(model.elements[0].damping.active() != model.elements[1].damping.active());
  CHECK(model.stable_step.limit < [&] {
    Bar without = bar;
    scene::Scene scene = without.scene();
    scene.absorbing_layers.clear();
    Model plain;
    build_model(scene, plain);
    return plain.stable_step.limit;
  }());
}

TEST_CASE("layers that cannot work are refused, and such as work badly are reported") {
  Bar bar;
  const auto complaint = [&](double length) {
    scene::Scene scene = bar.scene();
    scene.path = "bar.toml";
    for (auto& layer : scene.absorbing_layers) layer.line = 7, layer.length = length;
    return complaint_of_building(scene);
  };
  CHECK_THAT(complaint(0.003), ContainsSubstring("bar.toml:7: [absorbing_layers.block.x_min] length: 0.003 m is less "
                                                 "than the elements at 'block.x_min' are long (0.004 m)"));
  CHECK_THAT(complaint(0.5), ContainsSubstring("leaves nothing of part block undamped"));
  scene::Scene scene = bar.scene();
  scene.absorbing_layers[0].length = 0.01;
  add_motion(scene, {"block"}, {1, 0, 0}).name = "go";
  Model model;
  build_model(scene, model);
  std::string all;
  for (const std::string& doubt : scene_doubts(model, model.contacts, model.absorbing, model.step_size))
    all += doubt + "\n";
  CHECK_THAT(all, ContainsSubstring("is 2.5 elements deep"));
  CHECK_THAT(all, ContainsSubstring("which [initial_motion.go]"));
}

TEST_CASE("the reference's remark on slender parts with dashpots alone") {
  Bar bar;
  bar.layer = 0;
  bar.dashpots = true;
  Model slender;
  build_model(bar.scene(), slender);
  CHECK(describe_slender_ends(slender, slender.absorbing).size() == 2);
  bar.layer = 0.1;
  Model layered;
  build_model(bar.scene(), layered);
  CHECK(describe_slender_ends(layered, layered.absorbing).empty());
  scene::Scene cube = block_scene({0.1, 0.1, 0.1}, {4, 4, 4}, 1e-5);
  add_dashpots(cube, "block.x_max");
  Model thick;
  build_model(cube, thick);
  CHECK(describe_slender_ends(thick, thick.absorbing).empty());
}

/// The table of docs/verification.md.
TEST_CASE("table of what layers send back", "[.table]") {
  const scene::Material m = steel();
  const double faster = m.dilatational_speed() / std::sqrt(m.youngs_modulus / m.density);
  for (double reflection : {0.05, 0.01, 0.001})
    for (double lengths : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0})
      for (bool dashpots : {false, true}) {
        double found[2];
        for (Wave wave : {Wave::bar, Wave::bending}) {
          Bar bar;
          bar.wave = wave;
          bar.layer = lengths * Bar::wavelength;
          bar.dashpots = dashpots;
          bar.reflection = reflection;
          found[wave == Wave::bending] = bar.returned();
        }
        WARN("reflection " << reflection << ", " << lengths << " wavelengths, dashpots " << dashpots
                           << ": longitudinal " << found[0] << " (theory "
                           << theory_of_packet(lengths, reflection, faster, dashpots) << "), bending " << found[1]);
      }
}
