// Element-steps a second of the time loop on a block: by hourglass control, precision and material, beside the baseline
// (one element at a time, atomics) and the memory bandwidth of the same run.

#include <memory>

#include "benchmarks/agreement.hpp"
#include "benchmarks/common/program.hpp"
#include "benchmarks/common/traffic.hpp"
#include "benchmarks/common/triad.hpp"
#include "case/error.hpp"

namespace railwave::bench {
namespace {

struct Options {
  long elements = 0, steps = 0, triad = 128;
  int repetitions = 5;
  double seconds = 1;
  bool baseline = true, only_double = false;
};

/// What is timed once and then compared with.
struct Run {
  Options options;
  double bandwidth = 0;      ///< bytes/s
  double baseline_rate = 0;  ///< element-steps/s
  Records& records;
};

Records::Row& report(Run& run, const std::string& what, const Choice& choice, double elements, long steps,
                     const Timing& timing, double traffic) {
  const double rate = elements * static_cast<double>(steps) / timing.best();
  const double bytes = traffic / elements;
  fmt::print(
      "{:9} {:8} {:10} {:7} {:9.2f} M element-steps/s, {:6.1f} us a step, spread {:4.1f} %, {:5.0f} bytes each, "
      "{:6.1f} GB/s, {:3.0f} % of the triad's",
      what, choice.material, choice.hourglass, choice.precision, 1e-6 * rate, 1e6 * timing.best() / double(steps),
      100 * timing.spread(), bytes, 1e-9 * bytes * rate, 100 * bytes * rate / run.bandwidth);
  if (what == "loop" && run.baseline_rate > 0) fmt::print(", {:.2f} times the baseline", rate / run.baseline_rate);
  fmt::print("\n");
  std::fflush(stdout);
  auto& row = run.records.add();
  row.set("what", what)
      .set("material", choice.material)
      .set("hourglass", choice.hourglass)
      .set("precision", choice.precision);
  row.set("elements", elements).set("steps", steps).set("repetitions", static_cast<int>(timing.seconds.size()));
  row.set("element_steps_per_second", rate).set("seconds_per_step", timing.best() / double(steps));
  row.set("spread", timing.spread()).set("median_seconds_per_step", timing.median() / double(steps));
  row.set("bytes_per_element_step", bytes).set("bandwidth_share", bytes * rate / run.bandwidth);
  if (run.baseline_rate > 0) row.set("times_baseline", rate / run.baseline_rate);
  return row;
}

void time_baseline(Run& run) {
  Model model;
  build_model(block_scene(run.options.elements, {}), model);
  stir(model);
  const Baseline b = build_baseline(model);
  Kokkos::deep_copy(b.velocity, model.nodes.velocity);
  long taken = 0;
  const auto advance_by = [&](long count) {
    baseline_steps(b, model.step_size, taken, count);
    taken += count;
  };
  const long steps = run.options.steps > 0 ? run.options.steps : calls_in(run.options.seconds, [&] { advance_by(1); });
  const Timing timing = repeat(run.options.repetitions, [&] { advance_by(steps); });
  run.baseline_rate = static_cast<double>(b.element_count) * static_cast<double>(steps) / timing.best();
  report(run, "baseline", {}, b.element_count, steps, timing, b.step_traffic());
}

void time_loop(Run& run, const Choice& choice) {
  std::unique_ptr<Model> model = std::make_unique<Model>();
  try {
    build_model(block_scene(run.options.elements, choice), *model);
  } catch (const InputError&) {
    fmt::print("loop      {:8} {:10} {:7} not in this build\n", choice.material, choice.hourglass, choice.precision);
    return;
  }
  stir(*model);
  Loop loop(*model);
  const double elements = static_cast<double>(model->element_count());
  const long steps = run.options.steps > 0 ? run.options.steps : calls_in(run.options.seconds, [&] { loop.step(); });
  const Timing timing = repeat(run.options.repetitions, [&] { loop.steps(steps); });
  auto& row = report(run, "loop", choice, elements, steps, timing, step_traffic(*model));
  row.set("device_bytes_per_element", static_cast<double>(device_bytes(*model)) / elements);

  for (const auto& [task, seconds] : loop.task_seconds(std::max(1L, steps))) {
    fmt::print("          {:8.1f} us  {}\n", 1e6 * seconds, task);
    run.records.add()
        .set("what", "task")
        .set("task", task)
        .set("material", choice.material)
        .set("hourglass", choice.hourglass)
        .set("precision", choice.precision)
        .set("elements", elements)
        .set("seconds_per_step", seconds);
  }
}

bool work(Run& run) {
  if (run.options.elements == 0) run.options.elements = host_threads() == 0 ? 4096000 : 262144;
  const Agreement agreement = compare_on_a_bar_wave();
  fmt::print("bar wave: product and baseline differ by {:.3f} %; from the exact solution by {:.2f} % and {:.2f} %\n",
             100 * agreement.difference, 100 * agreement.product_error, 100 * agreement.baseline_error);
  run.records.add()
      .set("what", "agreement")
      .set("difference", agreement.difference)
      .set("product_error", agreement.product_error)
      .set("baseline_error", agreement.baseline_error);

  run.bandwidth = triad_bandwidth(std::max(3, run.options.repetitions), run.options.triad);
  fmt::print("triad: {:.1f} GB/s\n", 1e-9 * run.bandwidth);
  run.records.add().set("what", "triad").set("bytes_per_second", run.bandwidth);
  if (run.options.baseline) time_baseline(run);
  for (const char* material : {"elastic", "bilinear"})
    for (const char* hourglass : {"viscous", "stiffness"})
      for (const char* precision : {"double", "mixed", "float"})
        if (!run.options.only_double || std::string(precision) == "double")
          time_loop(run, {hourglass, precision, material});
  return agreement.difference < 0.01 && agreement.product_error < 0.05 && agreement.baseline_error < 0.05;
}

}  // namespace
}  // namespace railwave::bench

int main(int argc, char** argv) {
  using namespace railwave::bench;
  Options options;
  return run_program(
      "throughput", "Element-steps a second of the time loop on a block of hexahedra", argc, argv,
      [&](CLI::App& app) {
        app.add_option("--elements", options.elements,
                       "about how many (default: 262144 on a host, 4096000 on a device)");
        app.add_option("--steps", options.steps, "steps a repetition (default: as many as take --seconds)");
        app.add_option("--seconds", options.seconds, "wall seconds a repetition");
        app.add_option("--repetitions", options.repetitions, "timed repetitions");
        app.add_option("--triad", options.triad, "MiB of each of the triad's three arrays");
        app.add_flag("!--no-baseline", options.baseline, "leave the baseline out");
        app.add_flag("--only-double", options.only_double, "double precision only");
      },
      [&](Records& records) {
        Run run{options, 0, 0, records};
        return work(run);
      });
}
