#include <catch2/catch_test_macros.hpp>

#include "case/suggest.hpp"

using namespace railwave;

TEST_CASE("edit distance counts inserted, dropped, changed and swapped letters", "[case]") {
  CHECK(edit_distance("steel", "steel") == 0);
  CHECK(edit_distance("stel", "steel") == 1);
  CHECK(edit_distance("steell", "steel") == 1);
  CHECK(edit_distance("steal", "steel") == 1);
  CHECK(edit_distance("setel", "steel") == 1);
  CHECK(edit_distance("Steel", "steel") == 0);
  CHECK(edit_distance("", "steel") == 5);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the nearest name is found, and none when nothing is near", "[case]") {
  const std::vector<std::string> keys{"youngs_modulus", "poissons_ratio", "density", "end"};
  CHECK(nearest_name("young_modulus", keys) == "youngs_modulus");
  CHECK(nearest_name("modulus", keys) == "youngs_modulus");
  CHECK(nearest_name("densty", keys) == "density");
  CHECK(nearest_name("DENSITY", keys) == "density");
  CHECK(nearest_name("ned", keys) == "end");
  CHECK(nearest_name("colour", keys).empty());
  CHECK(nearest_name("x", keys).empty());
  CHECK(nearest_name("", keys).empty());
  CHECK(nearest_name("density", {}).empty());
  CHECK(nearest_name(std::string(100000, 'd'), keys).empty());
}

TEST_CASE("of two near names the nearer is taken", "[case]") {
  CHECK(nearest_name("zone_ende", {"zone_start", "zone_end", "zone_centre"}) == "zone_end");
}

TEST_CASE("without a near name the known ones are listed", "[case]") {
  CHECK(suggestion("stel", {"steel", "rubber"}) == "did you mean 'steel'?");
  CHECK(suggestion("wood", {"steel", "rubber"}) == "known are: steel, rubber");
  CHECK(suggestion("wood", {}).empty());
}
