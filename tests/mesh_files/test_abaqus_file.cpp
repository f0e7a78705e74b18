#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "case/error.hpp"
#include "mesh/files/mesh_file.hpp"
#include "tests/mesh_files/mesh_checks.hpp"

using namespace railwave;
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;

namespace {

// Two unit cubes side by side along x: element 10 at x 0 to 1, element 20 at 1 to 2.
const std::string nodes =
    "1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,2,0,0\n10,2,1,0\n11,2,0,1\n12,2,1,1\n";
const std::string elements = "10,1,2,3,4,5,6,7,8\n20,2,9,10,3,6,11,12,7\n";
const std::string two_cubes = "*NODE\n" + nodes + "*ELEMENT,TYPE=C3D8\n" + elements;

}  // namespace

TEST_CASE("a cantilever in CalculiX's form is read with its sets and surface") {
  std::vector<std::string> notes;
  const Mesh mesh = read_abaqus_file(test_data + "cantilever.inp", &notes);
  CHECK(mesh.nodes.size() == 1025);
  CHECK(mesh.elements.size() == 640);
  CHECK(enclosed_volume(mesh, mesh.surfaces.at("exterior")) == Approx(1e4));
  CHECK(mesh.node_sets.at("nall").size() == 1025);
  CHECK(mesh.element_sets.at("eall").size() == 640);
  REQUIRE(mesh.node_sets.at("fix").size() == 25);
  for (int node : mesh.node_sets.at("fix")) CHECK(mesh.nodes[node][2] == 0);
  REQUIRE(mesh.node_sets.at("last").size() == 25);
  for (int node : mesh.node_sets.at("last")) CHECK(mesh.nodes[node][2] == 100);
  const Vec3 area = area_vector(mesh, mesh.surfaces.at("slast"));
  CHECK(area[0] == Approx(0).margin(1e-9));
  CHECK(area[2] == Approx(100));
  CHECK(mesh.node_sets.at("slast") == mesh.node_sets.at("last"));
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], ContainsSubstring("*MATERIAL (2324)") && ContainsSubstring("*STEP"));
}

TEST_CASE("faces S1 to S6 are Abaqus's") {
  const TemporaryFolder folder;
  std::string text = two_cubes;
  for (char face = '1'; face <= '6'; ++face)
    text += std::string("*SURFACE, NAME=F") + face + ", TYPE=ELEMENT\n10, s" + face + "\n";
  const Mesh mesh = read_abaqus_file(folder.write("faces.inp", text));
  const Vec3 outward[6] = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  // Node numbers as Abaqus's manual lists them for each face.
  const int corners[6][4] = {{1, 2, 3, 4}, {5, 6, 7, 8}, {1, 2, 5, 6}, {2, 3, 6, 7}, {3, 4, 7, 8}, {1, 4, 5, 8}};
  for (int f = 0; f < 6; ++f) {
    const auto name = "f" + std::to_string(f + 1);
    CAPTURE(name);
    CHECK(area_vector(mesh, mesh.surfaces.at(name)) == outward[f]);
    const auto& set = mesh.node_sets.at(name);
    REQUIRE(set.size() == 4);
    for (int i = 0; i < 4; ++i) CHECK(set[i] == corners[f][i] - 1);
  }
}

TEST_CASE("sets may be ranges, name other sets, come before what they name, and go on later") {
  const TemporaryFolder folder;
  const Mesh mesh = read_abaqus_file(folder.write("sets.inp",
                                                  "*NSET, NSET=Both\nLeft, right\n12,\n"
                                                  "*Nset, nset=LEFT, generate\n1, 8, 3\n"
                                                  "*ELSET, ELSET=All, GENERATE\n1, 999999999\n"
                                                  "*ELSET, ELSET=one\n20\n" +
                                                      two_cubes +
                                                      "*NSET,\nNSET=Right\n 9, 10,\n11\n"
                                                      "*NSET, NSET=left\n2\n"
                                                      "*NSET, NSET=OfOne, ELSET=ONE\n"
                                                      "*SURFACE, NAME=skin\none\n"
                                                      "*SURFACE, NAME=tip, TYPE=NODE\nright, 0.5\n12\n"));
  CHECK(mesh.node_sets.at("left") == std::vector<int>{0, 1, 3, 6});
  CHECK(mesh.node_sets.at("right") == std::vector<int>{8, 9, 10});
  CHECK(mesh.node_sets.at("both") == std::vector<int>{0, 1, 3, 6, 8, 9, 10, 11});
  CHECK(mesh.node_sets.at("tip") == std::vector<int>{8, 9, 10, 11});
  CHECK(mesh.node_sets.at("ofone") == std::vector<int>{1, 2, 5, 6, 8, 9, 10, 11});
  CHECK(mesh.element_sets.at("all") == std::vector<int>{0, 1});
  CHECK(mesh.node_sets.at("one") == mesh.node_sets.at("ofone"));
  CHECK(mesh.surfaces.at("skin").size() == 5);
  CHECK(mesh.surfaces.at("exterior").size() == 10);
}

TEST_CASE("number formats, continuation lines, comments and line ends of many programs are understood") {
  const TemporaryFolder folder;
  const Mesh mesh = read_abaqus_file(folder.write(
      "forms.inp",
      "\xef\xbb\xbf** made by hand\r\n*Heading\r\n M\xfcller's cube, 1:1\r\n\r\n*node , NSET = \"My Nodes\"\r\n"
      "  1, 0., , -0\r\n2,+1.0D0,0,0.\r\n3, 1.E+00, 1d0, 0, 0.6, 0.8\r\n4,,1,0\r\n"
      "5,0,0,.1D+1\r\n** between\r\n6,1,0,1\r\n7,1,1,1\r\n8,0,10.e-1,1\r\n"
      "*Element, type=c3d8r,\r\n  elset=Block\r\n7, 1,2,3,\r\n4,5,\r\n6,7,8\r\n*End Step"));
  CHECK(mesh.nodes[1] == Vec3{1, 0, 0});
  CHECK(mesh.nodes[4] == Vec3{0, 0, 1});
  CHECK(mesh.node_sets.at("my nodes").size() == 8);
  CHECK(mesh.element_sets.at("block") == std::vector<int>{0});
  CHECK(enclosed_volume(mesh, mesh.surfaces.at("exterior")) == Approx(1));
}

TEST_CASE("included files count from the folder of the file that includes them") {
  const TemporaryFolder folder;
  folder.write("parts/nodes.inc", nodes);
  folder.write("parts/all.inc", "*NODE\n*INCLUDE, INPUT=nodes.inc\n*ELEMENT, TYPE=C3D8I, INPUT=../elements.txt\n");
  folder.write("elements.txt", elements);
  const Mesh mesh = read_abaqus_file(folder.write("main.inp", "*include, input=parts/all.inc\n*NSET, NSET=a\n1\n"));
  CHECK(mesh.elements.size() == 2);
  CHECK(mesh.node_sets.at("a") == std::vector<int>{0});
}

TEST_CASE("an error in an included file names that file, and a file can't include itself") {
  const TemporaryFolder folder;
  folder.write("nodes.inc", "1, 0, 0\n");
  CHECK_THROWS_WITH(read_abaqus_file(folder.write("main.inp", "*NODE\n*INCLUDE, INPUT=nodes.inc\n")),
                    ContainsSubstring("nodes.inc:1: node 1 has 2 of its three coordinates"));
  folder.write("a.inp", "*INCLUDE, INPUT=b.inp\n");
  CHECK_THROWS_WITH(read_abaqus_file(folder.write("b.inp", "**\n*INCLUDE, INPUT=a.inp\n")),
                    ContainsSubstring("a.inp:1: includes") && ContainsSubstring("can't include itself"));
  for (int i = 0; i < 20; ++i)
    folder.write("deep" + std::to_string(i) + ".inp", "*INCLUDE, INPUT=deep" + std::to_string(i + 1) + ".inp\n");
  CHECK_THROWS_WITH(read_abaqus_file(folder.write("start.inp", "*INCLUDE, INPUT=deep0.inp\n")),
                    ContainsSubstring("more than 16 files inside one another"));
}

TEST_CASE("a part with one instance is read where the instance puts it") {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  const Mesh mesh = read_abaqus_file(
      folder.write("cae.inp",
                   "*Part, name=Block\n" + two_cubes +
                       "*Nset, nset=Tip\n 9, 10, 11, 12\n*Elset, elset=_Top_S2, internal\n10, 20\n"
                       "*Surface, type=ELEMENT, name=Top\n_Top_S2, S2\n*End Part\n"
                       "*Assembly, name=Assembly\n*Instance, name=Block-1, part=Block\n 0., 5., 0.\n*End Instance\n"
                       "*Node\n 1, 7., 7., 7.\n*Nset, nset=Point\n 1,\n"
                       "*Nset, nset=Far, instance=Block-1\n 9, 10\n*Nset, nset=Far2\nBlock-1.Tip, Block-1.1\n"
                       "*End Assembly\n"),
      &notes);
  CHECK(mesh.nodes.size() == 12);
  CHECK(mesh.nodes[0] == Vec3{0, 5, 0});
  CHECK(mesh.node_sets.at("far") == std::vector<int>{8, 9});
  CHECK(mesh.node_sets.at("far2") == std::vector<int>{0, 8, 9, 10, 11});
  CHECK(mesh.node_sets.count("point") == 0);
  CHECK(mesh.element_sets.count("_top_s2") == 0);
  CHECK(area_vector(mesh, mesh.surfaces.at("top")) == Vec3{0, 0, 2});
  CHECK(notes.size() == 2);
}

TEST_CASE("nodes of no element are left out with a note, and positions stay right") {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  const Mesh mesh =
      read_abaqus_file(folder.write("loose.inp", "*NODE\n100, 9,9,9\n" + nodes + "*ELEMENT,TYPE=C3D8\n" + elements +
                                                     "*NSET,NSET=mixed\n100,9\n*NSET,NSET=lonely\n100\n"),
                       &notes);
  REQUIRE(mesh.nodes.size() == 12);
  CHECK(mesh.nodes[0] == Vec3{0, 0, 0});
  CHECK(mesh.elements[0] == CornerNodes{0, 1, 2, 3, 4, 5, 6, 7});
  CHECK(mesh.node_sets.at("mixed") == std::vector<int>{8});
  CHECK(mesh.node_sets.count("lonely") == 0);
  REQUIRE(notes.size() == 2);
  CHECK_THAT(notes[0], ContainsSubstring("1 nodes that belong to no hexahedron were left out, the first is node 100"));
}

TEST_CASE("sets nested without end don't exhaust the stack") {
  const TemporaryFolder folder;
  std::string text = two_cubes;
  for (int i = 0; i < 50000; ++i) text += "*NSET,NSET=s" + std::to_string(i) + "\ns" + std::to_string(i + 1) + "\n";
  text += "*NSET,NSET=s50000\n1\n";
  CHECK_THROWS_AS(read_abaqus_file(folder.write("deep.inp", text)), InputError);
}
