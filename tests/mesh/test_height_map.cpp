#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "complaint.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/height_map.hpp"
#include "mesh/quality.hpp"
#include "tests/temporary_folder.hpp"
#include "topology.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

namespace {

/// A file that lives as long as this object.
class MapFile {
 public:
  explicit MapFile(const std::string& text) : path_(folder_.write("heights.csv", text)) {}
  const std::string& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

std::string refusal(const std::string& text) {
  const MapFile file(text);
  try {
    const HeightMap map(file.path());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

scene::MeshSource rail_with(const std::string& map) {
  scene::MeshSource source;
  source.name = "rail";
  source.line = 17;
  source.type = scene::MeshType::rail;
  source.rail.end = 0.3;
  source.rail.inclination = 0;
  source.rail.height_map = map;
  return source;
}

/// A dip of 0.4 mm over 40 mm, as wide as the head.
double dip(double x) {
  return std::fabs(x - 0.05) < 0.02 ? -4e-4 * std::pow(std::cos(M_PI * (x - 0.05) / 0.04), 2) : 0;
}

std::string dip_file(double factor) {
  std::string text = "x, y, dz\n";
  for (int i = 0; i <= 40; ++i)
    for (double y : {0.04, -0.04})
      text += std::to_string(0.03 + 1e-3 * i) + "," + std::to_string(y) + "," +
              std::to_string(factor * dip(0.03 + 1e-3 * i)) + "\n";
  return text;
}

}  // namespace

TEST_CASE("A height map is interpolated bilinearly, and is nothing beyond its grid") {
  // z = 1 + 2 x + 3 y + 4 x y in mm is bilinear, so exact anywhere; lines in no order.
  const MapFile file("x,y,dz\n1,2,17e-3\n0,0,1e-3\n1,0,3e-3\n0,2,7e-3\n\n");
  const HeightMap map(file.path());
  for (double x : {0.0, 0.3, 1.0})
    for (double y : {0.0, 1.1, 2.0}) CHECK_THAT(map.at(x, y), WithinAbs(1e-3 * (1 + 2 * x + 3 * y + 4 * x * y), 1e-15));
  CHECK(map.at(-0.01, 1) == 0);
  CHECK(map.at(0.5, 2.01) == 0);
  const MapFile other(
      "\xef\xbb\xbf# measured\r\nx [m]; y [m]; dz [m]\r\n1;2;17e-3\r\n0;0;1e-3\r\n1;0;3e-3\r\n0;2;7e-3\r\n");
  CHECK(HeightMap(other.path()).at(0.3, 1.1) == map.at(0.3, 1.1));
}

TEST_CASE("What is wrong with a height map is reported with its line") {
  CHECK_THAT(refusal("x,y,z\n0,0,0\n"),
             ContainsSubstring(":1: the first line is 'x,y,z', must name the columns: x,y,dz"));
  CHECK_THAT(refusal("x,y,dz\n0,0\n"), ContainsSubstring(":2: has 2 values, must have three: x,y,dz"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0\n0,1,nan\n"),
             ContainsSubstring(":3: column 3 (dz in m): 'nan' is no finite number"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0\n0,0,1\n"), ContainsSubstring(":3: gives the place x = 0, y = 0 a second time"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0\n0,1,0\n1,1,0\n"),
             ContainsSubstring("has a hole: no line gives the place x = 1, y = 0"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0\n0,1,0\n"), ContainsSubstring("has 1 different x and 2 different y"));
  CHECK_THAT(refusal(""), ContainsSubstring("the first line is ''"));
  CHECK_THAT(refusal("x;y;dz\n0;0;0,001\n"),
             ContainsSubstring(":2: column 3 (dz in m): '0,001' has a comma in it: a decimal comma? then write 0.001"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0,001\n"), ContainsSubstring(":2: has 4 values, must have three: x,y,dz"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0.1 mm\n"),
             ContainsSubstring(":2: column 3 (dz in m): '0.1 mm' has something behind the number"));
  CHECK_THAT(refusal("x,y,dz [mm]\n0,0,0.1\n"),
             ContainsSubstring(":1: column 3 (dz in m) is called 'dz [mm]', but is read in m"));
  CHECK_THAT(refusal("y,x,dz\n0,0,0.1\n"), ContainsSubstring("must name the columns: x,y,dz"));
  CHECK_THAT(refusal("x,y,dz\n0,0,0,\n"), ContainsSubstring(":2: '0,0,0,' ends with a separator"));
  CHECK_THAT(refusal("x,y,dz\n0;0;0\n0,1,0\n"),
             ContainsSubstring(":3: its columns are separated by commas, those of line 2 by semicolons"));
  CHECK_THAT(refusal("x,y,dz\n0,0,1e400\n"), ContainsSubstring("'1e400' is too large"));
}

TEST_CASE("A rail's running surface takes the measured heights, and the rail below keeps its place") {
  const MapFile file(dip_file(1));
  const Mesh nominal = rail_mesh(rail_with("")), measured = rail_mesh(rail_with(file.path()));
  REQUIRE(measured.nodes.size() == nominal.nodes.size());
  CHECK(mesh_quality(measured, 1).inverted == 0);
  std::set<int> top;
  for (const Face& face : nominal.surfaces.at("running_surface"))
    for (int n : nominal.face_nodes(face))
      if (std::fabs(nominal.nodes[n][1]) < 0.02) top.insert(n);
  double lowest = 0, deepest_moved = 1;
  for (int n = 0; n < static_cast<int>(nominal.nodes.size()); ++n) {
    const Vec3 &a = nominal.nodes[n], &b = measured.nodes[n];
    CHECK(a[0] == b[0]);
    CHECK(a[1] == b[1]);
    const double moved = b[2] - a[2];
    // Straight lines over 1 mm of a curve of radius 0.4 m depart from it by 0.3 um.
    if (top.count(n) != 0) CHECK_THAT(moved, WithinAbs(dip(a[0]), 1e-6));
    CHECK(moved <= 0);
    CHECK(moved >= dip(a[0]) - 1e-6);
    lowest = std::min(lowest, moved);
    if (moved != 0 && std::fabs(a[1]) < 0.02) deepest_moved = std::min(deepest_moved, a[2]);
  }
  CHECK(lowest < -3.9e-4);
  // The 54E1 rail is 159 mm high; 20 mm from its middle the crown is lower by under 1.5 mm.
  CHECK(deepest_moved > 0.159 - 0.0015 - 0.015);
  CHECK(deepest_moved < 0.159 - 0.010);
}

TEST_CASE("A height map that inverts elements is refused with the place") {
  const MapFile file(dip_file(40));
  CHECK_THAT(complaint_of(rail_with(file.path())),
             ContainsSubstring("[meshes.rail] (line 17): height_map: inverts the element at ("));
}

TEST_CASE("A rail has its foot and both ends as surfaces") {
  scene::MeshSource source = rail_with("");
  source.rail.inclination = 0.025;
  const Mesh mesh = rail_mesh(source);
  const auto area = [&](const char* name, int axis) { return area_vector(mesh, mesh.surfaces.at(name))[axis]; };
  // Normals point out of the rail: down, backwards, forwards.
  CHECK(area("start_face", 0) < -0.0069);
  CHECK(area("end_face", 0) > 0.0069);
  const double foot = -area("foot", 2) / 0.6;
  CHECK(foot > 0.13);
  CHECK(foot < 0.141);
}
