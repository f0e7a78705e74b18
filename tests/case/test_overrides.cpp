#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/document.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("an override of one entry leaves the others of its list", "[case]") {
  const TemporaryCase file(small_case + "[gravity]\nacceleration = [1, 2, 3]\n");
  const auto scene = read_case(file.path(), {"gravity.acceleration[2]=-9.81", "gravity.acceleration[0]=0"});
  CHECK(scene.gravity == scene::Vec3{0, 2, -9.81});
  CHECK(read_case(file.path(), {"gravity.acceleration=[4, 5, 6]", "gravity.acceleration[1]=7"}).gravity ==
        scene::Vec3{4, 7, 6});
}

TEST_CASE("an override of an entry that the file does not have says so", "[case]") {
  const TemporaryCase file(small_case + "[gravity]\nacceleration = [1, 2, 3]\n");
  const auto mistakes = [&](const std::string& text) { return mistakes_of(file.path(), {text}); };
  CHECK_THAT(mistakes("gravity.acceleration[3]=0"), ContainsSubstring("has 3 entries, which count from 0"));
  CHECK_THAT(mistakes("parts.cube.position[1]=0"), ContainsSubstring("write position=[...] with all of them"));
  CHECK_THAT(mistakes("time.end[0]=1"), ContainsSubstring("end is no list in the file"));
  CHECK_THAT(mistakes("gravity.acceleration[x]=0"), ContainsSubstring("unknown key"));
  CHECK_THAT(mistakes("gravity.acceleration[0]=high"), ContainsSubstring("command line"));
}

TEST_CASE("the velocity of what rolls belongs to the static state, other initial velocities do not", "[case]") {
  const auto text = [](const char* rolling, const char* velocity) {
    const TemporaryCase file(small_case + "[initial_motion.roll]\nparts = [\"cube\"]\nvelocity = " + velocity +
                             "\nrolling = " + rolling + "\n" +
                             (std::string(rolling) == "true" ? "around = \"cube.z_max\"\n" : ""));
    return read_case(file.path()).static_text;
  };
  CHECK(text("false", "[1, 0, 0]") == text("false", "[2, 0, 0]"));
  CHECK(text("true", "[1, 0, 0]") != text("true", "[2, 0, 0]"));
  CHECK(text("true", "[1, 0, 0]") == text("true", "[1, 0, 0]"));
}

TEST_CASE("a value is written as TOML reads it again", "[case]") {
  for (const char* written : {"0.1", "1", "-2.5e-07", "true", "\"a \\\"b\\\\ c\"", "[1, 2.5, \"x\"]"}) {
    INFO(written);
    case_file::Complaints complaints("test");
    case_file::Node value, again;
    REQUIRE(case_file::parse_override_value(written, "test", {0, 1}, value, complaints));
    CHECK(case_file::toml_text(value) == written);
    REQUIRE(case_file::parse_override_value(case_file::toml_text(value), "test", {0, 1}, again, complaints));
    CHECK(case_file::toml_text(again) == written);
  }
}
