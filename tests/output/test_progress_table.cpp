// The progress table and the summary.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <sstream>

#include "output/progress.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;

namespace {

ProgressPlan plan() {
  ProgressPlan result;
  result.element_count = 1000000;
  result.end_time = 1e-4;
  result.interval = 5;
  result.contacts = {"tread"};
  result.algorithms = {"multipliers, the default"};
  return result;
}

HistorySample sample(long step) {
  HistorySample result;
  result.step = step;
  result.time = 1e-6 * step;
  result.energy.kinetic = 4000;
  result.energy.internal = 100;
  result.energy.contact = 25;
  result.energy.balance_error = step == 50 ? -2 : 1;
  ContactTotals totals;
  totals.normal_force = {0, 60e3, step < 80 ? 0 : 80e3};  // 100 kN in the last fifth
  totals.tangential_force = {25e3, 0, 0};
  result.contacts = {totals};
  return result;
}

struct Shown {
  std::vector<std::string> lines;
  std::string text;
};

/// A second of wall time a step.
Shown show(long last, const RunSummary& summary, const ProgressPlan& planned = plan()) {
  std::ostringstream out;
  double wall = 7;
  ProgressTable table(out, planned, [&] { return wall; });
  wall += 1000;  // preparations before the first step
  for (long step = 0; step <= last; ++step) {
    table.history(sample(step));
    wall += 1;
  }
  table.end(summary);
  Shown shown{{}, out.str()};
  std::istringstream in(shown.text);
  for (std::string line; std::getline(in, line);) shown.lines.push_back(line);
  return shown;
}

}  // namespace

TEST_CASE("a line at most every interval, with rate and time left") {
  RunSummary summary;
  summary.completed = true;
  const Shown shown = show(10, summary);
  // two lines of heading, then steps 0, 5 and 10
  CHECK_THAT(shown.lines.at(0), ContainsSubstring("step") && ContainsSubstring("left") && ContainsSubstring("balance"));
  CHECK_THAT(shown.lines.at(2), ContainsSubstring("0.00000"));
  CHECK_THAT(shown.lines.at(3), ContainsSubstring("0.00500") && ContainsSubstring("5.0") && ContainsSubstring("1.0") &&
                                    ContainsSubstring("1 min 35 s") && ContainsSubstring("60.000") &&
                                    ContainsSubstring("25.000"));
  CHECK_THAT(shown.lines.at(4), ContainsSubstring("1 min 30 s"));
  CHECK(shown.lines.at(5).empty());
}

TEST_CASE("the summary: means over the last fifth, balance errors, what was left out") {
  RunSummary summary;
  summary.completed = true;
  summary.time = 1e-4;
  summary.steps = 100;
  summary.step_size = 1e-6;
  summary.wall_seconds = 3725;
  summary.element_steps_per_second = 2.5e7;
  summary.left_out = {"gravity", "connectors"};
  summary.warnings = {"contact tread: late"};
  const std::string text = show(100, summary).text;
  CHECK_THAT(text, ContainsSubstring("\n  warning: contact tread: late\n"));
  CHECK_THAT(text, ContainsSubstring("\ncompleted\n"));
  CHECK_THAT(text, ContainsSubstring("in 100 steps of 1 us"));
  CHECK_THAT(text, ContainsSubstring("wall time 1 h 02 min, 25.00 million"));
  CHECK_THAT(text, ContainsSubstring("1 at the end, 2 at most"));
  CHECK_THAT(text, ContainsSubstring("largest energy (4000 J): 0.05 %; of the largest elastic energy (125 J): 1.6 %"));
  CHECK_THAT(text,
             ContainsSubstring("tread, mean over the last fifth: normal 100.000 kN, tangential 25.000 kN, traction "
                               "coefficient 0.2500 (multipliers, the default)\n"));
  CHECK_THAT(text, ContainsSubstring("left out, because the scene does not need it\n    gravity\n    connectors\n"));
}

TEST_CASE("the summary tells the worst that the monitor saw and what its checks took") {
  RunSummary summary;
  summary.worst_values = "speed 28 (500)";
  summary.monitor_seconds = 0.5;
  summary.wall_seconds = 100;
  CHECK_THAT(show(1, summary).text,
             ContainsSubstring(
                 "\n  monitor, worst values (limits): speed 28 (500)\n    its checks took 0.5 s, 0.5 % of the run\n"));
  summary.worst_values.clear();
  CHECK_THAT(show(1, summary).text, !ContainsSubstring("monitor"));
}

TEST_CASE("the summary has what outputs took") {
  RunSummary summary;
  summary.wall_seconds = 200;
  CHECK_THAT(show(1, summary).text, !ContainsSubstring("outputs took"));
  summary.output_seconds = 15;
  CHECK_THAT(show(1, summary).text, ContainsSubstring("\n  outputs took 15 s, 7.5 % of the run\n"));
}

TEST_CASE("with subcycling the rate counts the updates that were made, and the summary tells what is saved") {
  ProgressPlan planned = plan();
  planned.updates_saved = 2.5;
  RunSummary summary;
  summary.subcycling = {"750000 elements every 4 steps", "2.5 times fewer element updates"};
  const Shown shown = show(10, summary, planned);
  CHECK_THAT(shown.lines.at(3), ContainsSubstring(" 0.4 "));
  CHECK_THAT(shown.text,
             ContainsSubstring("  subcycling: 750000 elements every 4 steps\n  subcycling: 2.5 times fewer"));
}

TEST_CASE("a run that did not complete says why, and how far it came") {
  RunSummary summary;
  summary.reason = "interrupted";
  summary.time = 3e-5;
  summary.steps = 30;
  const std::string text = show(30, summary).text;
  CHECK_THAT(text, ContainsSubstring("NOT completed: interrupted"));
  CHECK_THAT(text, ContainsSubstring("reached 0.03 ms of 0.1 ms in 30 steps"));
}

TEST_CASE("long runs keep a bounded number of forces and still the right mean") {
  std::ostringstream out;
  ProgressPlan long_plan = plan();
  long_plan.interval = 1e9;
  ProgressTable table(out, long_plan, [] { return 0.0; });
  constexpr long steps = 100000;
  for (long step = 0; step <= steps; ++step) {
    HistorySample s = sample(step);
    s.contacts[0].normal_force = {0, 0, 1.0 * step};  // mean over the last fifth: 0.9 of the last
    table.history(s);
  }
  table.end({});
  CHECK_THAT(out.str(), ContainsSubstring("normal 90.000 kN"));
}

TEST_CASE("durations") {
  CHECK(duration_text(0.26) == "0.3 s");
  CHECK(duration_text(59) == "59 s");
  CHECK(duration_text(61) == "1 min 01 s");
  CHECK(duration_text(7260) == "2 h 01 min");
  CHECK(duration_text(std::nan("")) == "?");
}
