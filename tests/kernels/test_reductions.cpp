#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>

#include "kernels/support/joined_sums.hpp"
#include "kernels/support/reductions.hpp"
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

/// A number and its negative.
struct Signed {
  static constexpr int values = 2;
  Array<const double*> number;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* value) const {
    value[0] = number(i);
    value[1] = -number(i);
  }
};

/// One, with a number's sign.
struct Sign {
  static constexpr int values = 1;
  Array<const double*> number;
  KOKKOS_INLINE_FUNCTION void operator()(int i, double* sum) const { sum[0] += number(i) < 0 ? -1 : 1; }
};

Largest<2> largest_of(const std::vector<double>& numbers) {
  Largest<2> found;
  ReductionSpace space;
  Reductions reductions(space);
  reductions.largest(Signed{to_device("numbers", numbers)}, static_cast<int>(numbers.size()),
                     [&](const Largest<2>& of) { found = of; });
  reductions.fetch();
  return found;
}

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
    queue.largest(Signed{numbers[c]}, counts[c],
                  [&largest, c](const Largest<2>& of) { largest[c] = of.place[0] < 0 ? 0 : of.value[0]; });
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

TEST_CASE("a sum that stays on the device is to the last bit the one that its host would get") {
  ReductionSpace space, other;
  const Array<double*> sums("sums", 8);
  std::vector<double> expected;
  for (const int count : {0, 1, 31, 128, 4097, 70001, 300000, 5}) {
    std::vector<double> list;
    for (int i = 0; i < count; ++i) list.push_back(std::sin(3.0 + i) / 7);
    const ArraySum term{to_device("numbers", list)};
    block_sum(term, count, &expected.emplace_back(), other);
    Reductions(space).sum_on_device(term, count, sums.data() + expected.size() - 1);
  }
  CHECK(to_vector(sums) == expected);
}

TEST_CASE("sums by terms of different types in one launch are those of each alone") {
  using Terms = TypeList<Sign, LeftSum<3>, Powers>;
  const std::vector<int> counts = {5, 0, 1, 128, 129, 70000, 33};
  std::vector<Array<const double*>> numbers;
  std::vector<std::vector<double>> lists;
  for (int count : counts) {
    lists.emplace_back();
    for (int i = 0; i < count; ++i) lists.back().push_back(std::sin(2.0 + 1.0 * i * count));
    numbers.push_back(to_device("numbers", lists.back()));
  }
  ReductionSpace space;
  space.left = Array<double*>("left", 4000);
  JoinedSums joined;
  // Two launches before anything is fetched; the second needs more room for its terms.
  std::vector<std::size_t> of_powers, of_signs;
  std::size_t used = 0;
  const auto add = [&](int type, const auto& term, int count, std::vector<std::size_t>& places) {
    places.push_back(used);
    joined.add(type, term, count, used);
    used += static_cast<std::size_t>(teams_of(count)) * std::decay_t<decltype(term)>::values;
  };
  for (std::size_t c = 0; c < counts.size(); ++c) {
    add(type_number<Powers>(Terms{}), Powers{numbers[c]}, counts[c], of_powers);
    if (c == 2) joined.launch<Terms>(space, ExecutionSpace());
    add(type_number<Sign>(Terms{}), Sign{numbers[c]}, counts[c], of_signs);
  }
  joined.launch<Terms>(space, ExecutionSpace());
  joined.launch<Terms>(space, ExecutionSpace());  // nothing
  REQUIRE(used <= space.left.extent(0));
  const auto left = to_host(space.left);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    double sum[3] = {}, expected[3] = {};
    for (double number : lists[c]) {
      expected[0] += number;
      expected[1] += number * number;
      expected[2] += number < 0 ? -1 : 1;
    }
    for (int p = 0; p < teams_of(counts[c]); ++p) {
      for (int k = 0; k < 2; ++k) sum[k] += left(of_powers[c] + 2 * p + k);
      sum[2] += left(of_signs[c] + p);
    }
    for (int k = 0; k < 2; ++k) CHECK(std::fabs(sum[k] - expected[k]) <= 1e-14 * (1 + counts[c]));
    CHECK(sum[2] == expected[2]);
  }
}

TEST_CASE("of equal values the lowest item is reported, and what is no number is the largest") {
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
