// The rolling scene in any size: microseconds a step with history every so many steps, the same without any output, and
// a block of as many elements, in turn; then the tasks of a step one by one.

#include <algorithm>
#include <iostream>
#include <memory>

#include "benchmarks/common/loop.hpp"
#include "benchmarks/common/program.hpp"
#include "benchmarks/rolling_scene.hpp"
#include "solve/monitor/account.hpp"
#include "solve/statics/settle.hpp"
#include "solve/stepped_run.hpp"

namespace railwave::bench {
namespace {

struct Options {
  long elements = 0, steps = 2000, output_every = 1000;
  int repetitions = 3;
  int settle_steps = 500;
  double overlap = 1.1e-4;
  bool settle = false, with_block = true;
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

/// The scene, built anew each time.
struct Wheel {
  Wheel(const Options& options, const std::vector<std::string>& overrides) {
    scene::Scene scene = rolling_scene(overrides);
    // The slices that are timed one after another have all the same step.
    scene.solver.step_estimate = scene::StepEstimate::element;
    if (!options.settle) {
      scene.settle.active = options.settle_steps > 0;
      scene.settle.method = scene::SettleMethod::relaxation;
      scene.settle.max_steps = options.settle_steps;
    }
    Assembly assembly = assemble(scene);
    if (!options.settle) press_wheel(scene, assembly, options.overlap);
    build_model(scene, assembly, model);
    model.output_times.history = static_cast<double>(options.output_every) * model.step_size;
    model.output_times.fields = model.scene.time.end;
  }
  Model model;
};

/// Of a run with outputs some steps.
void run_on(Model& model, SteppedRun& run, long steps) {
  for (const long end = model.step + steps; model.step < end;)
    if (!run.go_on()) throw std::runtime_error(run.summary().reason);
}

/// As many elements in a block.
struct Block {
  Block(const Options& options, long elements) {
    Choice choice;
    choice.precision = options.precision;
    build_model(block_scene(elements, choice), model);
    stir(model);
    loop = std::make_unique<Loop>(model);
  }
  double elements() const { return static_cast<double>(model.element_count()); }

  Model model;
  std::unique_ptr<Loop> loop;
};

/// Of those, taken in turn: a machine that others use is as slow for each.
struct Timings {
  Timing run, loop, block;
};

constexpr long steps_of_warm_up = 200;

/// @param wheel of the run, `loop` being of another
Timings time_in_turn(const Options& options, Model& wheel, Observer& observer, Loop& loop, Block* block) {
  wheel.step_count = steps_of_warm_up + options.repetitions * options.steps + 1;
  const std::vector<RunObserver*> observers{&observer};
  SteppedRun run(wheel, observers, nullptr);
  run_on(wheel, run, steps_of_warm_up);
  loop.steps(steps_of_warm_up);
  if (block != nullptr) block->loop->steps(steps_of_warm_up);
  Timings timings;
  for (int r = 0; r < options.repetitions; ++r) {
    timings.run.seconds.push_back(seconds_of([&] { run_on(wheel, run, options.steps); }));
    timings.loop.seconds.push_back(seconds_of([&] { loop.steps(options.steps); }));
    if (block != nullptr) timings.block.seconds.push_back(seconds_of([&] { block->loop->steps(options.steps); }));
  }
  // The last step is sampled.
  while (run.go_on()) {
  }
  return timings;
}

/// How fast something is beside the block in the same turn.
void report_share(Records& records, const std::string& what, double elements, const Timing& timing, const Timing& block,
                  double elements_of_block) {
  Timing shares;
  for (std::size_t r = 0; r < timing.seconds.size(); ++r)
    shares.seconds.push_back((elements / timing.seconds[r]) / (elements_of_block / block.seconds[r]));
  const auto [least, most] = std::minmax_element(shares.seconds.begin(), shares.seconds.end());
  fmt::print("{:28} {:10.3f} of the block's speed, {:.3f} to {:.3f} in {} turns\n", what, shares.median(), *least,
             *most, shares.seconds.size());
  records.add().set("what", what + ", of the block's speed").set("elements", elements).set("share", shares.median());
}

/// @param of what they are, after "task" and "tasks"
template <class Tasks>
void report_tasks(Records& records, const std::string& of, double elements, const Tasks& tasks) {
  double sum = 0;
  for (const auto& entry : tasks) sum += entry.second;
  fmt::print("tasks{}, each with a fence after it, {:.2f} us in all:\n", of, 1e6 * sum);
  for (const auto& [task, seconds] : tasks) {
    fmt::print("  {:10.2f} us  {:4.1f} %  {}\n", 1e6 * seconds, 100 * seconds / sum, task);
    records.add().set("what", "task" + of).set("task", task).set("elements", elements).set("seconds_per_step", seconds);
  }
}

bool work(const Options& options, Records& records) {
  auto overrides = options.elements > 0 ? sizes_for(options.elements) : std::vector<std::string>{};
  overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
  if (options.precision != "double") overrides.push_back("solver.precision=" + options.precision);
  std::string written;
  for (const std::string& override_ : overrides) written += " --set " + override_;
  fmt::print("cases/rolling.toml{}\n", written);

  std::unique_ptr<Wheel> wheel;
  const double building = seconds_of([&] { wheel = std::make_unique<Wheel>(options, overrides); });
  Model& model = wheel->model;
  const double elements = static_cast<double>(model.element_count());
  fmt::print("{} elements, {} nodes, {:.0f} bytes an element, built in {:.1f} s, step {:.3g} s\n",
             model.element_count(), model.node_count(), static_cast<double>(device_bytes(model)) / elements, building,
             model.step_size);
  records.add()
      .set("what", "model")
      .set("elements", elements)
      .set("nodes", model.node_count())
      .set("device_bytes_per_element", static_cast<double>(device_bytes(model)) / elements)
      .set("build_seconds", building)
      .set("step_size", model.step_size)
      .set("precision", options.precision)
      .set("overrides", written);

  // The loop's own, in motion and in contact: a run goes on with its model only.
  Wheel begun(options, overrides);
  begun.model.step_count = steps_of_warm_up;
  if (const RunSummary summary = run(begun.model, {}); !summary.completed) throw std::runtime_error(summary.reason);
  Loop loop(begun.model);
  Observer observer;
  const auto block = options.with_block ? std::make_unique<Block>(options, model.element_count()) : nullptr;
  const Timings timings = time_in_turn(options, model, observer, loop, block.get());
  const std::string run_name = fmt::format("run, output every {}", options.output_every), loop_name = "loop, no output";
  report(records, run_name, elements, options.steps, timings.run);
  fmt::print("{:28} {} nodes touch, {:.1f} kN\n", "contact at the end", observer.touching, 1e-3 * observer.force[2]);
  records.add().set("what", "contact at the end").set("touching", observer.touching).set("force_z", observer.force[2]);
  report(records, loop_name, elements, options.steps, timings.loop);
  if (block) {
    report(records, "block, viscous", block->elements(), options.steps, timings.block);
    report_share(records, run_name, elements, timings.run, timings.block, block->elements());
    report_share(records, loop_name, elements, timings.loop, timings.block, block->elements());
  }
  const long steps_of_tasks = std::min(options.steps, 500L);
  report_tasks(records, "", elements, loop.task_seconds(steps_of_tasks));
  if (block) report_tasks(records, " of the block", block->elements(), block->loop->task_seconds(steps_of_tasks));
  const double account = repeat(options.repetitions, [&] { take_sample(begun.model, begun.model.step_size); }).best();
  fmt::print("  {:10.2f} us  energy account and histories of one output\n", 1e6 * account);
  records.add().set("what", "account").set("elements", elements).set("seconds_per_step", account);

  return observer.touching > 0 && std::isfinite(observer.force[2]) && observer.samples > 0;
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
        app.add_flag("!--no-block", options.with_block, "leave out the block of as many elements");
        app.add_option("--set", options.overrides, "section.key=value in place of what the case says; may be repeated")
            ->allow_extra_args(false);
      },
      [&](Records& records) { return work(options, records); });
}
