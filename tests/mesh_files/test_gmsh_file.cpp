#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>

#include "mesh/files/mesh_file.hpp"
#include "tests/mesh_files/mesh_checks.hpp"

using namespace railwave;
using Catch::Approx;

namespace {

void check_area(const Mesh& mesh, const std::string& surface, const Vec3& expected) {
  CAPTURE(surface);
  const Vec3 area = area_vector(mesh, mesh.surfaces.at(surface));
  for (int i = 0; i < 3; ++i) CHECK(area[i] == Approx(expected[i]).margin(1e-12));
}

// One unit cube, with $Entities and $Elements given by the test.
std::string cube(const std::string& names, const std::string& entities, const std::string& elements) {
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  if (!names.empty()) text += "$PhysicalNames\n" + names + "\n$EndPhysicalNames\n";
  text += "$Entities\n" + entities + "\n$EndEntities\n";
  text +=
      "$Nodes\n1 8 10 80\n3 1 0 8\n10\n20\n30\n40\n50\n60\n70\n80\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n$EndNodes\n";
  return text + "$Elements\n" + elements + "\n$EndElements\n";
}

}  // namespace

TEST_CASE("a bar meshed by Gmsh is read from ASCII and binary alike, with its physical groups") {
  const std::string name = GENERATE_COPY("block_ascii.msh", "block_binary.msh", "small_ascii.msh", "small_binary.msh");
  CAPTURE(name);
  const bool small = name[0] == 's';
  const Mesh mesh = read_gmsh_file(test_data + name);
  CHECK(mesh.elements.size() == (small ? 2 : 640));
  CHECK(mesh.nodes.size() == (small ? 12 : 1025));
  CHECK(mesh.element_sets.at("bar").size() == mesh.elements.size());

  check_area(mesh, "start", {-4e-4, 0, 0});
  check_area(mesh, "end", {4e-4, 0, 0});
  check_area(mesh, "foot", {0, 0, -2e-3});
  check_area(mesh, "head", {0, 0, 2e-3});
  check_area(mesh, "sides", {0, 0, 0});
  check_area(mesh, "exterior", {0, 0, 0});
  CHECK(mesh.surfaces.at("sides").size() == (small ? 4 : 320));
  CHECK(enclosed_volume(mesh, mesh.surfaces.at("exterior")) == Approx(4e-5));

  for (int node : mesh.node_sets.at("end")) CHECK(mesh.nodes[node][0] == Approx(0.1));
  CHECK(mesh.node_sets.at("end").size() == (small ? 4 : 25));
  CHECK(mesh.node_sets.at("lower edge").size() == (small ? 2 : 5));
  REQUIRE(mesh.node_sets.at("origin").size() == 1);
  CHECK(mesh.nodes[mesh.node_sets.at("origin")[0]] == Vec3{0, 0, 0});
  CHECK(mesh.node_sets.at("bar").size() == mesh.nodes.size());
}

TEST_CASE("ASCII and binary give the same mesh") {
  const Mesh ascii = read_gmsh_file(test_data + "block_ascii.msh"),
             binary = read_gmsh_file(test_data + "block_binary.msh");
  CHECK(ascii.elements == binary.elements);
  CHECK(ascii.node_sets == binary.node_sets);
  // Gmsh prints 16 digits, one fewer than a double needs.
  for (std::size_t node = 0; node < ascii.nodes.size(); ++node)
    for (int i = 0; i < 3; ++i)
      CHECK(ascii.nodes[node][i] == Approx(binary.nodes[node][i]).epsilon(1e-15).margin(1e-18));
}

TEST_CASE("groups without a name are called after their tag; a quadrangle is turned outward") {
  const TemporaryFolder folder;
  // The quadrangle is x = 1 with its normal pointing inwards.
  const auto path =
      folder.write("cube.msh", cube("", "0 0 1 1\n4 0 0 0 1 1 1 1 -7 0\n1 0 0 0 1 1 1 2 8 9 0",
                                    "2 2 5 9\n2 4 3 1\n9 20 60 70 30\n3 1 5 1\n5 10 20 30 40 50 60 70 80"));
  const Mesh mesh = read_gmsh_file(path);
  REQUIRE(mesh.surfaces.count("physical_7") == 1);
  const Vec3 area = area_vector(mesh, mesh.surfaces.at("physical_7"));
  CHECK(area == Vec3{1, 0, 0});
  CHECK(mesh.node_sets.at("physical_7") == std::vector<int>{1, 2, 5, 6});
  CHECK(mesh.element_sets.at("physical_8") == std::vector<int>{0});
  CHECK(mesh.element_sets.at("physical_9") == std::vector<int>{0});
}

TEST_CASE("a surface between two volumes belongs to the element that it points out of") {
  const TemporaryFolder folder;
  const bool turned = GENERATE(false, true);
  std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"joint\"\n$EndPhysicalNames\n"
      "$Entities\n0 0 1 1\n1 1 0 0 1 1 1 1 1 0\n1 0 0 0 2 1 1 0 0\n$EndEntities\n"
      "$Nodes\n1 12 1 12\n3 1 0 12\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n2 0 0\n2 1 0\n2 0 1\n2 1 1\n$EndNodes\n"
      "$Elements\n2 3 1 3\n2 1 3 1\n";
  text += turned ? "1 6 7 3 2\n" : "1 2 3 7 6\n";
  text += "3 1 5 2\n2 1 2 3 4 5 6 7 8\n3 2 9 10 3 6 11 12 7\n$EndElements\n";
  const Mesh mesh = read_gmsh_file(folder.write("two.msh", text));
  const auto& joint = mesh.surfaces.at("joint");
  REQUIRE(joint.size() == 1);
  CHECK(joint[0].element == (turned ? 1 : 0));
  CHECK(area_vector(mesh, joint) == (turned ? Vec3{-1, 0, 0} : Vec3{1, 0, 0}));
  CHECK(mesh.surfaces.at("exterior").size() == 10);
}

TEST_CASE(
    "a Gmsh file without physical groups gives the mesh, its exterior and a note; other sections are passed over") {
  const TemporaryFolder folder;
  auto text = cube("", "0 0 1 1\n4 0 0 0 1 1 1 0 0\n1 0 0 0 1 1 1 0 0",
                   "2 2 1 2\n2 4 2 1\n1 10 20 30\n3 1 5 1\n2 10 20 30 40 50 60 70 80");
  text += "$NodeData\nanything\n$EndNodeData\n";
  text.insert(text.find("$Entities"), "$Comments\nsays something $EndNodes\n$EndComments\n");
  std::vector<std::string> notes;
  const Mesh mesh = read_gmsh_file(folder.write("cube.msh", text), &notes);
  CHECK(mesh.surfaces.size() == 1);
  CHECK(mesh.surfaces.at("exterior").size() == 6);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("no physical groups") != std::string::npos);
}
