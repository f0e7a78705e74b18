#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/march.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// Volume and first moment of a mesh by integrals over the bilinear facets of its surface (divergence theorem), which
/// knows nothing of elements: V = 1/3 int x.n dA, int x_i dV = 1/2 int x_i^2 n_i dA.
struct Solid {
  double volume = 0;
  Vec3 moment{};
};

Solid enclosed(const Assembly& assembly, const std::vector<Face>& surface) {
  Solid solid;
  const double place[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (const Face& face : surface) {
    const auto corner = assembly.face_nodes(face);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double xi = place[a], eta = place[b];
        const double shape[4] = {(1 - xi) * (1 - eta), (1 + xi) * (1 - eta), (1 + xi) * (1 + eta),
                                 (1 - xi) * (1 + eta)};
        const double by_xi[4] = {eta - 1, 1 - eta, 1 + eta, -1 - eta}, by_eta[4] = {xi - 1, -1 - xi, 1 + xi, 1 - xi};
        Vec3 x{}, along_xi{}, along_eta{};
        for (int k = 0; k < 4; ++k) {
          x = x + 0.25 * shape[k] * assembly.nodes[corner[k]];
          along_xi = along_xi + 0.25 * by_xi[k] * assembly.nodes[corner[k]];
          along_eta = along_eta + 0.25 * by_eta[k] * assembly.nodes[corner[k]];
        }
        const Vec3 area = weight[a] * weight[b] * cross(along_xi, along_eta);
        solid.volume += dot(x, area) / 3;
        for (int i = 0; i < 3; ++i) solid.moment[i] += 0.5 * x[i] * x[i] * area[i];
      }
  }
  return solid;
}

std::vector<Face> box_surface(const Assembly& assembly) {
  std::vector<Face> all;
  for (const auto& [name, faces] : assembly.surfaces) all.insert(all.end(), faces.begin(), faces.end());
  return all;
}

}  // namespace

TEST_CASE("lumped masses add up to density times volume, and about the body's own centre") {
  for (int n : {1, 4})
    for (unsigned seed : {1u, 2u, 3u}) {
      const scene::Scene scene = block_scene({0.3, 0.2, 0.1}, {n, n, n}, 1);
      Assembly assembly = assemble(scene);
      warp(assembly, 0.1 / n, 0.25, seed);
      Model model;
      build_model(scene, assembly, model);
      const Solid solid = enclosed(assembly, box_surface(assembly));
      CHECK_THAT(total_mass(model), WithinRel(7800 * solid.volume, 1e-12));
      for (int i = 0; i < 3; ++i) {
        double moment = 0;
        for (std::size_t k = 0; k < model.mass.size(); ++k) moment += model.mass[k] * model.assembly.nodes[k][i];
        CHECK_THAT(moment, WithinRel(7800 * solid.moment[i], 1e-11));
      }
      for (double m : model.mass) CHECK(m > 0);
    }
}

TEST_CASE("a body falls freely with g, without stress") {
  for (int n : {1, 3})
    for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
      scene::Scene scene = block_scene({0.1, 0.1, 0.1}, {n, n, n}, 2e-3);
      set_hourglass(scene.parts[0], hourglass, 0.1);
      scene.gravity = {1, -2, -9.81};
      // A lone element's highest frequency is above what V / A_max tells: 0.73 h / C_d is the limit of a free cube.
      scene.time.step_scale = 0.5;
      Assembly assembly = assemble(scene);
      warp(assembly, 0.1 / n, 0.2, 4);
      Model model;
      build_model(scene, assembly, model);
      const auto nodes = all_nodes(model);
      double worst_mean = 0, worst_node = 0, stress = 0;
      march(model, model.step_count, [&] {
        const auto a = node_field(model, model.ties, NodeField::acceleration, nodes).values;
        for (std::size_t k = 0; k < a.size(); ++k)
          worst_node = std::max(worst_node, std::fabs(a[k] - scene.gravity[k % 3]));
        const Vec3 centre = mean(model, NodeField::acceleration, nodes);
        for (int i = 0; i < 3; ++i) worst_mean = std::max(worst_mean, std::fabs(centre[i] / scene.gravity[i] - 1));
        stress = std::max(stress, largest_stress(model));
      });
      INFO("mean a/g - 1: " << worst_mean << ", stress / E " << stress / 210e9 << ", node " << worst_node);
      CHECK(worst_mean < 1e-12);
      // Rounding of coordinates is all the strain that there is; its stress shakes single nodes by E eps / (rho h).
      CHECK(stress < 1e-13 * 210e9);
      CHECK(worst_node < 1e-13 * 210e9 / (7800 * 0.1 / n));
      const auto u = mean(model, NodeField::displacement, nodes);
      for (int i = 0; i < 3; ++i) CHECK_THAT(u[i], WithinRel(0.5 * scene.gravity[i] * model.time * model.time, 1e-9));
    }
}
