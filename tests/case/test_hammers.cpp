#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include "tests/case/temporary_case.hpp"

using namespace railwave;
using namespace railwave::test;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string blow =
    "[hammers.blow]\npart = \"cube\"\nsurface = \"z_max\"\nposition = [0.5, 0.5, 1]\nradius = 0.1\ndirection = [0, 0, "
    "-2]\n"
    "peak = 500\nstart = 1e-4\nduration = 2e-4\n";

}  // namespace

TEST_CASE("a hammer becomes a node set, a load, a blow of half a sine wave and a history set", "[case]") {
  TemporaryCase file(small_case + blow);
  const auto scene = read_case(file.path());
  REQUIRE(scene.node_sets.size() == 1);
  CHECK(scene.node_sets[0].name == "blow");
  CHECK(scene.node_sets[0].part == "cube");
  CHECK(scene.node_sets[0].surface == "z_max");
  CHECK(scene.node_sets[0].position == scene::Vec3{0.5, 0.5, 1});
  CHECK(scene.node_sets[0].radius == 0.1);
  CHECK_FALSE(scene.node_sets[0].box);
  REQUIRE(scene.loads.size() == 1);
  CHECK(scene.loads[0].name == "blow");
  CHECK(scene.loads[0].target == "cube.blow");
  CHECK(scene.loads[0].force == scene::Vec3{0, 0, -500});
  CHECK(scene.loads[0].curve == "blow");
  REQUIRE(scene.curves.size() == 1);
  CHECK(scene.curves[0].type == scene::CurveType::half_sine);
  CHECK(scene.curves[0].start == 1e-4);
  CHECK(scene.curves[0].duration == 2e-4);
  CHECK(scene.output.history_sets == std::vector<std::string>{"cube.blow"});
}

TEST_CASE("a measured blow is read from a file beside the case, and its changes settle anew", "[case]") {
  TemporaryCase file(small_case +
                     "[curves.measured]\ntype = \"table\"\nfile = \"blow.csv\"\n"
                     "[hammers.blow]\npart = \"cube\"\nposition = [0, 0, 0]\npeak = 2\ncurve = \"measured\"\n");
  file.write("blow.csv", "time, force\r\n0, 0\r\n1e-4, 250.5\r\n\r\n2e-4, 0\r\n");
  const auto scene = read_case(file.path());
  REQUIRE(scene.curves.size() == 1);
  CHECK(scene.curves[0].points == std::vector<std::array<double, 2>>{{0, 0}, {1e-4, 250.5}, {2e-4, 0}});
  CHECK(scene.loads[0].curve == "measured");
  file.write("blow.csv", "0,0\n1e-4,250\n2e-4,0\n");
  CHECK(read_case(file.path()).static_text != scene.static_text);

  file.write("blow.csv", "0,0\n1e-4 one\n");
  CHECK_THAT(mistakes_of(file.path()), ContainsSubstring("[curves.measured] file: ") &&
                                           ContainsSubstring("blow.csv:2: column 2 (value): 'one' is no number"));
  file.write("blow.csv", "0,0\n2e-4,1\n1e-4,2\n");
  CHECK_THAT(mistakes_of(file.path()),
             ContainsSubstring("blow.csv:3: time must increase from line to line, but has 0.0001 s after 0.0002 s"));
  file.write("blow.csv", "time,force\n");
  CHECK_THAT(mistakes_of(file.path()), ContainsSubstring("has no line with a pair time,value"));
}

TEST_CASE("a row of probes becomes numbered sets, one probe a set of its name, after the histories asked for",
          "[case]") {
  TemporaryCase file(small_case +
                     "[output]\nhistory_sets = [\"cube.z_min\"]\n"
                     "[probes.row]\npart = \"cube\"\nposition = [1, 2, 3]\ncount = 3\nspacing = [0.5, 0, 0]\n"
                     "[probes.one]\npart = \"cube\"\nposition = [0, 0, 0]\n");
  const auto scene = read_case(file.path());
  CHECK(scene.output.history_sets ==
        std::vector<std::string>{"cube.z_min", "cube.row_1", "cube.row_2", "cube.row_3", "cube.one"});
  REQUIRE(scene.node_sets.size() == 4);
  CHECK(scene.node_sets[2].position == scene::Vec3{2, 2, 3});
  CHECK(scene.loads.empty());
}

TEST_CASE("a hammer may strike what a track makes, with the hourglass control that the track has", "[case]") {
  TemporaryCase file(
      "[tracks.track]\nstart = -3\nend = 3\nhourglass = \"stiffness\"\nrail_stiffness_damping = "
      "2e-9\n[hammers.blow]\npart = \"track_rail\"\nposition "
      "= [0, 0, 0.16]\npeak = "
      "1\nduration = 2e-4\n[time]\nend = 1e-3\n");
  const auto scene = read_case(file.path());
  CHECK(scene.loads.at(0).target == "track_rail.blow");
  for (const auto& part : scene.parts) {
    CHECK(part.hourglass == scene::HourglassType::stiffness);
    if (part.name == "track_rail") CHECK(part.stiffness_damping == 2e-9);
    CHECK(part.hourglass_coefficient == 0.05);
  }
}

TEST_CASE("names of hammers and probes that are taken are reported", "[case]") {
  TemporaryCase file(small_case + blow + "[probes.blow]\npart = \"cube\"\nposition = [0, 0, 0]\n");
  CHECK_THAT(
      mistakes_of(file.path()),
      ContainsSubstring("[probes.blow]: makes the node set 'cube.blow', which is there already (line 12); rename one"));
  TemporaryCase load(small_case + blow +
                     "[loads.blow]\ntype = \"nodal_force\"\ntarget = \"cube.z_max\"\nforce = [0, 0, 1]\n");
  CHECK_THAT(mistakes_of(load.path()), ContainsSubstring("[hammers.blow]: makes [loads.blow], which is there already"));
}

TEST_CASE("the static state does not depend on probes", "[case]") {
  TemporaryCase without(small_case), with(small_case + "[probes.one]\npart = \"cube\"\nposition = [0, 0, 0]\n");
  CHECK(read_case(without.path()).static_text == read_case(with.path()).static_text);
}
