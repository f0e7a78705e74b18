#include <catch2/catch_test_macros.hpp>

#include "output/room.hpp"

using namespace railwave;

namespace {

constexpr std::size_t too_much = std::size_t{1} << 60;

}  // namespace

TEST_CASE("room is looked for, not taken") {
  for (int i = 0; i < 100000; ++i) REQUIRE(can_be_had(memory_margin));
  CHECK_FALSE(can_be_had(too_much));
}

TEST_CASE("where there is no room it is said how much was wanted, and what needs it is not begun") {
  expect_room();
  try {
    expect_room(too_much);
    FAIL("it was had");
  } catch (const NoRoom& error) {
    CHECK(error.wanted() == memory_margin + too_much);
  }
  CHECK_THROWS_AS(expect_room(too_much), std::bad_alloc);
}

TEST_CASE("for closing the reserve is given back, and taken again for what comes next") {
  expect_room();
  CHECK(leaves_room(1));
  CHECK_FALSE(leaves_room(too_much));
  CHECK(room_to_close());
  CHECK_FALSE(leaves_room(too_much));
  CHECK_FALSE(room_to_close(too_much));
  CHECK(leaves_room(too_much));  // nothing is held that this could harm
  CHECK(room_to_close());
  expect_room();
  CHECK_FALSE(leaves_room(too_much));
}
