#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include "mesh/generators/rail.hpp"
#include "mesh/generators/wheel.hpp"
#include "mesh/mesh.hpp"
#include "mesh/quality.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::WithinRel;

namespace {

scene::MeshSource source_of(scene::MeshType type) {
  scene::MeshSource source;
  source.name = "made";
  source.type = type;
  source.wheel.zone_size = source.rail.zone_size = 0.004;
  return source;
}

void check_mirrored(const Mesh& mesh) {
  Mesh image = mesh;
  mirror(image);
  const MeshQuality before = mesh_quality(mesh, 1), after = mesh_quality(image, 1);
  CHECK(after.inverted == 0);
  CHECK_THAT(after.volume, WithinRel(before.volume, 1e-12));
  CHECK_THAT(after.jacobian_ratio.value, WithinRel(before.jacobian_ratio.value, 1e-9));
  CHECK_THAT(after.step.value, WithinRel(before.step.value, 1e-9));
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    CHECK((image.nodes[n][0] == mesh.nodes[n][0] && image.nodes[n][1] == -mesh.nodes[n][1] &&
           image.nodes[n][2] == mesh.nodes[n][2]));
  CHECK(image.node_sets == mesh.node_sets);
  for (const auto& [name, faces] : mesh.surfaces) {
    INFO(name);
    const Vec3 own = area_vector(mesh, faces), other = area_vector(image, image.surfaces.at(name));
    CHECK(std::fabs(other[0] - own[0]) < 1e-12);
    CHECK(std::fabs(other[1] + own[1]) < 1e-12);
    CHECK(std::fabs(other[2] - own[2]) < 1e-12);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      auto a = mesh.face_nodes(faces[f]), b = image.face_nodes(image.surfaces.at(name)[f]);
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      CHECK(a == b);
    }
  }
  Mesh twice = image;
  mirror(twice);
  CHECK(twice.nodes == mesh.nodes);
  CHECK(twice.elements == mesh.elements);
}

}  // namespace

TEST_CASE(
    "A mirrored wheel has the wheel's volume, Jacobians and steps; its faces look outwards, and mirrored twice it is "
    "itself") {
  check_mirrored(wheel_mesh(source_of(scene::MeshType::wheel)));
}

TEST_CASE("A mirrored rail leans the other way") { check_mirrored(rail_mesh(source_of(scene::MeshType::rail))); }
