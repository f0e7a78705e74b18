#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "model/sets/point_search.hpp"

using namespace railwave;

TEST_CASE("the tree finds what a search over all points finds") {
  std::mt19937 generator(2);
  // Coordinates in whole tenths, so that many points are equally near.
  std::uniform_int_distribution<int> tenth(0, 10);
  const auto point = [&] { return Vec3{0.1 * tenth(generator), 0.1 * tenth(generator), 0.1 * tenth(generator)}; };
  std::vector<Vec3> points(300);
  for (Vec3& p : points) p = point();
  const NearestPoint tree(points);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 place = point();
    const double reach = 0.05 * tenth(generator);
    int nearest = -1;
    double least = reach * reach;
    for (int k = 0; k < 300; ++k) {
      double squared = 0;
      for (int i = 0; i < 3; ++i) squared += (place[i] - points[k][i]) * (place[i] - points[k][i]);
      if (squared < least || (squared == least && nearest < 0)) {
        least = squared;
        nearest = k;
      }
    }
    CHECK(tree.find(place, reach) == nearest);
  }
  CHECK(NearestPoint({}).find({0, 0, 0}, 1) == -1);
}

TEST_CASE("nodes within boxes are found in a body, on a surface and on a line, in steps as large as they are apart") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> between(0, 1);
  for (const int dimensions : {1, 2, 3}) {
    std::vector<Vec3> places(2000, Vec3{0.5, 0.5, 0.5});
    for (Vec3& x : places)
      for (int i = 0; i < dimensions; ++i) x[i] = between(random);
    std::vector<int> nodes(places.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    Bounds all = no_bounds;
    for (const Vec3& x : places) widen(all, x);
    const NodeGrid grid(places, nodes, all);
    // Boxes that reach to both sides of the surface: in steps of what rounding leaves between its nodes there, a
    // million cells each.
    for (int k = 0; k < 1000; ++k) {
      Bounds box{};
      for (int i = 0; i < 3; ++i) {
        box[0][i] = between(random) - 0.3;
        box[1][i] = box[0][i] + 0.6;
      }
      std::vector<int> found, expected;
      grid.within(box, [&](int n) { found.push_back(n); });
      for (const int n : nodes)
        if (holds(box, places[n])) expected.push_back(n);
      std::sort(found.begin(), found.end());
      REQUIRE(found == expected);
    }
  }
}
