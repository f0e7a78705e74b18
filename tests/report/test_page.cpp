#include <Eigen/Geometry>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <limits>

#include "post/contact_tables.hpp"
#include "report/body_surface.hpp"
#include "report/page.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

TEST_CASE("Results are called by where their paths differ") {
  CHECK(page::short_names({"results/rolling/rolling.h5"}) == std::vector<std::string>{"rolling"});
  CHECK(page::short_names({"results/a/rolling.h5", "results/b/rolling.h5"}) == std::vector<std::string>{"a", "b"});
  CHECK(page::short_names({"results/a/one.h5", "results/a/two.h5"}) == std::vector<std::string>{"one", "two"});
  CHECK(page::short_names({"/x/a/one.h5", "/x/b/two.h5"}) == std::vector<std::string>{"a/one", "b/two"});
  const std::string members = "results/study/members/";
  CHECK(page::short_names({members + "a=1-0123456789ab/results.h5", members + "a=2-abcdef012345/results.h5"}) ==
        std::vector<std::string>{"a=1", "a=2"});
  CHECK(page::short_names({members + "a=1-0123456789ab/results.h5", members + "a=1-abcdef012345/results.h5"}) ==
        std::vector<std::string>{"a=1-0123456789ab", "a=1-abcdef012345"});
  // The same file twice: their paths do not differ, and they keep a name.
  CHECK(page::short_names({"a/one.h5", "a/one.h5"}) == std::vector<std::string>{"a", "a"});
}

TEST_CASE("Evenly chosen instants have the first and the last") {
  CHECK(evenly_chosen(5, 10) == std::vector<std::size_t>{0, 1, 2, 3, 4});
  CHECK(evenly_chosen(11, 3) == std::vector<std::size_t>{0, 5, 10});
  CHECK(evenly_chosen(10, 4) == std::vector<std::size_t>{0, 3, 6, 9});
  CHECK(evenly_chosen(7, 1) == std::vector<std::size_t>{6});
  CHECK(evenly_chosen(0, 4).empty());
  CHECK(evenly_chosen(4, 0).empty());
  for (const std::size_t most : {2u, 7u, 60u, 61u, 99u}) {
    const auto chosen = evenly_chosen(100, most);
    REQUIRE(chosen.size() == most);
    CHECK(chosen.front() == 0);
    CHECK(chosen.back() == 99);
    for (std::size_t i = 1; i < chosen.size(); ++i) CHECK(chosen[i] > chosen[i - 1]);
  }
}

TEST_CASE("Text in a page ends neither its string nor its script") {
  CHECK(page::text_for_html("a \"b\" \\ </script>\n") == "\"a \\\"b\\\" \\\\ \\u003c/script>\\n\"");
  CHECK(page::text_for_html("no UTF-8: \xff") == "\"no UTF-8: \xef\xbf\xbd\"");
  CHECK(page::text_for_html(std::numeric_limits<double>::infinity()) == "null");
  CHECK(page::text_for_html({{"z", 0.25}, {"a", {2, 3}}}) == R"({"z":0.25,"a":[2,3]})");
}

TEST_CASE("The rigid motion of a body is found beside a small deformation") {
  const double angle = 0.7;
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, 2, 3).normalized());
  const Eigen::Vector3d shift(0.1, -2, 30);
  std::vector<Eigen::Vector3d> nodes;
  std::vector<double> displacements;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 5; ++z) {
        const Eigen::Vector3d node(0.1 * x, 0.1 * y, 0.1 * z);
        const Eigen::Vector3d moved = turn * node + shift - node;
        nodes.push_back(node);
        displacements.insert(displacements.end(), moved.data(), moved.data() + 3);
      }
  displacements[3 * 7] = std::numeric_limits<double>::quiet_NaN();  // not known: it does not count
  const page::RigidMotion motion = page::nearest_rigid_motion(nodes, displacements);
  CHECK_THAT((motion.turn - turn.toRotationMatrix()).norm(), WithinAbs(0, 1e-12));
  for (const Eigen::Vector3d& node : nodes)
    CHECK_THAT((motion.moved(node) - (turn * node + shift)).norm(), WithinAbs(0, 1e-11));
}

TEST_CASE("A flat surface turned over keeps a rotation, not a mirror image") {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<double> displacements;
  const Eigen::AngleAxisd turn(3.0, Eigen::Vector3d::UnitX());
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y) {
      nodes.emplace_back(x, y, 0);
      const Eigen::Vector3d moved = turn * nodes.back() - nodes.back();
      displacements.insert(displacements.end(), moved.data(), moved.data() + 3);
    }
  const page::RigidMotion motion = page::nearest_rigid_motion(nodes, displacements);
  CHECK_THAT(motion.turn.determinant(), WithinAbs(1, 1e-12));
  CHECK_THAT((motion.turn - turn.toRotationMatrix()).norm(), WithinAbs(0, 1e-12));
}

TEST_CASE("Two nodes have no rigid motion") {
  const page::RigidMotion motion = page::nearest_rigid_motion({{0, 0, 0}, {1, 0, 0}}, {1, 1, 1, 1, 1, 1});
  CHECK(motion.turn == Eigen::Matrix3d::Identity());
  CHECK(motion.shift.norm() == 0);
}

TEST_CASE("A long history keeps its peaks where it is thinned") {
  HistoryTable history;
  SampledChannel channel;
  channel.channel.name = "energy.kinetic";
  for (int i = 0; i < 10000; ++i) {
    history.times.push_back(1e-5 * i);
    channel.channel.values.push_back(i == 4321 ? 7 : -1);
  }
  history.channels.push_back(channel);
  page::PageBlocks blocks;
  const page::Section section = page::history_section(history, {60, 100}, blocks);
  CHECK(section.there.samples == 10000);
  REQUIRE(section.notes.size() == 1);
  CHECK(section.notes[0].find("10000 samples are drawn as the smallest and the largest value of 50") !=
        std::string::npos);
  CHECK(section.json.at("shown") == 100);
}
