#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <numeric>
#include <random>
#include <set>

#include "model/time_step/estimate_share.hpp"
#include "model/time_step/global_step.hpp"
#include "tests/verify/tied_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// Numbers of a range in any order.
void shuffle_range(std::vector<int>& numbers, int first, int count, std::mt19937& generator) {
  std::shuffle(numbers.begin() + first, numbers.begin() + first + count, generator);
}

/// The same mesh with other numbers of nodes and elements in each part.
Assembly renumbered(const Assembly& assembly, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<int> node(assembly.nodes.size()), element(assembly.elements.size());
  std::iota(node.begin(), node.end(), 0);
  std::iota(element.begin(), element.end(), 0);
  for (const auto& part : assembly.parts) {
    shuffle_range(node, part.first_node, part.node_count, generator);
    shuffle_range(element, part.first_element, part.element_count, generator);
  }
  Assembly other = assembly;
  for (std::size_t n = 0; n < node.size(); ++n) other.nodes[node[n]] = assembly.nodes[n];
  for (std::size_t e = 0; e < element.size(); ++e) {
    other.elements[element[e]] = assembly.elements[e];
    for (int& n : other.elements[element[e]]) n = node[n];
  }
  for (auto& [name, set] : other.node_sets)
    for (int& n : set) n = node[n];
  for (auto& [name, set] : other.element_sets)
    for (int& e : set) e = element[e];
  for (auto& [name, surface] : other.surfaces)
    for (Face& face : surface) face.element = element[face.element];
  return other;
}

StableStep step_of(scene::Scene scene, const Assembly& assembly, scene::StepEstimate estimate) {
  scene.solver.step_estimate = estimate;
  Model model;
  build_model(scene, assembly, model);
  return model.stable_step;
}

/// The largest relative difference of the whole scene's step, and of the elements', between a mesh and others with
/// other numbers.
double difference_by_numbers(const scene::Scene& scene, const Assembly& assembly) {
  const StableStep step = step_of(scene, assembly, scene::StepEstimate::global);
  double largest = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const StableStep other = step_of(scene, renumbered(assembly, seed), scene::StepEstimate::global);
    largest = std::max(
        {largest, std::fabs(other.global / step.global - 1), std::fabs(other.by_elements / step.by_elements - 1)});
  }
  return largest;
}

}  // namespace

TEST_CASE("the whole scene's step does not depend on how the mesh is numbered") {
  // Of sums in another order alone, which Lanczos' method makes larger.
  constexpr double rounding = 1e-9;
  for (auto hourglass : {scene::HourglassType::viscous, scene::HourglassType::stiffness}) {
    scene::Scene scene = block_scene({0.08, 0.07, 0.06}, {8, 7, 6}, 1);
    set_hourglass(scene.parts[0], hourglass, 0.1);
    Assembly assembly = assemble(scene);
    INFO("hourglass control " << static_cast<int>(hourglass));
    CHECK(difference_by_numbers(scene, assembly) < rounding);
    warp(assembly, 0.01, 0.2, 3);
    CHECK(difference_by_numbers(scene, assembly) < rounding);
  }
  const scene::Scene pressed = TwoBlocks().scene(1), tied = TiedBlocks().scene(1);
  CHECK(difference_by_numbers(pressed, assemble(pressed)) < rounding);
  CHECK(difference_by_numbers(tied, assemble(tied)) < rounding);
}

TEST_CASE("a spring between point masses at one place is in the whole scene's step") {
  // They move against each other alone: a start by places without more would be without that.
  constexpr double mass = 2, stiffness = 8e4;
  scene::Scene scene;
  scene.path = "two balls";
  for (const char* name : {"one", "other"}) add_point(scene, name, mass, {0.1, 0.2, 0.3});
  add_spring(scene, "one", "other", {0, stiffness, 0}, {0, 0, 0});
  scene.time.end = 1;
  scene.solver.step_estimate = scene::StepEstimate::global;
  Model model;
  build_model(scene, model);
  CHECK_THAT(model.stable_step.global, WithinRel(2 / std::sqrt(2 * stiffness / mass), GlobalEstimate::tolerance));
}

TEST_CASE("elements around a range of nodes are all that have one of them, in order, and number their nodes anew") {
  const scene::Scene scene = TwoBlocks().scene(1);
  const Assembly whole = assemble(scene);
  const int nodes = static_cast<int>(whole.nodes.size()), of_first = whole.parts[0].node_count;
  // Inside a part, over both, of everything, of nothing.
  const int ranges[][2] = {{40, 90}, {of_first - 100, of_first + 300}, {0, nodes}, {17, 17}};
  for (const auto& [begin, end] : ranges) {
    INFO("nodes " << begin << " to " << end << " of " << nodes);
    const ElementsAround around = elements_around(whole, begin, end);
    std::vector<CornerNodes> elements;
    std::vector<int> counts;
    std::set<int> others;
    for (const auto& part : whole.parts) {
      const std::size_t before = elements.size();
      for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
        std::set<int> outside;
        for (int n : whole.elements[e])
          if (n < begin || n >= end) outside.insert(n);
        if (outside.size() == 8) continue;
        elements.push_back(whole.elements[e]);
        others.insert(outside.begin(), outside.end());
      }
      counts.push_back(static_cast<int>(elements.size() - before));
    }
    CHECK((around.others == std::vector<int>(others.begin(), others.end())));
    REQUIRE(around.parts.size() == counts.size());
    for (std::size_t p = 0; p < counts.size(); ++p) {
      CHECK(around.parts[p].element_count == counts[p]);
      CHECK(around.parts[p].first_element == (p == 0 ? 0 : counts[0]));
      CHECK(around.parts[p].first_node == whole.parts[p].first_node);
    }
    std::vector<CornerNodes> found = around.elements;
    for (CornerNodes& corners : found)
      for (int& n : corners) n = n < end - begin ? begin + n : around.others[n - (end - begin)];
    CHECK((found == elements));
  }
}
