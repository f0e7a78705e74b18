#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mesh/hexahedron.hpp"
#include "model/assembly.hpp"

/// Meshes out of shape, for the stability map and for the tests of tests/torture.
namespace railwave::bench {

/// How a block of bricks is put out of shape.
struct Distortion {
  std::string name;
  std::array<int, 3> divisions;
  Vec3 size;               ///< m, of one element
  double lean = 0;         ///< of z on x, cotangent of the angle between edges
  double all_nodes = 0;    ///< largest random move of any node, over the element's smallest edge
  double inner_nodes = 0;  ///< the same of nodes inside
};

/// As many elements as show both inside, surface, edge and corner; and bodies thinner than that.
inline std::vector<Distortion> distortions() {
  const double h = 1e-3, lean = 2.7474774194546221;  // cot 20 degrees
  return {
      {"cubes", {5, 5, 5}, {h, h, h}},
      {"aspect 3", {5, 5, 5}, {h, h, h / 3}},
      {"aspect 10", {5, 5, 5}, {h, h, h / 10}},
      {"aspect 50", {5, 5, 5}, {h, h, h / 50}},
      {"columns, aspect 10", {5, 5, 5}, {h, h, 10 * h}},
      {"skewed to 20 degrees", {5, 5, 5}, {h, h, h}, lean},
      {"warped", {5, 5, 5}, {h, h, h}, 0, 0.2},
      {"near-degenerate", {5, 5, 5}, {h, h, h}, 0, 0, 1},
      {"two thick", {6, 6, 2}, {h, h, h}},
      {"plate", {7, 7, 1}, {h, h, h}},
      {"bar", {12, 1, 1}, {h, h, h}},
      {"one cube", {1, 1, 1}, {h, h, h}},
      {"warped plate", {7, 7, 1}, {h, h, h}, 0, 0.2},
  };
}

inline double smallest_jacobian_at_points(const Assembly& assembly) {
  const double g = 1 / std::sqrt(3.0);
  double least = 1e300;
  for (const auto& element : assembly.elements) {
    const HexahedronCorners x = corners_of(assembly.nodes, element);
    for (const auto& s : hexahedron_corner_signs)
      least = std::fmin(least, hexahedron_jacobian(x, g * s[0], g * s[1], g * s[2]));
  }
  return least;
}

/// Moves nodes at random. `inner` ones as far as keeps the smallest Jacobian at any integration point above 0.05 of the
/// undistorted; below 0 the mesh is refused.
inline void scatter(const Distortion& distortion, Assembly& assembly) {
  const double edge = std::min({distortion.size[0], distortion.size[1], distortion.size[2]});
  const std::vector<Vec3> regular = assembly.nodes;
  const auto move = [&](double share, bool inner) {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> shift(-edge, edge);
    for (std::size_t n = 0; n < regular.size(); ++n) {
      bool inside = true;
      for (int i = 0; i < 3; ++i) {
        const double at = regular[n][i] / distortion.size[i];
        inside = inside && at > 0.5 && at < distortion.divisions[i] - 0.5;
      }
      for (int i = 0; i < 3; ++i) {
        const double by = share * shift(generator);
        assembly.nodes[n][i] = regular[n][i] + (inside || !inner ? by : 0);
      }
    }
  };
  if (distortion.all_nodes > 0) move(distortion.all_nodes, false);
  if (distortion.inner_nodes == 0) return;
  const double least = 0.05 * edge * edge * edge / 8;
  double low = 0, high = distortion.inner_nodes;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    move(middle, true);
    (smallest_jacobian_at_points(assembly) > least ? low : high) = middle;
  }
  move(low, true);
}

/// Puts a block's assembly, one of the distortion's divisions and sizes, out of shape.
inline void distort(const Distortion& distortion, Assembly& assembly) {
  scatter(distortion, assembly);
  for (Vec3& x : assembly.nodes) x[0] += distortion.lean * x[2];
}

}  // namespace railwave::bench
