#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>

#include "solve/monitor/force_swing.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;

TEST_CASE("a decaying swing is reported with the time from which it stays below a tenth") {
  ForceSwing force;
  // 100 kN (1 + exp(-t / 1 ms) cos(2 pi t / 0.1 ms)): at peaks below a tenth from t = ln(10) ms on.
  for (int k = 0; k <= 10000; ++k) {
    const double t = 1e-6 * k;
    force.add(t, {0, 0, -1e5 * (1 + std::exp(-t / 1e-3) * std::cos(2 * M_PI * t / 1e-4))});
  }
  CHECK_THAT(force.static_value(), WithinAbs(1e5, 50));
  CHECK_THAT(force.quiet_from(), WithinAbs(std::log(10) * 1e-3, 0.06e-3));
  CHECK_THAT(force.swing(0, 0.1), WithinAbs(0.98, 0.02));
  CHECK(force.swing(0.9, 1) < 1e-3);
  CHECK_THAT(force.summary("tread"), ContainsSubstring("contact tread") && ContainsSubstring("from t = 2.3"));
}

TEST_CASE("a swing that goes on is reported as such; nothing is reported of a contact that never touches") {
  ForceSwing force, apart;
  for (int k = 0; k <= 1000; ++k) {
    force.add(1e-6 * k, {0, 0, 1e5 * (1 + 0.3 * std::sin(0.1 * k))});
    apart.add(1e-6 * k, {0, 0, 0});
  }
  CHECK_FALSE(std::isfinite(force.quiet_from()));
  CHECK_THAT(force.summary("tread"), ContainsSubstring("to the end it does not stay within 10 %"));
  CHECK(apart.summary("tread").empty());
}
