#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>

#include "kernels/reductions.hpp"
#include "kernels/watch_terms.hpp"
#include "model/host_copy.hpp"

using namespace railwave;

namespace {

struct Row {
  static constexpr int values = 2;
  Array<const double*> number;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const {
    value[0] = number(i);
    value[1] = -number(i);
  }
};

Largest<2> largest_of(const std::vector<double>& numbers) {
  Largest<2> found;
  ReductionSpace space;
  Reductions looks(space);
  looks.largest(Row{to_device("numbers", numbers)}, static_cast<int>(numbers.size()), [&](const Largest<2>& of) { found = of; });
  looks.fetch();
  return found;
}

}  // namespace

TEST_CASE("of equal values the lowest item is told, and what is no number is the largest") {
  for (int count : {1, 31, 32, 33, 5000}) {
    std::vector<double> numbers(count);
    for (int i = 0; i < count; ++i) numbers[i] = (i * 7) % 13;
    auto found = largest_of(numbers);
    int first = 0, least = 0;
    for (int i = 0; i < count; ++i) {
      if (numbers[i] > numbers[first]) first = i;
      if (numbers[i] < numbers[least]) least = i;
    }
    CHECK(found.place[0] == first);
    CHECK(found.value[0] == numbers[first]);
    CHECK(found.place[1] == least);
    numbers[count / 2] = std::nan("");
    found = largest_of(numbers);
    CHECK(found.place[0] == count / 2);
    CHECK(found.value[0] == std::numeric_limits<double>::infinity());
  }
  CHECK(largest_of({}).place[0] == -1);
}

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
