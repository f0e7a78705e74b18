#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "complaint.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/mesh_memory.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::StartsWith;

namespace {

void check_refused(const scene::MeshSource& source, const std::string& why) {
  CHECK_THROWS_WITH(build_mesh(source), StartsWith("[meshes.body] (line 7): ") && ContainsSubstring(why));
}

}  // namespace

TEST_CASE("a mesh of 10^12 elements is refused before memory is asked for, whatever makes it") {
  auto box = named(scene::MeshType::box);
  box.box.divisions = {10000, 10000, 10000};
  check_refused(box, "can be numbered");
  box.box.divisions = {100000, 100000, 1};
  check_refused(box, "can be numbered");

  auto cylinder = named(scene::MeshType::cylinder);
  cylinder.cylinder.core_divisions = cylinder.cylinder.ring_divisions = 1000;
  cylinder.cylinder.length_divisions = 100000;
  check_refused(cylinder, "can be numbered");

  auto block = named(scene::MeshType::crowned_block);
  block.crowned_block.zone_size = block.crowned_block.coarse_size = 4e-6;
  check_refused(block, "can be numbered");
}

TEST_CASE("a line of cells without number is refused before it is laid") {
  auto rail = named(scene::MeshType::rail);
  rail.rail.end = 1e12;
  check_refused(rail, "elements along one line");
  rail.rail.end = rail.rail.zone_end = 1e9;
  check_refused(rail, "elements along one line");

  auto wheel = named(scene::MeshType::wheel);
  wheel.wheel.radius = 1e9;
  check_refused(wheel, "elements along one line");

  auto block = named(scene::MeshType::crowned_block);
  block.crowned_block.zone_size = 1e-12;
  check_refused(block, "elements along one line");

  auto roller = named(scene::MeshType::roller);
  roller.roller.zone_size = 1e-12;
  check_refused(roller, "elements along one line");

  auto wheelset = named(scene::MeshType::wheelset);
  wheelset.wheelset.axle.back()[0] = 1e9;
  check_refused(wheelset, "elements along one line");

  auto pad = named(scene::MeshType::rail_pad);
  pad.rail_pad.size = 1e-12;
  check_refused(pad, "elements along one line");
}

TEST_CASE("a mesh larger than the memory is refused with both figures") {
  CHECK_NOTHROW(expect_mesh_memory(1e5, 1e5));
  // Few nodes for as many elements as no machine holds.
  CHECK_THROWS_WITH(
      expect_mesh_memory(1e15, 2e9),
      ContainsSubstring("makes 1e+15 elements, which need about 250 PB of memory, but this machine has "));
}
