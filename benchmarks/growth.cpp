// How the loop's speed and memory go with the number of elements, 10 thousand to 4 million, in each precision.

#include <memory>

#include "benchmarks/common/loop.hpp"
#include "benchmarks/common/program.hpp"
#include "benchmarks/common/scenes.hpp"
#include "case/error.hpp"

namespace railwave::bench {
namespace {

struct Options {
  std::vector<long> elements = {10000, 30000, 100000, 300000, 1000000, 2000000, 4000000};
  int repetitions = 3;
  double seconds = 0.5;
  std::string hourglass = "viscous";
};

/// False when this build has not the precision.
bool time_size(const Options& options, long elements, const std::string& precision, Records& records) {
  Choice choice;
  choice.precision = precision;
  choice.hourglass = options.hourglass;
  const auto model = std::make_unique<Model>();
  double building = 0;
  try {
    building = seconds_of([&] { build_model(block_scene(elements, choice), *model); });
  } catch (const InputError&) {
    return false;
  }
  stir(*model);
  Loop loop(*model);
  const long steps = calls_in(options.seconds, [&] { loop.step(); });
  const Timing timing = repeat(options.repetitions, [&] { loop.steps(steps); });
  const double count = static_cast<double>(model->element_count());
  const double step = timing.best() / static_cast<double>(steps);
  const double bytes = static_cast<double>(device_bytes(*model)) / count;
  fmt::print(
      "{:7} {:8} elements {:10.1f} us a step {:9.2f} M element-steps/s, spread {:4.1f} %, {:.0f} bytes an element, "
      "built in {:.1f} s\n",
      precision, model->element_count(), 1e6 * step, 1e-6 * count / step, 100 * timing.spread(), bytes, building);
  std::fflush(stdout);
  records.add()
      .set("precision", precision)
      .set("hourglass", options.hourglass)
      .set("elements", count)
      .set("nodes", model->node_count())
      .set("steps", steps)
      .set("repetitions", options.repetitions)
      .set("seconds_per_step", step)
      .set("element_steps_per_second", count / step)
      .set("spread", timing.spread())
      .set("device_bytes_per_element", bytes)
      .set("build_seconds", building);
  return true;
}

}  // namespace
}  // namespace railwave::bench

int main(int argc, char** argv) {
  using namespace railwave::bench;
  Options options;
  return run_program(
      "growth", "The loop's speed and memory by number of elements", argc, argv,
      [&](CLI::App& app) {
        app.add_option("--elements", options.elements, "numbers of elements, with commas")->delimiter(',');
        app.add_option("--seconds", options.seconds, "wall seconds a repetition");
        app.add_option("--repetitions", options.repetitions, "timed repetitions");
        app.add_option("--hourglass", options.hourglass, "viscous or stiffness");
      },
      [&](Records& records) {
        for (const char* precision : {"double", "mixed", "float"})
          for (long elements : options.elements)
            if (!time_size(options, elements, precision, records)) {
              fmt::print("{}: not in this build\n", precision);
              break;
            }
        return true;
      });
}
