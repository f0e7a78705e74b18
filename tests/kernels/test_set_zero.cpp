#include "kernels/support/set_zero.hpp"

#include <catch2/catch_test_macros.hpp>
#include <vector>

#include "kernels/support/team.hpp"

using namespace railwave;

namespace {

/// Pages of an array that are in memory.
std::size_t pages_in_memory(const double* data, std::size_t count) {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(data) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(data + count);
  std::vector<unsigned char> there((end - begin + page - 1) / page);
  REQUIRE(mincore(reinterpret_cast<void*>(begin), end - begin, there.data()) == 0);
  std::size_t pages = 0;
  for (unsigned char one : there) pages += one & 1;
  return pages;
}

bool is_zero(const double* data, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    if (data[k] != 0) return false;
  return true;
}

}  // namespace

TEST_CASE("Arrays of zeros take memory where they are touched alone", "[set_zero]") {
  if constexpr (!on_device) {
    constexpr std::size_t count = 1 << 20;
    const auto array = unset_array<double*>("array", count);
    Kokkos::deep_copy(array, 7.0);
    REQUIRE(pages_in_memory(array.data(), count) >= 2048);
    set_zero(array);
    CHECK(pages_in_memory(array.data(), count) <= 2);  // where it begins and ends
    array(count / 2) = 1;
    CHECK(pages_in_memory(array.data(), count) <= 3);
    CHECK(is_zero(array.data(), count / 2));
    CHECK(is_zero(array.data() + count / 2 + 1, count / 2 - 1));
  }
}

TEST_CASE("What lies beside zeros stays", "[set_zero]") {
  for (const std::size_t count : {std::size_t{100}, std::size_t{1} << 18}) {
    std::vector<double> values(count, 7.0);
    set_zero_on_host(values.data() + 3, sizeof(double) * (count - 8));
    CHECK(is_zero(values.data() + 3, count - 8));
    for (std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{2}, count - 5, count - 1})
      CHECK(values[k] == 7.0);
  }
}
