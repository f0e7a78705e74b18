#include <catch2/catch_test_macros.hpp>

#include <random>

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
