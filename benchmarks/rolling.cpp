// The rolling scene in any size: microseconds a step with history every so many steps, the same without any output, and
// the tasks of a step one by one; beside a block of as many elements.

#include <iostream>
#include <memory>

#include "benchmarks/common/loop.hpp"
#include "benchmarks/common/program.hpp"
#include "benchmarks/rolling_scene.hpp"
#include "solve/monitor/account.hpp"
#include "solve/statics/settle.hpp"
#include "solve/time_loop.hpp"

namespace railwave::bench {
namespace {

struct Options {
  long elements = 0, steps = 2000, output_every = 1000;
  int repetitions = 3;
  int settle_steps = 500;
  double overlap = 1.1e-4;
  bool settle = false, block = true;
  std::string precision = "double";
  std::vector<std::string> overrides;
};

/// What a run tells at each output, kept small; the loop works for it as for any other observer.
struct Observer : RunObserver {
  int samples = 0, touching = 0;
  Vec3 force{};
  void history(const Model& /*model*/, const HistorySample& sample) override {
    ++samples;
    for (const ContactTotals& totals : sample.contacts) {
      touching = totals.nodes_in_contact;
      force = totals.normal_force;
    }
  }
};

void report(Records& records, const std::string& what, double elements, long steps, const Timing& timing) {
  const double step = timing.best() / static_cast<double>(steps);
  fmt::print("{:28} {:10.2f} us a step, {:9.2f} M element-steps/s, spread {:.1f} %\n", what, 1e6 * step,
             1e-6 * elements / step, 100 * timing.spread());
  std::fflush(stdout);
  records.add()
      .set("what", what)
      .set("elements", elements)
      .set("steps", steps)
      .set("repetitions", static_cast<int>(timing.seconds.size()))
      .set("seconds_per_step", step)
      .set("element_steps_per_second", elements / step)
      .set("spread", timing.spread());
}

Timing time_run(Model& model, const Options& options, Observer& observer) {
  model.output_times.history = static_cast<double>(options.output_every) * model.step_size;
  model.output_times.fields = model.scene.time.end;
  const auto run_on = [&](long steps) {
    model.step_count = model.step + steps;
    const RunSummary summary = run(model, {&observer});
    if (!summary.completed) throw std::runtime_error(summary.reason);
    // A second call goes on from here: nothing is set in motion again.
    model.scene.settle.active = false;
    model.scene.initial_motions.clear();
  };
  run_on(std::min(options.steps, 200L));
  Timing timing;
  for (int r = 0; r < options.repetitions; ++r) timing.seconds.push_back(seconds_of([&] { run_on(options.steps); }));
  return timing;
}

void time_block(const Options& options, long elements, Records& records) {
  Choice choice;
  choice.precision = options.precision;
  Model model;
  build_model(block_scene(elements, choice), model);
  stir(model);
  Loop loop(model);
  const Timing timing = repeat(options.repetitions, [&] { loop.steps(options.steps); });
  report(records, "block, viscous", static_cast<double>(model.element_count()), options.steps, timing);
}

bool work(const Options& options, Records& records) {
  auto overrides = options.elements > 0 ? sizes_for(options.elements) : std::vector<std::string>{};
  overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
  if (options.precision != "double") overrides.push_back("solver.precision=" + options.precision);
  std::string written;
  for (const std::string& override_ : overrides) written += " --set " + override_;
  fmt::print("cases/rolling.toml{}\n", written);

  auto model = std::make_unique<Model>();
  const double building = seconds_of([&] {
    scene::Scene scene = rolling_scene(overrides);
    // The runs that are timed one after another have all the same step.
    scene.solver.step_estimate = scene::StepEstimate::element;
    if (!options.settle) {
      scene.settle.active = options.settle_steps > 0;
      scene.settle.method = scene::SettleMethod::relaxation;
      scene.settle.max_steps = options.settle_steps;
    }
    Assembly assembly = assemble(scene);
    if (!options.settle) press_wheel(scene, assembly, options.overlap);
    build_model(scene, assembly, *model);
  });
  const double elements = static_cast<double>(model->element_count());
  fmt::print("{} elements, {} nodes, {:.0f} bytes an element, built in {:.1f} s, step {:.3g} s\n",
             model->element_count(), model->node_count(), static_cast<double>(device_bytes(*model)) / elements,
             building, model->step_size);
  records.add()
      .set("what", "model")
      .set("elements", elements)
      .set("nodes", model->node_count())
      .set("device_bytes_per_element", static_cast<double>(device_bytes(*model)) / elements)
      .set("build_seconds", building)
      .set("step_size", model->step_size)
      .set("precision", options.precision)
      .set("overrides", written);

  Observer observer;
  const Timing whole = time_run(*model, options, observer);
  report(records, fmt::format("run, output every {}", options.output_every), elements, options.steps, whole);
  fmt::print("{:28} {} nodes touch, {:.1f} kN\n", "contact at the end", observer.touching, 1e-3 * observer.force[2]);
  records.add().set("what", "contact at the end").set("touching", observer.touching).set("force_z", observer.force[2]);

  Loop loop(*model);
  const Timing bare = repeat(options.repetitions, [&] { loop.steps(options.steps); });
  report(records, "loop, no output", elements, options.steps, bare);
  double sum = 0;
  const auto tasks = loop.task_seconds(std::min(options.steps, 500L));
  for (const auto& entry : tasks) sum += entry.second;
  fmt::print("tasks, each with a fence after it, {:.2f} us in all:\n", 1e6 * sum);
  for (const auto& [task, seconds] : tasks) {
    fmt::print("  {:10.2f} us  {:4.1f} %  {}\n", 1e6 * seconds, 100 * seconds / sum, task);
    records.add().set("what", "task").set("task", task).set("elements", elements).set("seconds_per_step", seconds);
  }
  const double account = repeat(options.repetitions, [&] { take_sample(*model, model->step_size); }).best();
  fmt::print("  {:10.2f} us  energy account and histories of one output\n", 1e6 * account);
  records.add().set("what", "account").set("elements", elements).set("seconds_per_step", account);

  const long count = model->element_count();
  const bool touched = observer.touching > 0 && std::isfinite(observer.force[2]) && observer.samples > 0;
  model.reset();
  if (options.block) time_block(options, count, records);
  return touched;
}

}  // namespace
}  // namespace railwave::bench

int main(int argc, char** argv) {
  using namespace railwave::bench;
  Options options;
  return run_program(
      "rolling", "cases/rolling.toml in any size, step by step", argc, argv,
      [&](CLI::App& app) {
        app.add_option("--elements", options.elements,
                       "about how many, by dividing all element sizes (default: the case's own)");
        app.add_option("--steps", options.steps, "steps a repetition");
        app.add_option("--output-every", options.output_every, "steps between energy accounts and histories");
        app.add_option("--repetitions", options.repetitions, "timed repetitions");
        app.add_option("--precision", options.precision, "double, mixed or float");
        app.add_option("--overlap", options.overlap, "m by which the wheel is pressed into the rail at the start");
        app.add_option("--settle-steps", options.settle_steps,
                       "steps of relaxation after that, so that the block is about as large as under the load");
        app.add_flag("--settle", options.settle, "settle wholly, as the case does, instead");
        app.add_flag("!--no-block", options.block, "leave out the block of as many elements");
        app.add_option("--set", options.overrides, "section.key=value in place of what the case says; may be repeated")
            ->allow_extra_args(false);
      },
      [&](Records& records) { return work(options, records); });
}
