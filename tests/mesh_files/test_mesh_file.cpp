#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "mesh/build_mesh.hpp"
#include "tests/mesh_files/mesh_checks.hpp"

using namespace railwave;
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::StartsWith;

namespace {

scene::MeshSource file(const std::string& path) {
  scene::MeshSource source = source_of_file(path);
  source.name = "rail";
  source.line = 12;
  return source;
}

}  // namespace

TEST_CASE("a mesh in mm becomes metres") {
  auto source = file(test_data + "cantilever.inp");
  source.file.scale = 0.001;
  const Mesh mesh = build_mesh(source);
  CHECK(enclosed_volume(mesh, mesh.surfaces.at("exterior")) == Approx(1e-5));
  for (int node : mesh.node_sets.at("last")) CHECK(mesh.nodes[node][2] == Approx(0.1));
}

TEST_CASE("the ending chooses the format, in either case") {
  const TemporaryFolder folder;
  CHECK(build_mesh(file(folder.write("A.MSH", text_of(test_data + "small_ascii.msh")))).elements.size() == 2);
  CHECK(build_mesh(file(test_data + "block_binary.msh")).elements.size() == 640);
}

TEST_CASE("what is wrong in the case file's own entry names that entry") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(
      build_mesh(file(folder.write("a.vtk", "x"))),
      StartsWith("[meshes.rail] (line 12): ") && ContainsSubstring("ends in '.vtk'; mesh files are .inp"));
  CHECK_THROWS_WITH(build_mesh(file("/nowhere/a.inp")),
                    StartsWith("[meshes.rail] (line 12): ") && ContainsSubstring("there is no file /nowhere/a.inp"));
  auto source = file(test_data + "cantilever.inp");
  source.file.scale = -1;
  CHECK_THROWS_WITH(build_mesh(source), ContainsSubstring("scale is -1; give a number above 0"));
}

TEST_CASE("a folder or an empty file is no mesh") {
  const TemporaryFolder folder;
  folder.write("folder.inp/x", "");
  const auto path = folder.write("empty.inp", "");
  CHECK_THROWS_WITH(build_mesh(file(path)), ContainsSubstring("there are no 8-node hexahedra"));
  CHECK_THROWS_WITH(build_mesh(file(folder.write("empty.msh", ""))), ContainsSubstring("$MeshFormat is expected"));
  CHECK_THROWS_WITH(build_mesh(file(path.substr(0, path.rfind('/')) + "/folder.inp")), ContainsSubstring("not a file"));
}
