#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

#include "model/model.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;

TEST_CASE("no curve and a constant one are 1 at any time") {
  CHECK(curve_value(nullptr, -3) == 1);
  const scene::Curve constant;
  CHECK(curve_value(&constant, 7) == 1);
}

TEST_CASE("a cosine ramp rises as the driving torque of thesis eq. 3.2") {
  scene::Curve ramp;
  ramp.type = scene::CurveType::cosine_ramp;
  ramp.duration = 6e-3;
  for (double t : {0.0, 1e-3, 3e-3, 4.5e-3, 6e-3})
    CHECK_THAT(curve_value(&ramp, t), WithinAbs(0.5 * (1 - std::cos(M_PI * t / 6e-3)), 1e-15));
  CHECK(curve_value(&ramp, -1e-3) == 0);
  CHECK(curve_value(&ramp, 1) == 1);
  ramp.start = 2e-3;
  CHECK(curve_value(&ramp, 2e-3) == 0);
  CHECK_THAT(curve_value(&ramp, 5e-3), WithinAbs(0.5, 1e-15));
  CHECK(curve_value(&ramp, 8e-3) == 1);
}

TEST_CASE("a ramp without duration is a step") {
  scene::Curve ramp;
  ramp.type = scene::CurveType::cosine_ramp;
  ramp.start = 1;
  CHECK(curve_value(&ramp, 0.999) == 0);
  CHECK(curve_value(&ramp, 1.001) == 1);
}

TEST_CASE("a table is linear between its points, constant beyond, and may jump") {
  scene::Curve table;
  table.type = scene::CurveType::table;
  table.points = {{1, 10}, {2, 20}, {2, 50}, {4, -50}};
  CHECK(curve_value(&table, 0) == 10);
  CHECK(curve_value(&table, 1) == 10);
  CHECK_THAT(curve_value(&table, 1.25), WithinAbs(12.5, 1e-14));
  CHECK_THAT(curve_value(&table, 2.0001), WithinAbs(50 - 0.005, 1e-12));
  CHECK_THAT(curve_value(&table, 3), WithinAbs(0, 1e-14));
  CHECK(curve_value(&table, 9) == -50);
}

TEST_CASE("the integral of a curve is what many small rectangles sum to") {
  scene::Curve ramp;
  ramp.type = scene::CurveType::cosine_ramp;
  ramp.start = -0.5;
  ramp.duration = 2;
  scene::Curve table;
  table.type = scene::CurveType::table;
  table.points = {{-1, 4}, {1, 10}, {2, 20}, {2, 50}, {4, -50}};
  scene::Curve late = table;
  late.points = {{2, 3}, {3, 5}};
  for (const scene::Curve* curve : {static_cast<const scene::Curve*>(nullptr), static_cast<const scene::Curve*>(&ramp),
                                    static_cast<const scene::Curve*>(&table), static_cast<const scene::Curve*>(&late)})
    for (double end : {0.0, 0.7, 1.5, 3.0, 6.0}) {
      const int count = 60000;
      double sum = 0;
      for (int k = 0; k < count; ++k) sum += curve_value(curve, (k + 0.5) * end / count) * end / count;
      CHECK_THAT(curve_integral(curve, end), WithinAbs(sum, 2e-3));
    }
}

TEST_CASE("half a sine wave is a blow from its start for its duration, and its integral two over pi of that") {
  scene::Curve blow;
  blow.type = scene::CurveType::half_sine;
  blow.start = 1e-3;
  blow.duration = 2e-4;
  CHECK(curve_value(&blow, 0.5e-3) == 0);
  CHECK(curve_value(&blow, 1e-3) == 0);
  CHECK_THAT(curve_value(&blow, 1.05e-3), WithinAbs(std::sqrt(0.5), 1e-12));
  CHECK_THAT(curve_value(&blow, 1.1e-3), WithinAbs(1, 1e-15));
  CHECK_THAT(curve_value(&blow, 1.2e-3), WithinAbs(0, 1e-12));
  CHECK(curve_value(&blow, 1.21e-3) == 0);
  CHECK(curve_value(&blow, 1) == 0);
  CHECK_THAT(curve_integral(&blow, 1), WithinAbs(2 / M_PI * 2e-4, 1e-18));
}
