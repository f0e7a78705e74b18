// Channels read from a results file: what they are called, evenly spaced times, and what is said of those that are not
// there.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <algorithm>

#include "case/error.hpp"
#include "post/channel_name.hpp"
#include "post/history_series.hpp"
#include "tests/output/made_up_run.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Set i moves by cos(2000 pi t + i) along x, twice that along z; written at the times given.
void write_run(const std::string& path, const std::vector<double>& times) {
  RunDescription description = made_up::description();
  description.history_sets = {"block.row_1", "block.row_2", "mass"};
  description.history_positions = {{0, 0, 1}, {0.5, 0, 1}, {0, 0, 2}};
  description.beams = {{"sleeper", 2}};
  ResultsWriter writer(path, description);
  for (std::size_t n = 0; n < times.size(); ++n) {
    HistorySample sample = made_up::sample(static_cast<long>(n));
    sample.time = times[n];
    sample.sets.assign(3, {});
    for (int i = 0; i < 3; ++i) {
      const double x = std::cos(2000 * M_PI * times[n] + i);
      sample.sets[i].velocity = {x, 0, 2 * x};
    }
    sample.beams.push_back({{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}});
    writer.history(sample);
  }
  writer.end(made_up::summary());
}

std::vector<double> even_times(std::size_t count = 100) {
  std::vector<double> times(count);
  for (std::size_t n = 0; n < count; ++n) times[n] = 1e-5 * static_cast<double>(n);
  return times;
}

HistorySeries read(const std::string& path, const std::vector<std::string>& channels, bool average = false) {
  HistoryRequest request;
  request.channels = channels;
  request.average = average;
  return read_history(ResultsReader(path), request);
}

std::string complaint(const std::string& path, const std::string& channel) {
  try {
    read(path, {channel});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("channels along axes, along a vector, in size, several at once and their mean") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  write_run(path, even_times());

  auto series = read(
      path, {"block.row_1.velocity.z", "block.row_2.velocity.3,0,4", "mass.velocity.size", "beam.sleeper.moment.1.y",
             "contact.tread.nodes_in_contact", "contact.tread.normal_force.z", "energy.kinetic"});
  REQUIRE(series.channels.size() == 7);
  REQUIRE(series.length() == 100);
  CHECK_THAT(series.interval, WithinRel(1e-5, 1e-9));
  CHECK(series.notes.empty());
  const double at = series.time(17);
  const auto value = [&](int channel) { return series.channels[channel].values[17]; };
  CHECK_THAT(value(0), WithinRel(2 * std::cos(2000 * M_PI * at), 1e-9));
  CHECK_THAT(value(1), WithinRel((0.6 + 1.6) * std::cos(2000 * M_PI * at + 1), 1e-9));
  CHECK_THAT(value(2), WithinRel(std::sqrt(5.0) * std::fabs(std::cos(2000 * M_PI * at + 2)), 1e-9));
  CHECK(value(3) == 11);
  CHECK(value(4) == 117);
  CHECK(value(6) == 1017);
  CHECK(series.channels[0].unit == "m/s");
  CHECK(series.channels[3].unit == "N m");
  CHECK(series.channels[5].unit == "N");
  CHECK(series.channels[3].name == "beam.sleeper.moment.1.y");
  REQUIRE(series.channels[1].position);
  CHECK((*series.channels[1].position)[0] == 0.5);
  CHECK(!series.channels[3].position);

  series = read(path, {"block.row_*.velocity.x"});
  REQUIRE(series.channels.size() == 2);
  CHECK(series.channels[1].name == "block.row_2.velocity.x");

  // Numbers count by their value.
  const auto found = find_channels("row_*.velocity.x", {{"row_1", "row_10", "row_2"}, {}, {}, {}, {}}, path);
  REQUIRE(found.size() == 3);
  CHECK(found[1].front().owner == "row_2");

  for (const bool average : {false, true}) {
    series = read(path, {average ? "block.row_*.velocity.x" : "block.row_1+block.row_2.velocity.x"}, average);
    REQUIRE(series.channels.size() == 1);
    CHECK(series.channels[0].name == "block.row_1+block.row_2.velocity.x");
    CHECK_THAT(series.channels[0].values[17],
               WithinRel(0.5 * (std::cos(2000 * M_PI * at) + std::cos(2000 * M_PI * at + 1)), 1e-9));
    CHECK((*series.channels[0].position)[0] == 0.25);
  }
}

TEST_CASE("a last sample that comes early is left out; changed steps are moved to even times; gaps are refused") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  auto times = even_times();
  times.push_back(times.back() + 3e-6);
  write_run(path, times);
  auto series = read(path, {"mass.velocity.x"});
  CHECK(series.length() == 100);
  CHECK(series.notes.empty());

  times = even_times();
  for (std::size_t n = 40; n < times.size(); ++n) times[n] = times[39] + 0.93e-5 * static_cast<double>(n - 39);
  write_run(path, times);
  series = read(path, {"mass.velocity.x"});
  REQUIRE(series.notes.size() == 1);
  CHECK_THAT(series.notes[0], ContainsSubstring("cubic interpolation"));
  REQUIRE(series.length() == 100);
  for (std::size_t i = 0; i < series.length(); ++i)
    CHECK_THAT(series.channels[0].values[i], WithinAbs(std::cos(2000 * M_PI * series.time(i) + 2), 2e-6));

  times = even_times();
  times.erase(times.begin() + 50, times.begin() + 53);
  write_run(path, times);
  CHECK_THAT(complaint(path, "mass.velocity.x"), ContainsSubstring("a gap of 4e-05 s among samples 1e-05 s apart"));
  HistoryRequest request;
  request.channels = {"mass.velocity.x"};
  request.from = 5.25e-4;
  CHECK(read_history(ResultsReader(path), request).length() == 47);
  request.from = 1;
  CHECK_THROWS_WITH(read_history(ResultsReader(path), request),
                    ContainsSubstring("has 0 history samples from 1 s, of which 4 are wanted"));
  write_run(path, even_times(2));
  CHECK_THAT(complaint(path, "mass.velocity.x"), ContainsSubstring("has 2 history samples, of which 4 are wanted"));

  times = even_times();
  std::fill(times.begin() + 60, times.begin() + 62, times[59]);
  write_run(path, times);
  CHECK_THAT(complaint(path, "mass.velocity.x"), ContainsSubstring("time does not ascend"));
}

TEST_CASE("what is not there is refused with what there is") {
  const made_up::TemporaryFolder folder;
  const std::string path = folder / "run.h5";
  write_run(path, even_times());
  CHECK_THAT(complaint(path, "block.raw_1.velocity.z"),
             ContainsSubstring("no history of a set 'block.raw_1'; did you mean 'block.row_1'?"));
  CHECK_THAT(complaint(path, "block.row_1.velocty.z"), ContainsSubstring("did you mean 'block.row_1.velocity'?"));
  CHECK_THAT(complaint(path, "block.row_1.velocity"),
             ContainsSubstring("it needs a direction at its end: x, y, z, size"));
  CHECK_THAT(complaint(path, "block.row_1.velocity.up"), ContainsSubstring("'up' is no direction"));
  CHECK_THAT(complaint(path, "block.row_1.velocity.0,0,0"), ContainsSubstring("is no direction"));
  CHECK_THAT(complaint(path, "contact.tread.normal_force"), ContainsSubstring("it needs a direction"));
  CHECK_THAT(complaint(path, "contact.thread.normal_force.z"), ContainsSubstring("did you mean 'tread'?"));
  CHECK_THAT(complaint(path, "contact.tread.pressure"), ContainsSubstring("known are: normal_force"));
  CHECK_THAT(complaint(path, "contact.tread.nodes_in_contact.z"), ContainsSubstring("no direction"));
  CHECK_THAT(complaint(path, "beam.sleeper.moment.y"), ContainsSubstring("the number of an element"));
  CHECK_THAT(complaint(path, "beam.sleeper.moment.2.y"), ContainsSubstring("the beam has 2 elements"));
  CHECK_THAT(complaint(path, "energy.kinetik"), ContainsSubstring("did you mean 'kinetic'?"));
  CHECK_THAT(
      complaint(path, "nonsense"),
      ContainsSubstring(
          "there are SET.(displacement|velocity|acceleration) of block.row_1, block.row_2, mass; contact.NAME."));
}
