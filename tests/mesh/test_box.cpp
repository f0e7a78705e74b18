#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <set>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "topology.hpp"

using namespace railwave;

namespace {

scene::MeshSource block() {
  scene::MeshSource source;
  source.name = "block";
  source.line = 7;
  source.box.origin = {1, -2, 0.5};
  source.box.size = {3, 2, 0.4};
  source.box.divisions = {3, 4, 2};
  return source;
}

}  // namespace

TEST_CASE("a box has the divisions, corners and six sides asked for") {
  const Mesh mesh = build_mesh(block());
  REQUIRE(mesh.nodes.size() == 4 * 5 * 3);
  REQUIRE(mesh.elements.size() == 3 * 4 * 2);
  CHECK(mesh.nodes.front() == Vec3{1, -2, 0.5});
  CHECK(mesh.nodes.back() == Vec3{4, 0, 0.9});
  REQUIRE(mesh.surfaces.size() == 6);
  REQUIRE(mesh.node_sets.size() == 6);

  const Vec3 low{1, -2, 0.5}, high{4, 0, 0.9}, size{3, 2, 0.4};
  for (int axis = 0; axis < 3; ++axis)
    for (int upper = 0; upper < 2; ++upper) {
      const std::string name = std::string(1, "xyz"[axis]) + (upper ? "_max" : "_min");
      CAPTURE(name);
      const double position = upper ? high[axis] : low[axis];
      const Vec3 total = area_vector(mesh, mesh.surfaces.at(name));
      std::set<int> surface_nodes;
      for (const Face& face : mesh.surfaces.at(name))
        for (int node : mesh.face_nodes(face)) surface_nodes.insert(node);
      for (int node : surface_nodes) CHECK(mesh.nodes[node][axis] == Catch::Approx(position));
      const auto& nodes = mesh.node_sets.at(name);
      CHECK(std::set<int>(nodes.begin(), nodes.end()) == surface_nodes);
      const double expected = size[0] * size[1] * size[2] / size[axis] * (upper ? 1 : -1);
      for (int i = 0; i < 3; ++i) CHECK(total[i] == Catch::Approx(i == axis ? expected : 0).margin(1e-12));
    }
}

TEST_CASE("a box that can't be made is refused by name and line") {
  using Catch::Matchers::ContainsSubstring;
  auto source = block();
  SECTION("no thickness") {
    source.box.size[2] = 0;
    CHECK_THROWS_WITH(build_mesh(source), ContainsSubstring("[meshes.block] (line 7): size along z is 0"));
  }
  SECTION("no divisions") {
    source.box.divisions[1] = 0;
    CHECK_THROWS_WITH(build_mesh(source), ContainsSubstring("divisions along y is 0"));
  }
  SECTION("more nodes than can be numbered") {
    source.box.divisions = {2000, 2000, 2000};
    CHECK_THROWS_AS(build_mesh(source), InputError);
  }
}
