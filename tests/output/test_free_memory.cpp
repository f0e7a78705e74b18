#include <catch2/catch_test_macros.hpp>

#include "output/free_memory.hpp"

using namespace railwave;

namespace {

constexpr std::size_t too_much = std::size_t{1} << 60;

}  // namespace

TEST_CASE("free memory is looked for, not taken") {
  for (int i = 0; i < 100000; ++i) REQUIRE(can_be_had(memory_margin));
  CHECK_FALSE(can_be_had(too_much));
}

TEST_CASE("where too little memory is free it is said how much was wanted, and what needs it is not begun") {
  expect_free_memory();
  try {
    expect_free_memory(too_much);
    FAIL("it was had");
  } catch (const TooLittleMemory& error) {
    CHECK(error.wanted() == memory_margin + too_much);
  }
  CHECK_THROWS_AS(expect_free_memory(too_much), std::bad_alloc);
}

TEST_CASE("for closing the reserve is given back, and taken again for what comes next") {
  expect_free_memory();
  CHECK(leaves_free_memory(1));
  CHECK_FALSE(leaves_free_memory(too_much));
  CHECK(enough_to_close());
  CHECK_FALSE(leaves_free_memory(too_much));
  CHECK_FALSE(enough_to_close(too_much));
  CHECK(leaves_free_memory(too_much));  // nothing is held that this could harm
  CHECK(enough_to_close());
  expect_free_memory();
  CHECK_FALSE(leaves_free_memory(too_much));
}
