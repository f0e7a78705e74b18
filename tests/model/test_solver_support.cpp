#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "tests/verify/block.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::MessageMatches;

namespace {

scene::Scene block() { return verify::block_scene({0.01, 0.01, 0.01}, {1, 1, 1}, 1e-4); }

void refused(const scene::Scene& scene, const std::string& wish, const std::string& mend) {
  Model model;
  CHECK_THROWS_MATCHES(build_model(scene, model), InputError,
                       MessageMatches(ContainsSubstring(wish) && ContainsSubstring(mend)));
}

}  // namespace

TEST_CASE("a precision that the loop does not have is refused") {
  scene::Scene scene = block();
  scene.solver.precision = scene::Precision::single_precision;
  refused(scene, "precision = \"float\"", "\"double\"");
}

TEST_CASE("subcycling with a step that rests on the whole scene is refused") {
  scene::Scene scene = block();
  scene.solver.subcycling = true;
  scene.solver.step_estimate = scene::StepEstimate::global;
  refused(scene, "subcycling = true", "global");
}
