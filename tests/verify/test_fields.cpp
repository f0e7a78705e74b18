// Fields fetched from the model: those of the nodes and elements asked for, in the order asked for, of all element
// groups.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double bend = 1e-2;  // 1/m: strain over the distance from the plane x = 0

/// Two blocks stretched along x, more so the farther out, the upper one of a material that yields.
void build_stretched_blocks(scene::Precision precision, Model& model) {
  scene::Scene scene = blocks_of_two_materials(precision);
  set_hourglass(scene.parts[1], scene::HourglassType::stiffness, 0.05);
  build_model(scene, model);
  set_position(model, [](const Vec3& x, int) { return Vec3{x[0] + 0.5 * bend * x[0] * x[0], x[1], x[2]}; });
}

double middle(const Model& model, int element) {
  double sum = 0;
  for (const int node : model.assembly.elements[element]) sum += model.assembly.nodes[node][0] / 8;
  return sum;
}

}  // namespace

TEST_CASE("stress and plastic strain come for the elements asked for, of every group") {
  for (const auto precision : {scene::Precision::double_precision, scene::Precision::mixed}) {
    Model model;
    build_stretched_blocks(precision, model);
    REQUIRE(model.elements.size() > 1);
    const int upper = 8 * 8 * 2, count = static_cast<int>(model.element_count());
    const std::vector<int> asked{count - 1, 3, upper, upper - 1, 3, 0, 777};
    const HostField stress = element_stress(model, model.nodes, asked);
    REQUIRE(stress.components == 6);
    REQUIRE(stress.values.size() == 6 * asked.size());
    const double modulus = 210e9 * 0.7 / (1.3 * 0.4);  // uniaxial strain
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const double strain = bend * middle(model, asked[i]);
      CHECK_THAT(stress.values[6 * i], WithinAbs(modulus * strain, 2e-3 * modulus * bend * 0.04));
      CHECK_THAT(stress.values[6 * i + 1], WithinAbs(modulus * strain * 3 / 7, 2e-3 * modulus * bend * 0.04));
    }
    const auto of_all = element_stress(model, model.nodes, all_elements(model)).values;
    for (std::size_t i = 0; i < asked.size(); ++i)
      for (int c = 0; c < 6; ++c) CHECK(stress.values[6 * i + c] == of_all[6 * asked[i] + c]);

    for (const ElementGroup& group : model.elements)
      if (group.material.flows()) Kokkos::deep_copy(group.material.history, 0.25);
    const HostField plastic = element_plastic_strain(model, asked);
    REQUIRE(plastic.components == 1);
    CHECK(plastic.values == std::vector<double>{0, 0.25, 0, 0.25, 0.25, 0.25, 0});
    CHECK(element_stress(model, model.nodes, {}).values.empty());
    CHECK(element_plastic_strain(model, {}).values.empty());
  }
}

TEST_CASE("displacement and position come for the nodes asked for") {
  Model model;
  build_stretched_blocks(scene::Precision::double_precision, model);
  const std::vector<int> asked{17, 400, 0, 17};
  const HostField moved = node_field(model, model.ties, NodeField::displacement, asked),
                  place = node_field(model, model.ties, NodeField::position, asked);
  REQUIRE(moved.components == 3);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Vec3 x = model.assembly.nodes[asked[i]];
    CHECK_THAT(moved.values[3 * i], WithinAbs(0.5 * bend * x[0] * x[0], 1e-16));
    CHECK(moved.values[3 * i + 1] == 0);
    CHECK_THAT(place.values[3 * i + 2], WithinAbs(x[2], 1e-16));
  }
  CHECK(node_field(model, model.ties, NodeField::displacement, {}).values.empty());
}
