#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <random>

#include "kernels/elements/hourglass.hpp"
#include "mesh/hexahedron.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

namespace {

/// A unit cube with every corner moved at random by up to 0.2.
HexahedronCorners random_hexahedron(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  HexahedronCorners x;
  for (int N = 0; N < 8; ++N)
    for (int i = 0; i < 3; ++i) x[N][i] = 0.5 * hexahedron_corner_signs[N][i] + shift(generator);
  return x;
}

/// Modes of the coordinates, direction by direction.
void modes_of_corners(const HexahedronCorners& corners, double (&x)[3][7]) {
  for (int i = 0; i < 3; ++i) {
    double u[8];
    for (int N = 0; N < 8; ++N) u[N] = corners[N][i];
    modes_of(u, x[i]);
  }
}

/// B at the corners, from its modes.
void corner_gradient(const double (&B)[3][6], double (&at_corner)[3][8]) {
  for (int i = 0; i < 3; ++i) {
    double m[7] = {B[i][0], B[i][1], B[i][2], B[i][3], B[i][4], B[i][5], 0};
    corners_of(m, at_corner[i]);
  }
}

}  // namespace

TEST_CASE("modes are sums over the corners with the modes' signs, and corners sums over the modes") {
  const double u[8] = {0.3, -1.5, 2.25, 7, -0.125, 4, 1.75, -3};
  double m[7], f[8];
  modes_of(u, m);
  for (int k = 0; k < 7; ++k) {
    double direct = 0;
    for (int N = 0; N < 8; ++N) direct += mode_sign(k, N) * u[N];
    CHECK_THAT(m[k], WithinAbs(direct, 1e-14));
  }
  corners_of(m, f);
  for (int N = 0; N < 8; ++N) {
    double direct = 0;
    for (int k = 0; k < 7; ++k) direct += mode_sign(k, N) * m[k];
    CHECK_THAT(f[N], WithinAbs(direct, 1e-13));
  }
}

TEST_CASE("the mean gradient is the derivative of the exact volume") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    HexahedronCorners corners = random_hexahedron(seed);
    double x[3][7], B[3][6], at_corner[3][8];
    modes_of_corners(corners, x);
    mean_gradient<double>(x, B);
    corner_gradient(B, at_corner);
    for (int i = 0; i < 3; ++i) CHECK_THAT(along(x[i], B[i]), WithinAbs(hexahedron_volume(corners), 1e-14));
    for (int N = 0; N < 8; ++N)
      for (int i = 0; i < 3; ++i) {
        // The volume is linear in each single coordinate, so the central difference is exact.
        HexahedronCorners more = corners, less = corners;
        more[N][i] += 0.5;
        less[N][i] -= 0.5;
        CHECK_THAT(at_corner[i][N], WithinAbs(hexahedron_volume(more) - hexahedron_volume(less), 1e-14));
      }
  }
}

TEST_CASE("a field's hourglass content is what its mean gradient does not explain") {
  const HexahedronCorners corners = random_hexahedron(7);
  double x[3][7], B[3][6], at_corner[3][8];
  modes_of_corners(corners, x);
  mean_gradient<double>(x, B);
  corner_gradient(B, at_corner);
  const double volume = along(x[0], B[0]);
  const double slope[3] = {0.7, -1.3, 0.4};
  for (int M = 0; M < 4; ++M) {
    // Of a linear field: nothing.
    double u[8], m[7];
    for (int N = 0; N < 8; ++N)
      u[N] = 5 + slope[0] * corners[N][0] + slope[1] * corners[N][1] + slope[2] * corners[N][2];
    modes_of(u, m);
    double gradient[3];
    for (int j = 0; j < 3; ++j) {
      gradient[j] = along(m, B[j]) / volume;
      CHECK_THAT(gradient[j], WithinAbs(slope[j], 1e-13));
    }
    CHECK_THAT(hourglass_content(m, gradient, x, M), WithinAbs(0, 1e-13));
    // Of any field: its sum with the orthogonal shape vector gamma_M.
    for (int N = 0; N < 8; ++N) u[N] = std::sin(3.0 * N + M);
    modes_of(u, m);
    for (int j = 0; j < 3; ++j) gradient[j] = along(m, B[j]) / volume;
    double direct = 0;
    for (int N = 0; N < 8; ++N) {
      double gamma = mode_sign(3 + M, N);
      for (int j = 0; j < 3; ++j) gamma -= at_corner[j][N] * x[j][3 + M] / volume;
      direct += gamma * u[N];
    }
    CHECK_THAT(hourglass_content(m, gradient, x, M), WithinAbs(direct, 1e-13));
  }
}
