// What leaving things out of a scene saves: the rolling scene whole, then without one thing after the other, and how
// the step's cost goes with the frequency of the energy account.

#include <memory>

#include "benchmarks/common/loop.hpp"
#include "benchmarks/common/program.hpp"
#include "benchmarks/rolling_scene.hpp"
#include "case/error.hpp"
#include "solve/monitor/account.hpp"
#include "solve/statics/settle.hpp"

namespace railwave::bench {
namespace {

struct Options {
  long elements = 0;
  int repetitions = 5, settle_steps = 200;
  double seconds = 0.5, overlap = 1.1e-4;
};

struct Variant {
  std::string name;
  std::vector<std::string> overrides;
  std::function<void(scene::Scene&)> change;
};

std::vector<Variant> variants() {
  using scene::Scene;
  const auto keep = [](Scene&) {};
  const auto bare = [](Scene& s) {
    s.contacts.clear();
    s.gravity = {0, 0, 0};
    s.loads.clear();
    s.connectors.clear();
    s.constraints.clear();
  };
  return {
      {"whole scene", {}, keep},
      {"without friction", {}, [](Scene& s) { s.contacts[0].friction = 0; }},
      {"without contact", {}, [](Scene& s) { s.contacts.clear(); }},
      {"without gravity",
       {},
       [](Scene& s) {
         s.gravity = {0, 0, 0};
       }},
      {"without loads", {}, [](Scene& s) { s.loads.clear(); }},
      {"without connectors", {}, [](Scene& s) { s.connectors.clear(); }},
      {"without constraints", {}, [](Scene& s) { s.constraints.clear(); }},
      {"elements and nodes alone", {}, bare},
      {"stiffness instead of viscous hourglass",
       {"parts.wheel.hourglass=stiffness", "parts.rail.hourglass=stiffness"},
       keep},
      {"stiffness, elements and nodes alone",
       {"parts.wheel.hourglass=stiffness", "parts.rail.hourglass=stiffness"},
       bare},
      {"mixed instead of double precision", {"solver.precision=mixed"}, keep},
      {"coarse regions subcycled", {"solver.subcycling=true"}, keep},
      {"with a non-reflecting end",
       {},
       [](Scene& s) {
         s.non_reflecting.push_back({{"far", 0}, "rail.start_face"});
       }},
      {"with plasticity", {"materials.steel.yield_stress=500e6", "materials.steel.tangent_modulus=21e9"}, keep},
  };
}

/// A scene of its own with its loop.
struct Prepared {
  std::string name;
  Model model;
  std::unique_ptr<Loop> loop;
  Timing timing;
};

/// Null where this build has not what the variant wants.
/// @param assembly made with the contact, so that the wheel stands where it stands in every variant
std::unique_ptr<Prepared> prepare(const Options& options, const std::vector<std::string>& sizes,
                                  const Assembly& assembly, const Variant& variant) {
  auto overrides = sizes;
  overrides.insert(overrides.end(), variant.overrides.begin(), variant.overrides.end());
  auto prepared = std::make_unique<Prepared>();
  prepared->name = variant.name;
  try {
    scene::Scene scene = rolling_scene(overrides);
    scene.settle.method = scene::SettleMethod::relaxation;
    scene.settle.max_steps = options.settle_steps;
    variant.change(scene);
    build_model(scene, assembly, prepared->model);
  } catch (const InputError&) {
    return nullptr;
  }
  settle(prepared->model, [](const SettleReport&) { return true; });
  set_initial_motion(prepared->model, prepared->model.nodes, prepared->model.beams);
  prepared->loop = std::make_unique<Loop>(prepared->model);
  return prepared;
}

void time_accounts(const Options& options, Prepared& whole, long steps, Records& records) {
  const double bare = whole.timing.best() / static_cast<double>(steps);
  for (long every : {1L, 10L, 100L, 1000L}) {
    if (every > 20 * steps) break;  // a smoke test
    const long rounds = std::max(1L, steps / every);
    const Timing timing = repeat(options.repetitions, [&] {
      for (long r = 0; r < rounds; ++r) {
        whole.loop->steps(every - 1);
        whole.loop->sampled_step([&] { take_sample(whole.model, whole.model.step_size); });
      }
    });
    const double step = timing.best() / static_cast<double>(rounds * every);
    const std::string name = fmt::format("account every {} step{}", every, every == 1 ? "" : "s");
    fmt::print("{:42} {:9.2f} us a step, {:+6.1f} %, spread {:.1f} %\n", name, 1e6 * step, 100 * (step / bare - 1),
               100 * timing.spread());
    records.add()
        .set("what", name)
        .set("seconds_per_step", step)
        .set("saving", 1 - step / bare)
        .set("spread", timing.spread());
  }
}

bool work(const Options& options, Records& records) {
  const auto sizes = options.elements > 0 ? sizes_for(options.elements) : std::vector<std::string>{};
  const scene::Scene original = rolling_scene(sizes);
  Assembly assembly = assemble(original);
  press_wheel(original, assembly, options.overlap);
  std::vector<std::unique_ptr<Prepared>> all;
  for (const Variant& variant : variants()) {
    auto prepared = prepare(options, sizes, assembly, variant);
    if (prepared)
      all.push_back(std::move(prepared));
    else
      fmt::print("{}: not in this build\n", variant.name);
  }
  Prepared& whole = *all.front();
  const long steps = calls_in(options.seconds, [&] { whole.loop->step(); });
  // In turns, so that a disturbance meets all alike.
  for (auto& prepared : all) prepared->loop->steps(steps / 4 + 1);
  for (int r = 0; r < options.repetitions; ++r)
    for (auto& prepared : all) prepared->timing.seconds.push_back(seconds_of([&] { prepared->loop->steps(steps); }));

  const double reference = whole.timing.best();
  fmt::print("{} elements, {} steps a repetition\n", whole.model.element_count(), steps);
  for (const auto& prepared : all) {
    const double step = prepared->timing.best() / static_cast<double>(steps);
    const double saving = 1 - prepared->timing.best() / reference;
    fmt::print("{:42} {:9.2f} us a step, saves {:5.1f} %, spread {:.1f} %\n", prepared->name, 1e6 * step, 100 * saving,
               100 * prepared->timing.spread());
    records.add()
        .set("what", prepared->name)
        .set("elements", prepared->model.element_count())
        .set("steps", steps)
        .set("repetitions", options.repetitions)
        .set("seconds_per_step", step)
        .set("saving", saving)
        .set("spread", prepared->timing.spread());
  }
  time_accounts(options, whole, steps, records);
  return true;
}

}  // namespace
}  // namespace railwave::bench

int main(int argc, char** argv) {
  using namespace railwave::bench;
  Options options;
  return run_program(
      "omissions", "What a scene saves by what it leaves out", argc, argv,
      [&](CLI::App& app) {
        app.add_option("--elements", options.elements, "about how many (default: the case's own)");
        app.add_option("--repetitions", options.repetitions, "timed repetitions");
        app.add_option("--seconds", options.seconds, "wall seconds a repetition of the whole scene");
        app.add_option("--settle-steps", options.settle_steps, "steps of relaxation before");
        app.add_option("--overlap", options.overlap, "m by which the wheel is pressed into the rail at the start");
      },
      [&](Records& records) { return work(options, records); });
}
