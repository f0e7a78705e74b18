#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "tests/modes/mode_models.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;
using Catch::Matchers::WithinRel;

namespace {

/// A free annulus of steel about y: radii 0.46 and 0.09 m, 0.1 m thick; 6 elements through it, 30 along the radius.
scene::Scene annulus() {
  scene::Scene scene = mode_block({1, 1, 1}, {1, 1, 1}, 0.1);
  scene::MeshSource& mesh = scene.meshes[0];
  mesh.type = scene::MeshType::roller;
  scene::RollerMesh& roller = mesh.roller;
  roller.ring = true;
  roller.bore_radius = 0.09;
  roller.side_start = -0.05;
  roller.side_end = 0.05;
  roller.zone_size = 0.1 / 6;
  roller.zone_width = 0.1;
  roller.layer_height = 0.37 / 30;
  roller.zone_layers = 30;
  roller.coarse_size = 0.05;
  return scene;
}

ModeList modes_of(const scene::Scene& scene, double up_to, Model& model) {
  build_model(scene, model);
  return modes_below(model, up_to);
}

}  // namespace

TEST_CASE("Modes of a free annulus: frequencies against series values, nodal diameters and circles", "[modes]") {
  struct Expected {
    RoundName::Kind kind;
    int circles, diameters;
    double frequency;
  };
  using Kind = RoundName::Kind;
  const std::vector<Expected> expected{{Kind::axial, 0, 2, 570.96},   {Kind::axial, 1, 0, 938.76},
                                       {Kind::axial, 0, 3, 1316.09},  {Kind::axial, 1, 1, 1942.47},
                                       {Kind::radial, 0, 2, 2107.21}, {Kind::axial, 0, 4, 2185.69}};
  Model model;
  const ModeList list = modes_of(annulus(), 2300, model);
  std::vector<Mode> elastic;
  for (const Mode& mode : list.modes)
    if (!mode.rigid) elastic.push_back(mode);
  CHECK(list.modes.size() - elastic.size() == 6);
  std::size_t next = 0;
  double worst = 0;
  for (const Expected& e : expected)
    for (int copy = 0; copy < (e.diameters > 0 ? 2 : 1); ++copy, ++next) {
      REQUIRE(next < elastic.size());
      const Mode& mode = elastic[next];
      INFO("mode " << next + 1 << " at " << mode.frequency << " Hz");
      CHECK_THAT(mode.frequency, WithinRel(e.frequency, 0.01));
      REQUIRE(mode.round.has_value());
      CHECK(mode.round->kind == e.kind);
      CHECK(mode.round->circles == e.circles);
      CHECK(mode.round->diameters == e.diameters);
      CHECK(mode.round->order_share > 0.99);
      if (const double off = mode.frequency / e.frequency - 1; std::fabs(off) > std::fabs(worst)) worst = off;
    }
  CHECK(next == elastic.size());
  WARN("free annulus, " << model.element_count() << " elements: the worst frequency is off by " << 100 * worst << " %");
}

TEST_CASE("A mesh that is no body of revolution has modes without names", "[modes]") {
  Model model;
  const ModeList list = modes_of(mode_block({0.1, 0.1, 0.1}, {6, 6, 6}, 0.1), 16000, model);
  CHECK(list.modes.size() == 8);
  for (const Mode& mode : list.modes) CHECK_FALSE(mode.round.has_value());
}

TEST_CASE("Bodies on soft springs: rigid motions are distinguished from slow ones", "[modes]") {
  scene::Scene scene = mode_block({0.1, 0.1, 0.1}, {4, 4, 4}, 0.1);
  add_spring(scene, "block", "ground", {0, 0, 1e3});
  Model model;
  const ModeList list = modes_of(scene, 10000, model);
  REQUIRE(list.modes.size() == 6);
  int rigid = 0;
  for (const Mode& mode : list.modes) rigid += mode.rigid;
  CHECK(rigid == 5);
  CHECK_THAT(list.modes.back().frequency, WithinRel(std::sqrt(1e3 / 7.8) / (2 * M_PI), 1e-4));
}
