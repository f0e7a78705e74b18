#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <random>

#include "model/elements/materials.hpp"
#include "tests/verify/block.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

/// MacNeal and Harder 1985, fig. 2: a unit cube of seven hexahedra, the inner one warped; and their displacement field
/// u = 1e-3 (2x + y + z)/2, v = 1e-3 (x + 2y + z)/2, w = 1e-3 (x + y + 2z)/2.
Assembly seven_hexahedra() {
  Assembly assembly;
  assembly.nodes = {{0, 0, 0},
                    {1, 0, 0},
                    {1, 1, 0},
                    {0, 1, 0},
                    {0, 0, 1},
                    {1, 0, 1},
                    {1, 1, 1},
                    {0, 1, 1},
                    {0.249, 0.342, 0.192},
                    {0.826, 0.288, 0.288},
                    {0.850, 0.649, 0.263},
                    {0.273, 0.750, 0.230},
                    {0.320, 0.186, 0.643},
                    {0.677, 0.305, 0.683},
                    {0.788, 0.693, 0.644},
                    {0.165, 0.745, 0.702}};
  assembly.elements = {{8, 9, 10, 11, 12, 13, 14, 15}, {0, 1, 2, 3, 8, 9, 10, 11},  {12, 13, 14, 15, 4, 5, 6, 7},
                       {0, 1, 9, 8, 4, 5, 13, 12},     {1, 2, 10, 9, 5, 6, 14, 13}, {2, 3, 11, 10, 6, 7, 15, 14},
                       {3, 0, 8, 11, 7, 4, 12, 15}};
  assembly.parts.push_back({"block", 0, 16, 0, 7, 0});
  return assembly;
}

/// A block of n^3 elements whose inner nodes are moved at random by up to 0.3 of an element.
Assembly random_block(int n, unsigned seed) {
  scene::Scene scene = block_scene({1, 1, 1}, {n, n, n}, 1);
  Assembly assembly = assemble(scene);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-0.3 / n, 0.3 / n);
  for (Vec3& x : assembly.nodes) {
    bool inside = true;
    for (double c : x) inside = inside && c > 1e-9 && c < 1 - 1e-9;
    if (inside)
      for (double& c : x) c += shift(generator);
  }
  return assembly;
}

Vec3 displaced(const Vec3& x) {
  return {x[0] + 0.5e-3 * (2 * x[0] + x[1] + x[2]), x[1] + 0.5e-3 * (x[0] + 2 * x[1] + x[2]),
          x[2] + 0.5e-3 * (x[0] + x[1] + 2 * x[2])};
}

ElasticConstants constants_of(const Model& model) { return elastic_constants(model.scene.materials[0]); }

/// Stress of the uniform deformation: the material's own function of its gradient.
void exact_stress(const Model& model, double (&stress)[6]) {
  // F = I + 1e-3 A with A = [[1, .5, .5], [.5, 1, .5], [.5, .5, 1]]; its inverse by the same symmetric form p I + q 1
  // 1^T.
  const double diagonal = 1 + 0.5e-3, q = 0.5e-3;  // F = diagonal I + q 1 1^T
  const double inner = -q / (diagonal * (diagonal + 3 * q));
  double G[3][3], H[3][3], e[6], h[6], tau[6];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      G[i][j] = (i == j ? 1 / diagonal : 0) + inner;
      H[i][j] = (i == j ? 1 : 0) - G[i][j];
    }
  almansi_strain<double>(H, e);
  hencky_strain(e, h);
  kirchhoff_stress<double>(constants_of(model), h, tau);
  for (int c = 0; c < 6; ++c) stress[c] = tau[c] * determinant(G);
}

void check_stress(const Model& model) {
  double exact[6], largest = 0, worst = 0;
  exact_stress(model, exact);
  for (double s : exact) largest = std::max(largest, std::fabs(s));
  // Small-strain theory, as MacNeal and Harder state it: E = 1e6, nu = 1/4 give 2000 and 400; here scaled to steel.
  CHECK_THAT(exact[0],
             Catch::Matchers::WithinRel(3e-3 * constants_of(model).lambda + 2e-3 * constants_of(model).mu, 0.01));
  const auto stress = element_stress(model, model.nodes, all_elements(model));
  for (std::size_t k = 0; k < stress.values.size(); ++k)
    worst = std::max(worst, std::fabs(stress.values[k] - exact[k % 6]) / largest);
  INFO("worst stress error " << worst);
  CHECK(worst < 1e-10);
}

/// Nodes inside the unit cube.
std::vector<int> inner_nodes(const Model& model) {
  std::vector<int> inner;
  for (int n = 0; n < model.nodes.count; ++n) {
    bool inside = true;
    for (double c : model.assembly.nodes[n]) inside = inside && c > 1e-6 && c < 1 - 1e-6;
    if (inside) inner.push_back(n);
  }
  return inner;
}

/// Forces on nodes inside, relative to those on the surface.
double inner_unbalance(const Model& model, const std::vector<int>& inner) {
  double outer = 0, worst = 0;
  for (double a : node_field(model, model.ties, NodeField::acceleration, all_nodes(model)).values)
    outer = std::max(outer, std::fabs(a));
  for (double a : node_field(model, model.ties, NodeField::acceleration, inner).values)
    worst = std::max(worst, std::fabs(a));
  return worst / outer;
}

void patch_test(const Assembly& assembly, std::size_t inner_count, scene::HourglassType hourglass) {
  scene::Scene scene = block_scene({1, 1, 1}, {1, 1, 1}, 1e-3);
  set_hourglass(scene.parts[0], hourglass, 0.1);
  Model model;
  build_model(scene, assembly, model);
  set_position(model, [](const Vec3& x, int) { return displaced(x); });
  compute_forces(model);
  check_stress(model);
  const auto inner = inner_nodes(model);
  REQUIRE(inner.size() == inner_count);
  CHECK(inner_unbalance(model, inner) < 1e-10);
}

}  // namespace

TEST_CASE("patch test on seven warped hexahedra (MacNeal and Harder)") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness})
    patch_test(seven_hexahedra(), 8, hourglass);
}

TEST_CASE("patch test on a random warped mesh") {
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness})
    patch_test(random_block(6, 42), 125, hourglass);
}
