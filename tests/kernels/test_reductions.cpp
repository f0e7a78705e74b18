#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "kernels/reductions.hpp"
#include "model/host_copy.hpp"

using namespace railwave;

namespace {

/// A number and its square.
struct Powers {
  static constexpr int values = 2;
  Array<const double*> number;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const {
    sum[0] += number(i);
    sum[1] += number(i) * number(i);
  }
};

struct Number {
  static constexpr int values = 1;
  Array<const double*> number;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const { value[0] = number(i); }
};

}  // namespace

TEST_CASE("sums and largest values fetched together are those fetched alone, however many blocks they have") {
  const std::vector<int> counts = {0, 1, 32, 33, 1024, 1025, 40000, 7};
  ReductionSpace together, alone;
  Reductions queue(together);
  std::vector<double> sums(2 * counts.size(), -1), largest(counts.size(), -1);
  std::vector<Array<const double*>> numbers;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    std::vector<double> list;
    for (int i = 0; i < counts[c]; ++i) list.push_back(std::sin(1.0 + i) / 3);
    numbers.push_back(to_device("numbers", list));
    queue.sum(Powers{numbers[c]}, counts[c], [&sums, c](const double* sum) { std::copy(sum, sum + 2, &sums[2 * c]); });
    queue.largest(Number{numbers[c]}, counts[c], [&largest, c](const Largest<1>& of) { largest[c] = of.place[0] < 0 ? 0 : of.value[0]; });
  }
  queue.fetch();
  for (std::size_t c = 0; c < counts.size(); ++c) {
    double sum[2], expected[2] = {}, most = counts[c] > 0 ? -1 : 0;
    for (int i = 0; i < counts[c]; ++i) {
      const double number = std::sin(1.0 + i) / 3;
      expected[0] += number;
      expected[1] += number * number;
      most = std::fmax(most, number);
    }
    block_sum(Powers{numbers[c]}, counts[c], sum, alone);
    for (int k = 0; k < 2; ++k) {
      CHECK(sums[2 * c + k] == sum[k]);
      CHECK(std::fabs(sum[k] - expected[k]) <= 1e-14 * (1 + counts[c]));
    }
    CHECK(largest[c] == most);
  }
  int asked = 0;
  queue.sum(Powers{numbers[1]}, 1, [&](const double*) { ++asked; });
  queue.fetch();
  queue.fetch();
  CHECK(asked == 1);
}
