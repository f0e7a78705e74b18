#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "kernels/monitor/monitor_terms.hpp"

using namespace railwave;

TEST_CASE("an element's smallest Jacobian and hourglass modes are those of its corners") {
  ElementShape cube;
  const int at[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int N = 0; N < 8; ++N)
    for (int i = 0; i < 3; ++i) cube.x[N][i] = 2 * at[N][i];
  CHECK(cube.smallest_jacobian() == 1);  // an eighth of the volume
  for (int m = 0; m < 4; ++m) CHECK(cube.hourglass_mode(m) == 0);
  ElementShape turned_over = cube;
  turned_over.x[6] = {{-1, -1, -1}};
  CHECK(turned_over.smallest_jacobian() < 0);
  turned_over.x[6][0] = std::nan("");
  CHECK(std::isnan(turned_over.smallest_jacobian()));
  for (int N = 0; N < 8; ++N) cube.x[N][2] += 0.25 * mode_sign(5, N);
  CHECK(cube.hourglass_mode(2) == 0.25);
}
