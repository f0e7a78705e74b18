// railwave signal: what it prints and writes of a run whose motion is known, and what it refuses.

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "case/error.hpp"
#include "post/signal_command.hpp"
#include "tests/output/made_up_run.hpp"

using namespace railwave;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double interval = 1e-6, speed = 3000, tone = 40e3;

/// A burst that runs along the row rail.p_1 to rail.p_16, 5 mm apart: z is (0.3 m/s) cos, x two thirds of it and ahead
/// by a quarter, backwards at the top; and a set "mass" that stands still.
void write_run(const std::string& path, bool with_positions = true) {
  RunDescription description = made_up::description();
  description.history_sets.clear();
  for (int p = 1; p <= 16; ++p) {
    description.history_sets.push_back("rail.p_" + std::to_string(p));
    if (with_positions) description.history_positions.push_back({0.005 * p, 0.1, 0});
  }
  description.history_sets.push_back("mass");
  if (with_positions) description.history_positions.push_back({0, 0, 0});
  ResultsWriter writer(path, description);
  for (int n = 0; n < 400; ++n) {
    HistorySample sample = made_up::sample(n);
    sample.time = interval * n;
    sample.sets.clear();
    for (int p = 1; p <= 16; ++p) {
      const double t = sample.time - 1.5e-4 - 0.005 * p / speed, size = 0.3 * std::exp(-t * t / (4e-5 * 4e-5));
      MeanMotion motion;
      motion.velocity = {2.0 / 3 * size * std::cos(2 * M_PI * tone * t + M_PI / 2), 0,
                         size * std::cos(2 * M_PI * tone * t)};
      sample.sets.push_back(motion);
    }
    sample.sets.emplace_back();
    writer.history(sample);
  }
  writer.end(made_up::summary());
}

struct Run {
  made_up::TemporaryFolder folder;
  SignalRequest request;
  explicit Run(SignalKind kind, std::vector<std::string> channels) {
    write_run(folder / "run.h5");
    request.kind = kind;
    request.results = folder / "run.h5";
    request.channels = std::move(channels);
    request.csv = folder / "out.csv";
    request.hdf5 = folder / "out.h5";
  }
  std::string text() const {
    std::ostringstream out;
    REQUIRE(signal_command(request, out) == 0);
    return out.str();
  }
  std::string complaint() const {
    std::ostringstream out;
    try {
      signal_command(request, out);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  std::string heading() const {
    std::ifstream file(*request.csv);
    std::string line;
    std::getline(file, line);
    return line;
  }
  double figure(const std::string& name) const { return hdf5::File::open(*request.hdf5).root().number_attribute(name); }
  std::vector<double> column(const std::string& table, const std::string& name) const {
    return hdf5::File::open(*request.hdf5).root().group(table).dataset(name).read<double>();
  }
};

}  // namespace

TEST_CASE("the spectrum's integral is the mean square, and its peak the tone") {
  Run run(SignalKind::psd, {"rail.p_1.velocity.z", "rail.p_2.velocity.z"});
  run.request.window = "rectangular";
  run.request.segment = 400e-6;
  CHECK_THAT(run.text(), ContainsSubstring("1 segment of 400 samples"));
  CHECK(run.heading() == "frequency [Hz],rail.p_1.velocity.z [(m/s)2/Hz],rail.p_2.velocity.z [(m/s)2/Hz]");
  const auto frequency = run.column("psd", "frequency"), density = run.column("psd", "rail.p_1.velocity.z");
  double sum = 0;
  for (const double value : density) sum += value * frequency[1];
  // Mean over 400 us of (0.3 exp(-(t/b)^2) cos)^2, b = 40 us: half the envelope's square.
  CHECK_THAT(sum, WithinRel(0.5 * 0.09 * 4e-5 * std::sqrt(M_PI / 2) / 4e-4, 0.01));
  CHECK(frequency[std::max_element(density.begin(), density.end()) - density.begin()] == tone);
}

TEST_CASE("the wavelet finds the burst in time and frequency") {
  Run run(SignalKind::wavelet, {"rail.p_6.velocity.z"});
  run.request.low = 15e3;
  run.request.scale_spacing = 0.0625;
  CHECK_THAT(run.text(), ContainsSubstring("scales from"));
  const hdf5::File file = hdf5::File::open(*run.request.hdf5);
  const auto power = file.root().dataset("power").read<double>();
  const auto frequency = run.column("by_frequency", "frequency");
  const auto at = std::max_element(power.begin(), power.end()) - power.begin();
  CHECK_THAT(frequency[at / 400], WithinRel(tone, 0.05));
  CHECK_THAT(static_cast<double>(at % 400) * interval, WithinAbs(1.5e-4 + 0.03 / speed, 2e-6));
  // The mean of the power in the band is the mean square.
  double mean = 0, square = run.figure("variance");
  for (const double value : run.column("by_time", "band_power")) mean += value / 400;
  CHECK_THAT(mean, WithinRel(square, 0.02));
  run.request.channels = {"rail.p_*.velocity.z"};
  CHECK_THAT(run.complaint(), ContainsSubstring("16 channels are named, a wavelet takes one"));
  run.request.average = true;
  CHECK(run.complaint() == "no complaint");
  run.request.channels = {"mass.velocity.z"};
  CHECK_THAT(run.complaint(), ContainsSubstring("does not change"));
}

TEST_CASE("a band of a history as a table") {
  Run run(SignalKind::bandpass, {"rail.p_6.velocity.z"});
  run.request.low = 80e3;
  run.request.order = 8;
  run.text();
  CHECK(run.heading() == "time [s],rail.p_6.velocity.z [m/s]");
  const auto above = run.column("bandpass", "rail.p_6.velocity.z");
  CHECK(*std::max_element(above.begin(), above.end()) < 1e-3);
  run.request.low = 0;
  CHECK_THAT(run.complaint(), ContainsSubstring("a band is wanted"));
}

TEST_CASE("phase and coherence over pairs, and the ellipse, backwards at the top") {
  Run run(SignalKind::cross, {"rail.p_*.velocity.x", "rail.p_*.velocity.z"});
  run.request.low = 30e3;
  run.request.high = 50e3;
  CHECK_THAT(run.text(), ContainsSubstring("16 segments of 400 samples, of 16 pairs"));
  CHECK_THAT(run.figure("band_phase"), WithinRel(-90.0, 0.01));
  CHECK_THAT(run.figure("band_coherence"), WithinRel(1.0, 0.01));

  run.request.kind = SignalKind::ellipse;
  run.request.low = 15e3;  // all of the burst
  run.request.high = 90e3;
  run.request.hdf5 = run.folder / "ellipse.h5";
  run.request.csv = run.folder / "ellipse.csv";
  CHECK_THAT(run.text(), ContainsSubstring("retrograde: 16 of 16"));
  CHECK_THAT(run.column("ellipse", "semi_axis_major")[3], WithinRel(0.3, 0.02));
  CHECK_THAT(run.column("ellipse", "semi_axis_minor")[3], WithinRel(0.2, 0.02));
  CHECK_THAT(run.column("ellipse", "amplitude_ratio")[3], WithinRel(1.5, 0.01));
  // Seen from the other side it runs forwards.
  run.request.channels[0] = "rail.p_*.velocity.-1,0,0";
  CHECK_THAT(run.text(), ContainsSubstring("retrograde: 0 of 16"));
  run.request.channels[1] = "rail.p_1.velocity.z";
  CHECK_THAT(run.complaint(), ContainsSubstring("finds 16 channels"));
  run.request.channels.pop_back();
  CHECK_THAT(run.complaint(), ContainsSubstring("1 --channel are given, two are wanted"));
}

TEST_CASE("the speed along the row, which needs to know where it is") {
  Run run(SignalKind::speed, {"rail.p_*.velocity.z"});
  run.request.low = 20e3;
  run.request.high = 60e3;
  CHECK_THAT(run.text(), ContainsSubstring("16 probes over 0.075 m along 1,0,0"));
  CHECK_THAT(run.figure("time_of_flight_speed"), WithinRel(speed, 0.002));
  CHECK_THAT(run.figure("wavenumber_speed"), WithinRel(speed, 0.01));
  CHECK_THAT(run.column("probes", "lag").back(), WithinRel(0.075 / speed, 0.002));
  run.request.channels = {"rail.p_1.velocity.z", "rail.p_2.velocity.z"};
  CHECK_THAT(run.complaint(), ContainsSubstring("four sets in a row"));
  write_run(run.request.results, false);
  run.request.channels = {"rail.p_*.velocity.z"};
  CHECK_THAT(run.complaint(), ContainsSubstring("is not known"));
}

TEST_CASE("files are not lost, and mistakes are reported") {
  Run run(SignalKind::psd, {"rail.p_1.velocity.z"});
  run.request.hdf5 = run.request.results;
  CHECK_THAT(run.complaint(), ContainsSubstring("is the results file, which this command reads"));
  write_run(run.folder / "other.h5");
  run.request.hdf5 = run.folder / "other.h5";
  CHECK_THAT(
      run.complaint(),
      ContainsSubstring("is there already and is a file 'Railwave results', not a file of 'railwave signal --hdf5'"));
  run.request.hdf5.reset();
  run.request.csv = run.folder / "other.h5";
  CHECK_THAT(run.complaint(), ContainsSubstring("not a table of 'railwave signal psd --csv'"));
  run.request.csv.reset();
  run.request.window = "han";
  CHECK_THAT(run.complaint(), ContainsSubstring("did you mean 'hann'?"));
  run.request.window = "hann";
  run.request.trend = "lin";
  CHECK_THAT(run.complaint(), ContainsSubstring("did you mean 'line'?"));
  run.request.trend = "mean";
  run.request.segment = 1;
  CHECK_THAT(run.complaint(), ContainsSubstring("cannot be cut"));
  run.request.segment = 0;
  run.request.low = 5;
  run.request.high = 2;
  CHECK_THAT(run.complaint(), ContainsSubstring("--low 5 --high 2"));
  run.request.low = run.request.high = 0;
  run.request.channels.clear();
  CHECK_THAT(run.complaint(),
             ContainsSubstring("there are SET.(displacement|velocity|acceleration) of rail.p_1, rail.p_2") ||
                 ContainsSubstring("has SET."));
}
