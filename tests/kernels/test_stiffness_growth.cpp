#include "kernels/monitor/stiffness_growth.hpp"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Modes of a brick h[0] x h[1] x h[2] after x -> F x.
void modes_of_brick(const double (&h)[3], const double (&F)[3][3], double (&x)[3][7]) {
  for (int i = 0; i < 3; ++i) {
    double place[8];
    for (int N = 0; N < 8; ++N) {
      place[N] = 0;
      for (int j = 0; j < 3; ++j) place[N] += F[i][j] * 0.5 * h[j] * mode_sign(j, N);
    }
    modes_of(place, x[i]);
  }
}

double growth(const double (&h)[3], const double (&F)[3][3]) {
  const double none[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double X[3][7], x[3][7], before[3][3], now[3][3];
  modes_of_brick(h, none, X);
  modes_of_brick(h, F, x);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      before[i][k] = X[i][k];
      now[i][k] = x[i][k];
    }
  return stiffness_growth(before, now);
}

constexpr double brick[3] = {0.01, 0.02, 0.005};

}  // namespace

TEST_CASE("the largest eigenvalue follows from three traces, equal ones too") {
  for (const auto& [a, b, c] : {std::array{3.0, 2.0, 1.0}, std::array{3.0, 3.0, 1e-3}, std::array{5.0, 1.0, 1.0}})
    CHECK_THAT(largest_eigenvalue(a + b + c, a * a + b * b + c * c, a * a * a + b * b * b + c * c * c),
               WithinRel(a, 1e-12));
  CHECK_THAT(largest_eigenvalue(3, 3, 3), WithinRel(1, 1e-7));
  CHECK_THAT(largest_eigenvalue(3.0003, 3.00060003, 3.00090009), WithinRel(1.0001, 1e-3));
}

TEST_CASE("an element becomes stiffer by det F over the square of its least stretch, whatever way it is turned") {
  const double c = std::cos(0.7), s = std::sin(0.7);
  CHECK_THAT(growth(brick, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), WithinAbs(1, 1e-7));
  CHECK_THAT(growth(brick, {{c, -s, 0}, {s, c, 0}, {0, 0, 1}}), WithinAbs(1, 1e-7));
  // Uniaxial strain to half: M A / h. At constant volume: (A / h) of a quarter of the height.
  CHECK_THAT(growth(brick, {{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}}), WithinRel(2, 1e-12));
  CHECK_THAT(growth(brick, {{2, 0, 0}, {0, 2, 0}, {0, 0, 0.25}}), WithinRel(16, 1e-12));
  CHECK_THAT(growth(brick, {{c, -0.5 * s, 0}, {s, 0.5 * c, 0}, {0, 0, 1}}), WithinRel(2, 1e-12));
  // Simple shear by 1: the least stretch is (sqrt(5) - 1) / 2.
  CHECK_THAT(growth(brick, {{1, 0, 1}, {0, 1, 0}, {0, 0, 1}}), WithinRel(4 / std::pow(std::sqrt(5) - 1, 2), 1e-12));
  CHECK(std::isinf(growth(brick, {{1, 0, 0}, {0, 1, 0}, {0, 0, -0.1}})));
}

TEST_CASE("the highest eigenvalue of a brick's stiffness is that of uniform strains") {
  const double none[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double x[3][7];
  // A cube of edge h: B = h^2 / 4 at each corner, so that Q = h / 16 times the modes' shares, and 2 + 3 r of it.
  const double cube[3] = {0.01, 0.01, 0.01};
  modes_of_brick(cube, none, x);
  double B[3][6];
  mean_gradient<double>(x, B);
  const double q = B[0][0] * B[0][0] / along(x[0], B[0]);
  CHECK_THAT(stiffness_over_mass(x, 1.5), WithinRel((2 + 3 * 1.5) * q, 1e-12));
  CHECK_THAT(stiffness_over_mass(x, 0), WithinRel(2 * q, 1e-7));
  // A flat one bears what its thickness bears, 2 + r, and little besides.
  modes_of_brick({0.1, 0.1, 0.001}, none, x);
  mean_gradient<double>(x, B);
  const double flat = B[2][2] * B[2][2] / along(x[2], B[2]);
  CHECK_THAT(stiffness_over_mass(x, 1.5), WithinRel(3.5 * flat, 1e-3));
  CHECK(stiffness_over_mass(x, 1.5) > 3.5 * flat);
  modes_of_brick(cube, {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, x);
  CHECK(stiffness_over_mass(x, 1.5) == 0);
}
