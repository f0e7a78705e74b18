#include <catch2/catch_test_macros.hpp>
#include <numeric>

#include "model/lent_array.hpp"

using namespace railwave;

TEST_CASE("memory that was lent goes to the next who asks for as much, or for less that does not waste it") {
  const void* first = nullptr;
  {
    const LentMemory lent = lend_memory(1 << 20);
    first = lent.get();
    const LentMemory other = lend_memory(1 << 20);
    CHECK(other.get() != first);
  }
  const std::size_t kept = kept_memory();
  CHECK(kept >= 2u << 20);
  const LentMemory again = lend_memory(1 << 20), beside = lend_memory(1 << 19);
  CHECK((again.get() == first || beside.get() == first));
  CHECK(kept_memory() <= kept - (2u << 20));
  const std::size_t left = kept_memory();
  const LentMemory small = lend_memory(100), large = lend_memory(8u << 20);
  CHECK(kept_memory() <= left);
  CHECK(lend_memory(0).get() == nullptr);
}

TEST_CASE("no more memory is kept than a bound, however much was lent") {
  { const LentMemory large = lend_memory(most_kept_memory + 1); }
  CHECK(kept_memory() <= most_kept_memory);
  {
    std::vector<LentMemory> many;
    for (int k = 0; k < 10; ++k) many.push_back(lend_memory(most_kept_memory / 5));
  }
  CHECK(kept_memory() <= most_kept_memory);
}

TEST_CASE("a lent copy holds the values, in memory that held others before, too") {
  for (int size : {1000, 0, 700, 2000}) {
    std::vector<int> values(size);
    std::iota(values.begin(), values.end(), size);
    CHECK(to_vector(*lent_copy(values)) == values);
  }
}
