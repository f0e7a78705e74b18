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

TEST_CASE("nodes in single precision are refused where some take longer steps than others") {
  scene::Scene scene = block();
  scene.solver.precision = scene::Precision::single_precision;
  scene.solver.subcycling = true;
  refused(scene, "precision = \"float\"", "\"mixed\"");
}

TEST_CASE("a scene without subcycling may have any precision, and the summary says which") {
  for (auto precision :
       {scene::Precision::double_precision, scene::Precision::mixed, scene::Precision::single_precision}) {
    scene::Scene scene = block();
    scene.solver.precision = precision;
    Model model;
    build_model(scene, model);
    int lines = 0;
    for (const std::string& line : model.left_out) lines += line.find("double precision") != std::string::npos ? 1 : 0;
    CHECK(lines == (precision == scene::Precision::double_precision ? 0 : 1));
    CHECK(model.relative.active() == (precision == scene::Precision::single_precision));
  }
}

TEST_CASE("subcycling with a step that rests on the whole scene is refused") {
  scene::Scene scene = block();
  scene.solver.subcycling = true;
  scene.solver.step_estimate = scene::StepEstimate::global;
  refused(scene, "subcycling = true", "global");
}
