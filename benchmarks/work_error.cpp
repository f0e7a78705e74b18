// Run time against error on problems whose solution is known: by element size, precision, step rule, subcycling,
// hourglass control and penalty scale.

#include "benchmarks/common/program.hpp"
#include "benchmarks/problems/bar_wave.hpp"
#include "benchmarks/problems/graded_pulse.hpp"
#include "benchmarks/problems/hertz_cattaneo.hpp"
#include "benchmarks/problems/rayleigh_pulse.hpp"
#include "case/error.hpp"

namespace railwave::bench {
namespace {

struct Options {
  bool quick = false, smoke = false;
  int repetitions = 2;
  std::string only;
};

struct Problem {
  std::string name;
  Outcome (*solve)(double, const Method&);
  std::vector<double> sizes;  ///< m, coarse to fine
  bool contact;
  double allowed;  ///< error at the coarsest size with the program's own settings
};

std::vector<Problem> problems(const Options& options) {
  const auto sizes = [&](std::vector<double> all, std::size_t quick, std::size_t smoke) {
    if (options.quick) all.resize(quick);
    if (options.smoke) all.resize(smoke);
    return all;
  };
  std::vector<Problem> result = {
      {"bar wave", bar_wave, sizes({2.5e-3, 1.25e-3, 8.333e-4, 6.25e-4, 5e-4}, 3, 1), false, 0.2},
      {"graded pulse", graded_pulse, sizes({2e-3, 1e-3, 6.667e-4}, 2, 1), false, 0.5},
      {"Rayleigh pulse", rayleigh_pulse, sizes({1e-3, 6.25e-4, 5e-4, 3.125e-4, 2.5e-4, 2e-4}, 4, 1), false, 0.5},
      {"Hertz press", hertz_press, sizes({3.3333e-4, 2.5e-4, 1.6667e-4, 1.25e-4}, 2, 1), true, 0.06},
      {"Cattaneo shift", cattaneo_shift, sizes({5e-4, 3.3333e-4, 2.5e-4}, 1, 0), true, 0.2},
  };
  return result;
}

/// One thing changed at a time from the program's own choice, and the changes that go together with it.
std::vector<Method> methods(const Options& options, const Problem& problem) {
  std::vector<Method> result(1);
  const auto add = [&](const auto& change) {
    Method method;
    change(method);
    result.push_back(method);
  };
  const bool settles = problem.solve == hertz_press;  // relaxation has a step of its own
  const bool few = options.smoke || (options.quick && problem.contact);
  for (const char* precision : {"mixed", "float"}) add([&](Method& m) { m.choice.precision = precision; });
  if (problem.solve == graded_pulse) {  // a plane wave meets neither contact nor hourglass modes
    for (const char* precision : {"double", "mixed"})
      add([&](Method& m) {
        m.choice.precision = precision;
        m.subcycling = true;
      });
    return result;
  }
  if (problem.contact) {
    add([](Method& m) { m.penalty_scale = 0.1; });
    add([](Method& m) { m.contact = scene::ContactAlgorithm::multiplier; });
  }
  if (!settles)
    for (const char* rule : {"eigenvalue", "global"}) add([&](Method& m) { m.step_rule = rule; });
  if (options.smoke) return result;
  add([](Method& m) { m.choice.hourglass = "stiffness"; });
  if (few) return result;
  add([](Method& m) {
    m.choice.hourglass = "stiffness";
    m.choice.precision = "mixed";
  });
  if (!settles) {
    for (const char* rule : {"eigenvalue", "global"})
      add([&](Method& m) {
        m.step_rule = rule;
        m.choice.precision = "mixed";
      });
    add([](Method& m) { m.step_scale = 0.6; });
  }
  if (problem.contact) {
    add([](Method& m) { m.penalty_scale = 0.5; });
  } else {
    for (double coefficient : {0.03, 0.15}) add([&](Method& m) { m.hourglass_coefficient = coefficient; });
  }
  return result;
}

/// False when the program's own choice misses what it must reach.
bool solve(const Options& options, const Problem& problem, double size, const Method& method, Records& records) {
  Outcome best;
  try {
    for (int r = 0; r < options.repetitions; ++r) {
      const Outcome outcome = problem.solve(size, method);
      if (r == 0 || outcome.seconds < best.seconds) best = outcome;
      if (outcome.seconds > 5) break;
    }
  } catch (const InputError&) {
    return true;  // not in this build
  }
  const bool multiplier = method.contact == scene::ContactAlgorithm::multiplier;
  fmt::print(
      "{:14} {:6.4f} mm {:6} {:10} {:4.2f} {:9} {:4.2f} {}{}: {:7} elements {:6} steps {:8.3f} s  error {:8.4f} %",
      problem.name, 1e3 * size, method.choice.precision, method.step_rule, method.step_scale, method.choice.hourglass,
      method.hourglass_coefficient, multiplier ? "multiplier" : fmt::format("f_SI {:3.1f}", method.penalty_scale),
      method.subcycling ? " subcycled" : "", best.elements, best.steps, best.seconds, 100 * best.error);
  for (const auto& [name, value] : best.details) fmt::print("  {} {:.4g}", name, value);
  fmt::print("\n");
  std::fflush(stdout);
  auto& row = records.add();
  row.set("problem", problem.name)
      .set("element_size", size)
      .set("precision", method.choice.precision)
      .set("step_rule", method.step_rule)
      .set("step_scale", method.step_scale)
      .set("hourglass", method.choice.hourglass)
      .set("hourglass_coefficient", method.hourglass_coefficient)
      .set("penalty_scale", method.penalty_scale)
      .set("contact", multiplier ? "multiplier" : "penalty")
      .set("subcycling", method.subcycling ? 1 : 0)
      .set("elements", best.elements)
      .set("steps", best.steps)
      .set("seconds", best.seconds)
      .set("error", best.error);
  for (const auto& [name, value] : best.details) row.set(name, value);
  return std::isfinite(best.error) && (method.choice.precision != "double" || best.error < problem.allowed);
}

bool work(const Options& options, Records& records) {
  bool right = true;
  for (const Problem& problem : problems(options)) {
    if (!options.only.empty() && problem.name.find(options.only) == std::string::npos) continue;
    for (double size : problem.sizes)
      for (const Method& method : methods(options, problem)) {
        const bool own = method.penalty_scale == 1 && method.hourglass_coefficient == 0;
        const bool fine = solve(options, problem, size, method, records);
        if (!fine && own) {
          fmt::print("  this error is above {:.0f} %, or no number\n", 100 * problem.allowed);
          right = false;
        }
      }
  }
  return right;
}

}  // namespace
}  // namespace railwave::bench

int main(int argc, char** argv) {
  using namespace railwave::bench;
  Options options;
  return run_program(
      "work_error", "Run time against error on problems with a known solution", argc, argv,
      [&](CLI::App& app) {
        app.add_flag("--quick", options.quick, "coarse meshes only, about a minute");
        app.add_flag("--smoke", options.smoke, "the coarsest meshes and few methods, a few seconds");
        app.add_option("--repetitions", options.repetitions, "runs of each; the quickest counts");
        app.add_option("--only", options.only, "problems whose name holds this");
      },
      [&](Records& records) { return work(options, records); });
}
