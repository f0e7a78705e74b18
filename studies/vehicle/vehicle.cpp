// Couples a case of Railwave, in which the wheelset is, with a bogie in Simbody: reads both files, goes on to the
// case's end and writes a table.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling.hpp"
#include "vehicle_table.hpp"

namespace {

using namespace railwave;
using namespace railwave::vehicle;

struct Request {
  std::string case_file, bogie_file, table, curves;
  std::vector<std::string> settings, histories;
  double window = 1e-5;
  CouplingChoice choice;
  long rewind = 0;
};

Request parse(CLI::App& app, int argc, char** argv) {
  Request request;
  app.add_option("CASE", request.case_file, "case file of Railwave")->required();
  app.add_option("BOGIE", request.bogie_file, "the bogie, see studies/vehicle/bogie.toml")->required();
  app.add_option("--out", request.table, "table to write (CSV)")->required();
  app.add_option("--curves", request.curves, "folder for the interface's forces, a CSV curve of each load");
  app.add_option("--set", request.settings, "section.key=value, in place of what the case says");
  app.add_option("--history", request.histories, "histories of the case that the table has too");
  app.add_option("--window", request.window, "s, between samples of the interface")->check(CLI::PositiveNumber);
  app.add_option("--samples", request.choice.samples, "samples of a window that is taken back as one")
      ->check(CLI::Range(1, 1000));
  app.add_option("--tolerance", request.choice.tolerance, "of the forces, over the largest")
      ->check(CLI::Range(1e-15, 1e-2));
  app.add_option("--rewind", request.rewind, "computes the first so many windows twice, and fails if a bit differs")
      ->check(CLI::NonNegativeNumber);
  app.parse(argc, argv);
  request.choice.histories = request.histories;
  return request;
}

/// The case's curves begin with what the bogie presses with at time 0.
std::vector<std::string> settings_of(const Request& request, const BogieData& data, const Bogie& bogie) {
  std::vector<std::string> settings;
  const Vector force = bogie.sample().force;
  for (int i = 0; i < 3; ++i) {
    const std::string& load = data.interface.loads[i];
    char value[40];
    std::snprintf(value, sizeof value, "%.17g", force[i]);
    if (!load.empty()) settings.push_back("curves." + load + ".points=[[0, " + value + "]]");
  }
  settings.insert(settings.end(), request.settings.begin(), request.settings.end());
  return settings;
}

/// The first windows, and again from the state before them.
void check_rewind(Coupling& coupling, long windows) {
  const Coupling::State begin = coupling.save();
  std::vector<std::vector<double>> rows[2];
  for (int time : {0, 1}) {
    if (time == 1) coupling.restore(begin);
    for (long w = 0; w < windows; ++w)
      if (!coupling.advance([&](const CoupledSample& sample) { rows[time].push_back(table_row(sample)); })) break;
  }
  coupling.restore(begin);
  if (rows[0] != rows[1]) throw std::runtime_error("windows that were taken back came out differently");
  std::printf("taken back: the first %ld windows, %zu samples, came out the same bit for bit\n", windows,
              rows[0].size());
}

void run(const Request& request) {
  const BogieData data = read_bogie(request.bogie_file);
  Bogie bogie(data);
  Simulation simulation(request.case_file, request.window, settings_of(request, data, bogie));
  Coupling coupling(simulation, bogie, data.interface, request.choice);
  if (request.rewind > 0) check_rewind(coupling, request.rewind);
  VehicleTable table(simulation, request.histories);
  const auto record = [&table](const CoupledSample& sample) { table.add(sample); };
  record(coupling.sample());
  while (coupling.advance(record)) {
  }
  table.write(request.table);
  if (!request.curves.empty()) table.write_curves(request.curves, data.interface);
  const EnergyClosure closure = table.closure();
  std::printf("%ld windows of %d samples, %.2f iterations each, to %.6g s\n", coupling.windows(),
              request.choice.samples, static_cast<double>(coupling.iterations()) / coupling.windows(),
              simulation.time());
  std::printf("energy over the interface: %.6g J at most, both sides' accounts differ by %.3g of that at most\n",
              closure.largest, closure.difference / closure.largest);
  if (simulation.end() != "completed") throw std::runtime_error("the run has ended: " + simulation.end());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A wheelset in Railwave and a bogie in Simbody, coupled over the primary suspension"};
  try {
    run(parse(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vehicle: error: %s\n", error.what());
    return 1;
  }
  return 0;
}
