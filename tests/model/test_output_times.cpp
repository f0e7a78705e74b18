// Steps planned so that outputs are evenly spaced from the first to the last.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

#include <cmath>

#include "model/output_times.hpp"

using namespace railwave;
using Catch::Matchers::WithinRel;

namespace {

/// Steps between two outputs, as the time loop takes them.
long every(const StepPlan& plan, double interval, long cycle = 1) {
  return std::max(1L, std::lround(interval / (static_cast<double>(cycle) * plan.size))) * cycle;
}

}  // namespace

TEST_CASE("steps make whole intervals and the run whole intervals, of both outputs") {
  const StepPlan plan = equal_steps(1e-3, 1.37e-7, 1e-5, 2.5e-5, 1, false);
  CHECK(plan.size <= 1.37e-7);
  CHECK(plan.size > 0.9 * 1.37e-7);
  CHECK_THAT(every(plan, 1e-5) * plan.size, WithinRel(1e-5, 1e-12));
  CHECK_THAT(every(plan, 2.5e-5) * plan.size, WithinRel(2.5e-5, 1e-12));
  CHECK(plan.count % every(plan, 1e-5) == 0);
  CHECK(plan.count % every(plan, 2.5e-5) == 0);
  CHECK(plan.times.history == 1e-5);
  CHECK(plan.times.fields == 2.5e-5);
}

TEST_CASE("a later end has the same steps, bit for bit") {
  const StepPlan plan = equal_steps(1e-3, 1.37e-7, 1e-5, 1e-4, 1, false);
  for (const double end : {2e-3, 3.7e-3, 0.1, 0.3}) {
    const StepPlan later = equal_steps(end, 1.37e-7, 1e-5, 1e-4, 1, false);
    CHECK(later.size == plan.size);
    CHECK_THAT(static_cast<double>(later.count) * later.size, WithinRel(end, 1e-12));
  }
}

TEST_CASE("an end that is no whole number of intervals shortens these, and the last sample is no exception") {
  for (const double interval : {3e-5, 7.77e-5, 9e-4, 5.0}) {
    const StepPlan plan = equal_steps(1e-3, 1.37e-7, interval, 0, 1, false);
    INFO("interval " << interval);
    CHECK(plan.times.history <= interval);
    CHECK(plan.times.history > 0.5 * std::fmin(interval, 1e-3));
    CHECK(plan.count % every(plan, plan.times.history) == 0);
    CHECK_THAT(static_cast<double>(plan.count) * plan.size, WithinRel(1e-3, 1e-12));
    CHECK(plan.size <= 1.37e-7);
  }
}

TEST_CASE("an interval of few steps is rounded to whole ones rather than made dear, and is even to the last") {
  for (const double steps : {0.3, 0.95, 1.2, 1.6, 2.3, 2.95, 3.4, 5.1, 8.7}) {
    const double largest = 1.37e-7, end = 1e-4;
    const StepPlan plan = equal_steps(end, largest, steps * largest, 0, 1, false);
    INFO("interval of " << steps << " steps, every " << every(plan, plan.times.history));
    CHECK(plan.size <= largest);
    CHECK(plan.size > largest / 1.1);
    CHECK(plan.count % every(plan, plan.times.history) == 0);
    CHECK(every(plan, plan.times.history) * plan.size < 1.5 * std::fmax(steps, 1.0) * largest);
  }
}

TEST_CASE("every step is a sample where no interval is given, and fields are even then too") {
  const StepPlan plan = equal_steps(1e-3, 1.37e-7, 0, 3e-5, 1, false);
  CHECK(plan.times.history == 0);
  CHECK(plan.count % every(plan, plan.times.fields) == 0);
  CHECK(equal_steps(1e-3, 1.37e-7, 0, 0, 1, false).count == static_cast<long>(std::ceil(1e-3 / 1.37e-7)));
}

TEST_CASE("samples fall on whole cycles of subcycling, evenly to the last") {
  for (const double interval : {1e-5, 3e-5, 9e-7}) {
    const StepPlan plan = equal_steps(1e-3, 1.37e-7, interval, 0, 8, false);
    CHECK(plan.count % 8 == 0);
    CHECK(every(plan, plan.times.history, 8) % 8 == 0);
    CHECK(plan.count % every(plan, plan.times.history, 8) == 0);
    CHECK(plan.size <= 1.37e-7);
  }
}

TEST_CASE("a step that was asked for stays") {
  const StepPlan plan = equal_steps(1e-3, 1e-7, 3e-6, 0, 1, true);
  CHECK(plan.count == 10000);
  CHECK_THAT(plan.size, WithinRel(1e-7, 1e-12));
}

TEST_CASE("intervals beyond all bounds do no harm") {
  CHECK(equal_steps(1e-3, 1e-7, 1e-300, 1e300, 1, false).count == 10000);
  CHECK(equal_steps(1e-300, 1e-7, 1e-7, 1, 1, false).count == 1);
  CHECK(equal_steps(1.0, 1e-7, 1e-7 / 3, 1.0 / 3e6, 1, false).size <= 1e-7);
}
