#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <algorithm>
#include <memory>

#include "case/activity.hpp"
#include "case/keys.hpp"
#include "case/plausible.hpp"
#include "case/read_case.hpp"
#include "case/read_value.hpp"
#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using namespace railwave::case_file;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string wheel_case = R"(
[materials.steel]
youngs_modulus = 210e9
poissons_ratio = 0.3
density = 7800
[meshes.wheel]
type = "wheel"
[parts.wheel]
mesh = "wheel"
material = "steel"
[initial_motion.roll]
parts = ["wheel"]
velocity = [20, 0, 0]
[time]
end = 1e-3
)";

std::vector<std::string> warnings_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  TemporaryCase file(text);
  std::vector<std::string> warnings;
  read_case(file.path(), overrides, &warnings);
  return warnings;
}

/// The one warning of a sound case with one value changed.
std::string warning_of(const std::string& override_text) {
  const auto warnings = warnings_of(wheel_case, {override_text});
  CHECK(warnings.size() == 1);
  return warnings.empty() ? "" : warnings[0];
}

std::string refusal_of(const std::string& override_text) {
  TemporaryCase file(wheel_case);
  return mistakes_of(file.path(), {override_text});
}

}  // namespace

TEST_CASE("a sound case is not warned of", "[case]") { CHECK(warnings_of(wheel_case).empty()); }

TEST_CASE("a number in another unit is refused or warned of, with the number that was probably meant", "[case]") {
  CHECK_THAT(
      refusal_of("meshes.wheel.radius=460"),
      ContainsSubstring("radius: is 460, must be above 0 and at most 5 m; m are expected: 0.46, if it is in mm"));
  CHECK_THAT(warning_of("materials.steel.youngs_modulus=210"),
             ContainsSubstring("Pa are expected: 2.1e+11, if it is in GPa"));
  CHECK_THAT(warning_of("materials.steel.youngs_modulus=210e3"),
             ContainsSubstring("Pa are expected: 2.1e+11, if it is in MPa"));
  CHECK_THAT(warning_of("materials.steel.density=7.8"),
             ContainsSubstring("kg/m3 are expected: 7800, if it is in t/m3"));
  CHECK_THAT(warning_of("time.end=50"), ContainsSubstring("s are expected: 0.05, if it is in ms"));
  CHECK_THAT(warning_of("initial_motion.roll.velocity=[100, 0, 0]"),
             ContainsSubstring("m/s are expected: 27.78, if it is in km/h"));
  CHECK_THAT(warning_of("materials.steel.poissons_ratio=0.499"),
             ContainsSubstring("poissons_ratio: is 0.499, which is unusual"));
  // A ratio of critical damping, say, with which a step is some picoseconds long.
  CHECK_THAT(warning_of("parts.wheel.stiffness_damping=0.03"),
             ContainsSubstring("stiffness_damping: is 0.03 s, which is unusual: mostly it is between 0 and 0.01 s"));
}

TEST_CASE("a long rail and elements of a metre or a nanometre are warned of", "[case]") {
  const std::string head =
      "[materials.steel]\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\ndensity = 7800\n[parts.body]\nmesh = "
      "\"body\"\nmaterial = \"steel\"\n"
      "[time]\nend = 1e-3\n[meshes.body]\n";
  const auto rail = warnings_of(head + "type = \"rail\"\nend = 800\n");
  REQUIRE(rail.size() == 1);
  CHECK_THAT(rail[0], ContainsSubstring("the rail is 800.3 m long, which is unusual") &&
                          ContainsSubstring("0.8003, if it is in mm"));
  const auto coarse = warnings_of(head + "type = \"box\"\nsize = [4, 0.1, 0.1]\ndivisions = [4, 1, 1]\n");
  REQUIRE(coarse.size() == 1);
  CHECK_THAT(coarse[0], ContainsSubstring("elements 1 m along x"));
  const auto fine = warnings_of(head + "type = \"box\"\nsize = [1e-5, 1e-5, 1e-6]\ndivisions = [1, 1, 1000]\n");
  REQUIRE(fine.size() == 1);
  CHECK_THAT(fine[0], ContainsSubstring("elements 1e-09 m along z"));
}

TEST_CASE("every number that a key takes is refused beyond its own limits or those of its unit", "[case]") {
  for (const auto& section : sections())
    for (const auto& key : section.keys) {
      if (key.kind != Kind::number && key.kind != Kind::vector && key.kind != Kind::box && key.kind != Kind::numbers)
        continue;
      INFO("[" << section.name << "] " << key.name);
      const Range allowed = allowed_range(key);
      const bool factor = key.unit.empty();
      CHECK((factor || key.any_size || (allowed.high < 1e19 && allowed.low > -1e19)));
      CHECK_FALSE((key.range.low_open && key.range.low == 0 && !factor && !key.any_size && allowed.has(1e-300)));
      // What is usual is allowed, and so is a default.
      const Range usual = usual_range(key);
      CHECK((usual.low <= allowed.low || allowed.has(usual.low)));
      CHECK((usual.high >= allowed.high || allowed.has(usual.high)));
    }
}

TEST_CASE("the default of every number is usual", "[case]") {
  for (const auto& section : sections())
    for (const auto& key : section.keys) {
      if (key.required || key.kind != Kind::number || !key.default_text.empty()) continue;
      INFO("[" << section.name << "] " << key.name);
      const Value initial = key.initial();
      if (const double* number = std::get_if<double>(&initial)) CHECK(is_usual(key, *number));
    }
}

TEST_CASE("activities may be nested deeper and named longer than is shown", "[case]") {
  const Activity outer("outer");
  std::vector<std::unique_ptr<Activity>> nested;
  for (int i = 0; i < 50; ++i) nested.push_back(std::make_unique<Activity>(std::string(10000, 'x')));
  while (!nested.empty()) nested.pop_back();
  SUCCEED();
}
