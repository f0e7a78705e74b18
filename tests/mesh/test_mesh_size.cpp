#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <limits>
#include <string>

#include "case/error.hpp"
#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/mesh_memory.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

/// What is expected over what is made.
double share(const scene::MeshSource& source) {
  return expected_elements(source) / static_cast<double>(build_mesh(source).elements.size());
}

void check_within(const scene::MeshSource& source, double factor) {
  const double found = share(source);
  INFO("expected over made: " << found);
  CHECK(found < factor);
  CHECK(found > 1 / factor);
}

/// Coarse, so that the test is quick.
template <class Mesh>
void coarsen(Mesh& mesh) {
  mesh.zone_size = 0.006;
  mesh.zone_width = 0.02;
  mesh.zone_layers = 1;
  mesh.section_size = 0.012;
  mesh.core_size = 0.09;
}

}  // namespace

TEST_CASE("the size of a mesh is estimated before it is made") {
  auto box = named(scene::MeshType::box);
  box.box.divisions = {7, 5, 3};
  CHECK(share(box) == 1);
  CHECK(share(named(scene::MeshType::cylinder)) == 1);
  CHECK(share(named(scene::MeshType::crowned_block)) == 1);
  auto roller = named(scene::MeshType::roller);
  CHECK(share(roller) == 1);
  roller.roller.ring = true;
  roller.roller.zone_size = 0.005;
  CHECK(share(roller) == 1);
}

/// Each template of a transition counts as the four elements that it can have: a quarter too many at most.
TEST_CASE("the sizes of extruded meshes are estimated within a quarter, before their sections are smoothed") {
  auto wheel = named(scene::MeshType::wheel);
  coarsen(wheel.wheel);
  check_within(wheel, 1.25);
  wheel.wheel.path_start = -0.5;
  wheel.wheel.path_size = 0.008;
  check_within(wheel, 1.25);
  auto rail = named(scene::MeshType::rail);
  check_within(rail, 1.25);
  coarsen(rail.rail);
  check_within(rail, 1.25);
  rail.rail.end = 20;
  check_within(rail, 1.25);
}

TEST_CASE("the sizes of what lies on others is estimated within a factor") {
  auto wheelset = named(scene::MeshType::wheelset);
  coarsen(wheelset.wheelset);
  check_within(wheelset, 1.5);
  wheelset.wheelset.half = true;
  check_within(wheelset, 1.5);
  auto plate = named(scene::MeshType::fishplate);
  check_within(plate, 3);
  auto pad = named(scene::MeshType::rail_pad);
  check_within(pad, 3);
  pad.rail_pad.size = 0.004;
  check_within(pad, 3);
}

TEST_CASE("the fine elements of a mesh are those of its zone and its path, where it has them") {
  auto wheel = named(scene::MeshType::wheel), wheelset = named(scene::MeshType::wheelset);
  auto rail = named(scene::MeshType::rail);
  CHECK(fine_element_size(wheel) == 0.002);
  CHECK(fine_element_size(wheelset) == 0.002);
  CHECK(fine_element_size(rail) == 0.002);
  wheel.wheel.path_start = -0.5;
  wheelset.wheelset.path_start = -0.5;
  rail.rail.path_start = -0.2;
  CHECK(fine_element_size(wheel) == 0.003);
  CHECK(fine_element_size(wheelset) == 0.003);
  CHECK(fine_element_size(rail) == 0.003);
  CHECK(fine_element_size(named(scene::MeshType::crowned_block)) == 0.001);
  CHECK(fine_element_size(named(scene::MeshType::roller)) == 0.001);
  for (const auto type : {scene::MeshType::box, scene::MeshType::file, scene::MeshType::cylinder,
                          scene::MeshType::fishplate, scene::MeshType::rail_pad})
    CHECK(fine_element_size(named(type)) == 0);
}

TEST_CASE("parts that can't fit are refused before any of them is meshed, and the largest is named") {
  scene::Scene scene;
  scene.path = "case.toml";
  auto rail = named(scene::MeshType::rail);
  rail.rail.end = 800;
  scene.meshes.push_back(rail);
  scene::Part part;
  part.name = "long_rail";
  part.line = 12;
  part.mesh = "body";
  scene.parts.push_back(part);
  CHECK_THROWS_WITH(expect_memory_for_parts(scene, 1e6),
                    ContainsSubstring("[parts.long_rail] (line 12) by mesh 'body'") &&
                        ContainsSubstring("this machine has 1 MB left"));
  CHECK_NOTHROW(expect_memory_for_parts(scene, 1e15));
}

TEST_CASE("a body of millimetres for metres is refused at once") {
  auto rail = named(scene::MeshType::rail);
  rail.rail.end = 1e9;
  CHECK_THROWS_AS(expected_elements(rail), InputError);
  auto roller = named(scene::MeshType::roller);
  roller.roller.zone_size = 1e-12;
  CHECK_THROWS_AS(expected_elements(roller), InputError);
}
