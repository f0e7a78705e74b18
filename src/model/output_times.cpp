#include "model/output_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/time_step/stable_step.hpp"

namespace railwave {
namespace {

/// How many more steps than needed may be taken so that they make whole intervals.
constexpr double most_more = 1.1;

/// Share by which a quotient may miss a whole number and still is one: far above rounding.
constexpr double rounding = 1e-9;

/// An interval of which a whole number makes the run.
struct Division {
  long count = 1;         ///< of intervals
  double interval = 0;    ///< s
  bool as_asked = false;  ///< and not shortened
};

Division divide(double end, double interval) {
  constexpr double countable = 1e15;
  const double quotient = std::fmin(end / interval, countable);
  const double nearest = std::fmax(1.0, std::round(quotient));
  if (std::fabs(quotient - nearest) <= rounding * nearest) return {static_cast<long>(nearest), interval, true};
  const long count = std::max(1L, static_cast<long>(std::ceil(quotient)));
  return {count, end / static_cast<double>(count), false};
}

/// The least multiple of `unit` that is at least `least`.
long up_to_multiple(double least, long unit) {
  return std::max(1L, static_cast<long>(std::ceil(least / static_cast<double>(unit) - rounding))) * unit;
}

/// Least common multiple; 0 where it is beyond `most`.
long common_multiple(long a, long b, double most) {
  const double multiple = static_cast<double>(a / std::gcd(a, b)) * static_cast<double>(b);
  return multiple <= most ? a / std::gcd(a, b) * b : 0;
}

}  // namespace

long whole_cycles(double interval, double step, long cycle) {
  return std::max(1L, std::lround(interval / (static_cast<double>(cycle) * step))) * cycle;
}

StepPlan equal_steps(double end, double largest, double history, double fields, long cycle, bool fixed) {
  const double needed = end / largest;
  const long fewest = up_to_multiple(needed, cycle);
  const Division samples = history > 0 ? divide(end, history) : Division{},
                 outputs = fields > 0 ? divide(end, fields) : Division{1, end, true};
  StepPlan plan{fewest, end / static_cast<double>(fewest), {history > 0 ? samples.interval : 0, outputs.interval}};
  if (fixed) return plan;

  const double most = std::fmax(static_cast<double>(fewest), most_more * needed);
  // Divisions of the run whose ends must be ends of cycles: both outputs', or those of the histories alone.
  for (const long division : {common_multiple(samples.count, outputs.count, most), samples.count}) {
    if (division == 0 || static_cast<double>(division) * static_cast<double>(cycle) > most) continue;
    const long count = up_to_multiple(needed, division * cycle);
    if (static_cast<double>(count) > most) continue;
    plan.count = count;
    // By the interval as it was asked for, so that a later end has the same steps.
    const Division& by = history > 0 && samples.as_asked ? samples : outputs;
    plan.size = by.as_asked && count % by.count == 0 ? by.interval / static_cast<double>(count / by.count)
                                                     : end / static_cast<double>(count);
    return plan;
  }
  if (history > 0) {
    const long every = whole_cycles(samples.interval, largest, cycle);
    if (const long count = up_to_multiple(needed, every); static_cast<double>(count) <= most) {
      plan.count = count;
      plan.size = end / static_cast<double>(count);
      plan.times.history = static_cast<double>(every) * plan.size;
    }
  }
  return plan;
}

void plan_steps(const scene::Scene& scene, long cycle, StepSizes& sizes) {
  const StepPlan plan =
      equal_steps(scene.time.end, largest_step(scene.time, sizes.stable_step), scene.output.history_interval,
                  scene.output.field_interval, cycle, scene.time.step > 0);
  sizes.step_count = plan.count;
  sizes.step_size = plan.size;
  sizes.output_times = plan.times;
}

std::vector<std::string> describe_output_times(const scene::Scene& scene, const StepSizes& sizes, long cycle) {
  const scene::Output& output = scene.output;
  const auto spacing = [&](double interval, double asked) {
    const long every = whole_cycles(interval, sizes.step_size, cycle);
    const double apart = static_cast<double>(every) * sizes.step_size;
    return fmt::format(
        "every {:.6g} s ({} step{}){}", apart, every, every == 1 ? "" : "s",
        asked > 0 && std::fabs(apart - asked) > 1e-6 * asked ? fmt::format(", asked for: {:.6g} s", asked) : "");
  };
  const auto line = [&](const char* what, double interval, double asked, bool ends_only) {
    if (ends_only || whole_cycles(interval, sizes.step_size, cycle) >= sizes.step_count)
      return fmt::format("{} at the beginning and the end", what);
    return fmt::format("{} {}", what, spacing(interval, asked));
  };
  std::vector<std::string> lines = {
      line("samples of histories", sizes.output_times.history, output.history_interval, false),
      line("outputs of fields", sizes.output_times.fields, output.field_interval, !(output.field_interval > 0))};
  for (const scene::OutputWindow& window : scene.output_windows)
    lines.push_back(fmt::format("outputs of fields from {:.6g} to {:.6g} s ({}) besides {}", window.start,
                                window.end.value_or(scene.time.end), window.name,
                                spacing(window.interval, window.interval)));
  return lines;
}

}  // namespace railwave
