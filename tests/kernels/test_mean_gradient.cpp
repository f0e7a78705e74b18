#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <random>

#include "kernels/hourglass.hpp"
#include "kernels/mean_gradient.hpp"
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

void to_rows(const HexahedronCorners& corners, double (&x)[3][8]) {
  for (int N = 0; N < 8; ++N)
    for (int i = 0; i < 3; ++i) x[i][N] = corners[N][i];
}

}  // namespace

TEST_CASE("the mean gradient is the derivative of the exact volume") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    HexahedronCorners corners = random_hexahedron(seed);
    double x[3][8], B[3][8];
    to_rows(corners, x);
    mean_gradient(x, B);
    CHECK_THAT(volume_of(x, B), WithinAbs(hexahedron_volume(corners), 1e-14));
    for (int N = 0; N < 8; ++N)
      for (int i = 0; i < 3; ++i) {
        // The volume is linear in each single coordinate, so the central difference is exact.
        HexahedronCorners more = corners, less = corners;
        more[N][i] += 0.5;
        less[N][i] -= 0.5;
        CHECK_THAT(B[i][N], WithinAbs(hexahedron_volume(more) - hexahedron_volume(less), 1e-14));
      }
  }
}

TEST_CASE("hourglass shape vectors ignore linear fields and span what the gradient cannot see") {
  const HexahedronCorners corners = random_hexahedron(7);
  double x[3][8], B[3][8], xm[3][4];
  to_rows(corners, x);
  mean_gradient(x, B);
  const double volume = volume_of(x, B);
  hourglass_moments(x, xm);
  for (int M = 0; M < 4; ++M) {
    double sum = 0, along[3] = {0, 0, 0}, direct[3] = {0, 0, 0};
    for (int N = 0; N < 8; ++N) {
      const double gamma =
          hourglass_base(M, N) - (B[0][N] * xm[0][M] + B[1][N] * xm[1][M] + B[2][N] * xm[2][M]) / volume;
      sum += gamma;
      for (int i = 0; i < 3; ++i) {
        along[i] += gamma * x[i][N];
        direct[i] += hourglass_base(M, N) * x[i][N];
      }
    }
    CHECK_THAT(sum, WithinAbs(0, 1e-14));
    for (int i = 0; i < 3; ++i) {
      CHECK_THAT(along[i], WithinAbs(0, 1e-14));
      CHECK_THAT(xm[i][M], WithinAbs(direct[i], 1e-14));
    }
  }
}

TEST_CASE("hourglass forces at the corners are sums of the base vectors") {
  const double q[4] = {1.5, -0.25, 3.0, 0.75};
  double g[8];
  hourglass_at_corners(q, g);
  for (int N = 0; N < 8; ++N) {
    double direct = 0;
    for (int M = 0; M < 4; ++M) direct += q[M] * hourglass_base(M, N);
    CHECK_THAT(g[N], WithinAbs(direct, 1e-15));
  }
}
