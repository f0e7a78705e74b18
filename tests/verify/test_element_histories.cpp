// Histories of stress and strain in single elements, and means over sets, against exact deformations and solutions.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <Eigen/Eigenvalues>

#include "case/read_case.hpp"
#include "model/elements/element_histories.hpp"
#include "post/contact_patch.hpp"
#include "source_folder.hpp"
#include "tests/verify/march.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

std::vector<ElementMeans> means_of(const Model& model) {
  std::vector<ElementMeans> means;
  SampleSums sums(*model.reduction_space);
  sum_element_parts(model, model.nodes, ExecutionSpace());
  queue_element_means(model, means, sums);
  sums.fetch();
  return means;
}

void probe(scene::Scene& scene, const std::string& name, const std::string& part, const Vec3& position) {
  scene::ElementSet set;
  set.name = name;
  set.part = part;
  set.position = position;
  scene.element_sets.push_back(set);
  scene.output.history_sets.push_back(part + "." + name);
}

void box(scene::Scene& scene, const std::string& name, const scene::Box& box) {
  scene::ElementSet set;
  set.name = name;
  set.part = "block";
  set.box = box;
  scene.element_sets.push_back(set);
  scene.output.history_sets.push_back("block." + name);
}

}  // namespace

TEST_CASE("a block stretched and turned far has its logarithmic strain in every element, in any precision") {
  const auto rows = oblique_axes();
  const Vec3 stretch{1.3, 0.8, 1.05};
  for (const auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    scene::Scene scene = block_scene({0.4, 0.2, 0.3}, {4, 3, 5}, 1);
    scene.solver.precision = precision;
    probe(scene, "inside", "block", {0.23, 0.11, 0.17});
    box(scene, "half", {{{0, 0, 0}, {0.2, 1, 1}}});
    Model model;
    build_model(scene, model);
    set_position(model, [&](const Vec3& x, int) {
      return turned(rows, {stretch[0] * x[0], stretch[1] * x[1], stretch[2] * x[2]});
    });
    for (const ElementGroup& group : model.elements) renew_frames(model.nodes, group);
    // ln V = R diag(ln stretch) R^T, R's columns the turned axes.
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (const ElementMeans& mean : means_of(model))
      for (int c = 0; c < 6; ++c) {
        double exact = 0;
        for (int k = 0; k < 3; ++k) exact += rows[k][row[c]] * rows[k][column[c]] * std::log(stretch[k]);
        CHECK_THAT(mean.strain[c], WithinAbs(exact, 1e-12));
      }
  }
}

TEST_CASE("strain is zero to rounding under a turn, and exact where it is tiny") {
  scene::Scene scene = block_scene({0.4, 0.2, 0.3}, {4, 3, 5}, 1);
  probe(scene, "inside", "block", {0.23, 0.11, 0.17});
  Model model;
  build_model(scene, model);
  set_position(model, [&](const Vec3& x, int) { return turned(oblique_axes(), x); });
  const ElementMeans turned_only = means_of(model)[0];
  for (double strain : turned_only.strain) CHECK_THAT(strain, WithinAbs(0, 1e-14));
  set_position(model, [&](const Vec3& x, int) { return Vec3{x[0] + 1e-9 * x[0] + 4e-9 * x[1], x[1], x[2]}; });
  CHECK_THAT(means_of(model)[0].strain[0], WithinRel(1e-9, 1e-5));
  CHECK_THAT(means_of(model)[0].strain[3], WithinRel(2e-9, 1e-5));
}

TEST_CASE("listed elements have the stress that fields have, bit for bit, of every group and precision") {
  for (const auto precision : {scene::Precision::double_precision, scene::Precision::mixed}) {
    scene::Scene scene = blocks_of_two_materials(precision);
    scene.output.history_sets.clear();
    for (const scene::Part& part : scene.parts) {
      const Assembly assembly = assemble(scene);
      const auto& nodes = assembly.nodes;
      for (const auto& range : assembly.parts)
        if (range.name == part.name)
          probe(scene, "first", part.name, nodes[range.first_node]),
              probe(scene, "last", part.name, nodes[range.first_node + range.node_count - 1]);
    }
    Model model;
    build_model(scene, model);
    set_position(model, [](const Vec3& x, int) {
      return Vec3{x[0] + 5e-3 * x[0] * x[0], x[1] - 2e-3 * x[2] * x[0], x[2]};
    });
    for (const ElementGroup& group : model.elements) {
      renew_frames(model.nodes, group);
      if (group.material.flows()) Kokkos::deep_copy(group.material.history, 0.125);
    }
    const auto means = means_of(model);
    const auto sets = resolve_history_sets(model.scene, model.assembly);
    REQUIRE(means.size() == 4);
    for (std::size_t s = 0; s < means.size(); ++s) {
      REQUIRE(sets[s].elements.size() == 1);
      const auto stress = element_stress(model, model.nodes, sets[s].elements).values;
      CHECK(std::vector<double>(means[s].stress.begin(), means[s].stress.end()) == stress);
      const bool yields = sets[s].name.rfind(scene.parts[0].name + ".", 0) == 0;
      CHECK(means[s].plastic_strain == (yields ? 0.125 : 0.0));
    }
  }
}

TEST_CASE("a mean over a set is by volume") {
  scene::Scene scene = block_scene({0.4, 0.2, 0.3}, {4, 2, 3}, 1);
  box(scene, "all", {{{0, 0, 0}, {1, 1, 1}}});
  Model model;
  build_model(scene, model);
  // Strain grows along x: its mean is that in the middle. Exact to second order of what is small.
  set_position(model, [](const Vec3& x, int) { return Vec3{x[0] + 5e-6 * x[0] * x[0], x[1], x[2]}; });
  const ElementMeans mean = means_of(model)[0];
  const double modulus = 210e9 * 0.7 / (1.3 * 0.4), strain = 1e-5 * 0.2;
  CHECK_THAT(mean.strain[0], WithinRel(strain, 1e-5));
  CHECK_THAT(mean.stress[0], WithinRel(modulus * strain, 2e-5));
  CHECK_THAT(mean.stress[2], WithinRel(modulus * strain * 3 / 7, 2e-5));
}

TEST_CASE("a scene that asks for no stress or strain has no arrays for it") {
  scene::Scene scene = block_scene({0.4, 0.2, 0.3}, {4, 2, 3}, 1);
  scene.output.history_sets = {"block.z_max"};
  Model model;
  build_model(scene, model);
  CHECK(model.element_histories == nullptr);
}

TEST_CASE("a bar pulled slowly past yield: stress, strain and plastic strain inside it follow the uniaxial law") {
  const double yield = 400e6, tangent = 21e9, E = 210e9;
  scene::Scene scene = yielding_bar(yield, tangent, 2.5e-3);
  add_ramp(scene, "on", 0, 2.5e-3);
  add_traction(scene, "block.x_max", {500e6, 0, 0}, "on");
  probe(scene, "inside", "block", {0.011, 0.004, 0.006});
  Model model;
  build_model(scene, model);
  std::vector<ElementMeans> seen;
  march(model, model.step_count, [&] {
    if (model.step % 20 == 0 || model.step == model.step_count) seen.push_back(means_of(model)[0]);
  });
  const ElementMeans& last = seen.back();
  // True stress: the traction is on the reference area, which shrinks.
  const double across = last.strain[1] + last.strain[2];
  CHECK_THAT(last.stress[0], WithinRel(500e6 * std::exp(-across), 2e-3));
  for (const ElementMeans& one : seen) {
    // The law is one of Kirchhoff's stress, J times Cauchy's.
    const double stress = one.stress[0] * std::exp(one.strain[0] + one.strain[1] + one.strain[2]);
    const double flow = std::fmax(0.0, (stress - yield) * (1 / tangent - 1 / E));
    CHECK_THAT(one.strain[0], WithinAbs(stress / E + flow, 1e-5));
    CHECK_THAT(one.plastic_strain, WithinAbs(flow, 1e-5));
    CHECK_THAT(one.stress[1], WithinAbs(0, 3e6));
    CHECK_THAT(one.strain[3], WithinAbs(0, 1e-6));  // waves across the bar
  }
  CHECK(last.plastic_strain > 4e-3);
}

namespace {

/// Largest shear stress of a stress xx, yy, zz, xy, yz, zx.
double largest_shear(const std::array<double, 6>& s) {
  Eigen::Matrix3d matrix;
  matrix << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  return 0.5 * (principal[2] - principal[0]);
}

/// On the axis of Hertz's circular contact at a depth of z radii, over the peak pressure (Johnson, Contact Mechanics,
/// eq. 3.45).
double exact_shear(double z, double nu) {
  const double along = -1 / (1 + z * z), across = -(1 + nu) * (1 - z * std::atan(1 / z)) + 0.5 / (1 + z * z);
  return 0.5 * (across - along);
}

}  // namespace

// Cells of 2.4 mm over a block of 14.4 mm, one of them on the axis.
TEST_CASE("probes under a sphere find Hertz's largest shear at 0.48 of the contact's radius") {
  std::vector<std::string> changed{"contacts.hertz.algorithm=multiplier", "settle.tolerance=2e-3"};
  for (const std::string mesh : {"sphere", "block"})
    for (const char* key : {"zone_size=2.4e-3", "zone_layers=4", "growth=1.5", "coarse_size=0.04"})
      changed.push_back("meshes." + mesh + "." + key);
  for (const char* key : {"zone_start=-0.0108", "zone_end=0.0108", "zone_width=0.0216", "zone_centre=0"})
    changed.push_back(std::string("meshes.block.") + key);
  scene::Scene scene = read_case(source_folder + "/cases/verify/hertz_sphere.toml", changed);
  for (int k = 0; k < 4; ++k) probe(scene, "depth_" + std::to_string(k), "block", {0, 0, -1.2e-3 - 2.4e-3 * k});
  Model model;
  build_model(scene, model);
  CHECK(settle_whole(model).settled);
  compute_forces(model);
  const double force = contact_solution(contact_state(model, model.ties, model.contacts, 0)).whole.normal_force,
               radius = 0.46, modulus = 210e9 / (2 * (1 - 0.09));
  const double a = std::cbrt(0.75 * force * radius / modulus), peak = 1.5 * force / (M_PI * a * a);
  const auto means = means_of(model);
  const auto sets = resolve_history_sets(model.scene, model.assembly);
  double depth[4], shear[4];
  for (int k = 0; k < 4; ++k) {
    depth[k] = -sets[k].element_centre[2] / a;
    shear[k] = largest_shear(means[k].stress) / peak;
    INFO("depth " << depth[k] << " a: " << shear[k] << " p0, exact " << exact_shear(depth[k], 0.3)
                  << "; off the axis by " << sets[k].element_centre[0] / a << ", " << sets[k].element_centre[1] / a
                  << " a");
    CHECK(std::fabs(sets[k].element_centre[0]) + std::fabs(sets[k].element_centre[1]) < 0.05 * a);
    // The first element lies right under the surface, where six cells over the block give its pressure by 6 %.
    CHECK_THAT(shear[k], WithinAbs(exact_shear(depth[k], 0.3), k == 0 ? 0.03 : 0.02));
  }
  CHECK(*std::max_element(shear, shear + 4) == shear[1]);  // 0.49 a
  CHECK_THAT(shear[1], WithinAbs(0.31, 0.015));
}
