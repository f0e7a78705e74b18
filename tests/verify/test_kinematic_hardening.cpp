#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "model/elements/materials.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

constexpr double yield_stress = 400e6, tangent_modulus = 21e9;
constexpr double hardening = 210e9 * tangent_modulus / (210e9 - tangent_modulus);

/// A bar, free to contract, with materials that harden by the share beta.
scene::Scene bar(double beta, double end) {
  scene::Scene scene = yielding_bar(yield_stress, tangent_modulus, end);
  scene.materials[0].hardening_beta = beta;
  return scene;
}

/// Pulled to 480 MPa of nominal stress and pushed to as much, slowly.
scene::Scene pulled_and_pushed(double beta) {
  scene::Scene scene = bar(beta, 3e-3);
  scene.curves.push_back({});
  scene.curves[0].name = "cycle";
  scene.curves[0].type = scene::CurveType::table;
  for (int k = 0; k <= 300; ++k) {
    const double t = k / 300.0;
    const double value = t < 1.0 / 3 ? 0.5 * (1 - std::cos(3 * M_PI * t)) : std::cos(1.5 * M_PI * (t - 1.0 / 3));
    scene.curves[0].points.push_back({3e-3 * t, value});
  }
  add_traction(scene, "block.x_max", {480e6, 0, 0}, "cycle");
  return scene;
}

/// How far a bar of these has flown.
struct Flown {
  double pulled, end;  ///< plastic strain when it has been pulled; when it has been pushed too
  double imbalance;    ///< largest error of the energy account over the largest work done
};

Flown follow(Model& model) {
  const auto elements = all_elements(model);
  const auto strain = [&] { return element_plastic_strain(model, elements).values[0]; };
  double pulled = 0, worst = 0, largest = 1;
  march(model, model.step_count, [&] {
    if (model.step % 100 != 0 && model.step != model.step_count) return;
    if (model.time < 1.5e-3) pulled = strain();
    const EnergyAccount energy = account_energies(model, model.step_size);
    worst = std::max(worst, std::fabs(balance_total(energy)));
    largest = std::max(largest, energy.external_work);
  });
  return {pulled, strain(), worst / largest};
}

}  // namespace

TEST_CASE(
    "a bar pulled, then pushed as hard, flows back by what hardening is kinematic, and keeps its energy account") {
  for (const double beta : {1.0, 0.5, 0.0})
    for (const auto precision :
         {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
      scene::Scene scene = pulled_and_pushed(beta);
      scene.solver.precision = precision;
      Model model;
      build_model(scene, model);
      CHECK(model.elements[0].material.number == material_number(scene.materials[0]));
      CHECK((model.elements[0].material.history_values == KinematicBilinear::history_values) == (beta < 1));
      const auto [pulled, end, imbalance] = follow(model);
      // True stresses, from nominal ones by what the section has become: some 0.5 % more when pulled.
      const double flown = 80e6 / hardening;
      const double back = 160e6 * (1 - beta) / hardening;
      INFO("beta " << beta << ", precision " << static_cast<int>(precision) << ": pulled " << pulled / flown
                   << ", pushed " << (end - pulled) / flown << ", imbalance " << imbalance);
      CHECK_THAT(pulled, WithinRel(flown, 0.05));
      if (beta == 1)
        CHECK(end - pulled < 0.05 * flown);
      else
        CHECK_THAT(end - pulled, WithinRel(back, 0.08));
      CHECK(imbalance < 1e-3);
    }
}

TEST_CASE("a bar whose hardening saturates, pulled and pushed, flows as far as its law says and keeps its account") {
  for (const auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    scene::Scene scene = pulled_and_pushed(1);
    scene.solver.precision = precision;
    scene::Material& steel = scene.materials[0];
    steel.tangent_modulus = 0;
    steel.isotropic_saturation = 60e6;
    steel.isotropic_rate = 200;
    steel.back_stress_modulus = 24e9;
    steel.back_stress_recall = 150;
    Model model;
    build_model(scene, model);
    REQUIRE(model.elements[0].material.history_values == Chaboche::history_values);
    const auto [pulled, end, imbalance] = follow(model);
    CHECK(end > pulled);
    // True stress: the section shrinks as the bar grows longer.
    const auto excess = [&](double p) {
      const double size = yield_stress + 60e6 * (1 - std::exp(-200 * p)), place = 160e6 * (1 - std::exp(-150 * p));
      return 480e6 * std::exp(p + 480e6 / 210e9 * 0.6) - size - place;
    };
    double low = 0, high = 0.05;
    for (int k = 0; k < 60; ++k) (excess(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
    INFO("precision " << static_cast<int>(precision) << ": pulled " << pulled << " of " << low << ", imbalance "
                      << imbalance);
    CHECK_THAT(pulled, WithinRel(low, 0.03));
    CHECK(imbalance < 1e-3);
  }
}

TEST_CASE("rigid turns of a bar that has flown leave its stress as it was") {
  // Nodes in single precision go their own way once the run has begun: nobody can put them elsewhere.
  for (const auto precision : {scene::Precision::double_precision, scene::Precision::mixed}) {
    scene::Scene scene = block_scene({0.02, 0.01, 0.01}, {2, 2, 2}, 1e-5);
    scene.solver.precision = precision;
    scene.materials[0].yield_stress = yield_stress;
    scene.materials[0].tangent_modulus = tangent_modulus;
    scene.materials[0].hardening_beta = 0;
    Model model;
    build_model(scene, model);
    const auto elements = all_elements(model);
    const auto pulled = [](const Vec3& x, int) {
      return Vec3{1.004 * x[0] + 0.006 * x[1], 0.998 * x[1], 0.998 * x[2]};
    };
    const auto evaluate = [&](const std::function<Vec3(const Vec3&, int)>& field) {
      set_position(model, field);
      for (const ElementGroup& group : model.elements) renew_frames(model.nodes, group);
      compute_forces(model);
    };
    // Twice: what the series of the first return leaves out is settled by the second.
    for (int k = 0; k < 3; ++k) evaluate(pulled);
    const auto stress = element_stress(model, model.nodes, elements).values;
    const double flown = element_plastic_strain(model, elements).values[0];
    CHECK(flown > 1e-3);
    const auto axes = oblique_axes();
    evaluate([&](const Vec3& x, int n) { return turned(axes, pulled(x, n)); });
    const auto after = element_stress(model, model.nodes, elements).values;
    const double tolerance = precision == scene::Precision::double_precision ? 1e-9 : 1e-4;
    CHECK_THAT(element_plastic_strain(model, elements).values[0], WithinRel(flown, tolerance));
    constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    double worst = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double expected = 0;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) expected += axes[a][i] * axes[b][j] * stress[voigt[a][b]];
        worst = std::max(worst, std::fabs(after[voigt[i][j]] - expected) / yield_stress);
      }
    INFO("precision " << static_cast<int>(precision) << ": " << worst);
    CHECK(worst < tolerance);
  }
}

TEST_CASE("only parts whose hardening is kinematic have a back stress, and what is left out says so") {
  scene::Scene scene = bar(1, 1e-5);
  Model isotropic;
  build_model(scene, isotropic);
  CHECK(isotropic.elements[0].material.history_values == Bilinear::history_values);
  const auto says = [](const Model& model) {
    for (const std::string& what : model.left_out)
      if (what.rfind("back stress", 0) == 0) return true;
    return false;
  };
  CHECK(says(isotropic));
  scene.materials[0].hardening_beta = 0.5;
  Model mixed;
  build_model(scene, mixed);
  CHECK(mixed.elements[0].material.history_values == KinematicBilinear::history_values);
  CHECK_FALSE(says(mixed));
  CHECK(device_bytes(mixed) > device_bytes(isotropic));
}
