// The border of stability as it is seen, against what the program predicts: over hourglass control, penalty scale,
// shape of the elements and precision, by each estimate of the stable step. docs/stability.md says how it is measured.

#include "benchmarks/common/program.hpp"
#include "benchmarks/stability/exact_limit.hpp"
#include "benchmarks/stability/rolling_mesh.hpp"
#include "benchmarks/stability/scenes.hpp"
#include "benchmarks/stability/trial.hpp"
#include "case/error.hpp"
#include "model/time_step/automatic_step.hpp"
#include "model/time_step/stable_step.hpp"

namespace railwave::bench {
namespace {

struct Options {
  bool smoke = false, full_rolling = false;
  long steps = 3000;
  double width = 3e-3;
  std::string only;
};

const std::vector<Control> all_controls = {
    {scene::HourglassType::viscous, 0.1},   {scene::HourglassType::stiffness, 0.05},
    {scene::HourglassType::viscous, 0.03},  {scene::HourglassType::viscous, 0.15},
    {scene::HourglassType::viscous, 0.3},   {scene::HourglassType::stiffness, 0.01},
    {scene::HourglassType::stiffness, 0.2}, {scene::HourglassType::stiffness, 0.5}};

/// What the program would use with step_scale 1, s.
struct Predicted {
  double element, eigenvalue, global, automatic = 0;
};

Predicted predicted_of(Model& model) {
  const StableStep stable = model.stable_step;
  model.scene.time.step_scale = 1;
  const auto used = [&](double limit) {
    model.stable_step.limit = limit;
    return largest_step(model.scene.time, model.stable_step);
  };
  const Predicted predicted{used(stable.by_elements), used(stable.by_eigenvalues), used(stable.global)};
  model.stable_step.limit = stable.limit;
  return predicted;
}

void set_positions(Model& model, const std::vector<double>& positions) {
  if (positions.empty()) return;
  const auto position = to_host(model.nodes.position);
  for (int n = 0; n < model.nodes.count; ++n)
    for (int i = 0; i < 3; ++i) position(n, i) = positions[3 * n + i];
  Kokkos::deep_copy(model.nodes.position, position);
}

scene::Scene with_estimate(scene::Scene scene, scene::StepEstimate estimate) {
  scene.solver.step_estimate = estimate;
  return scene;
}

/// What the default takes in a run so long that any gain pays, s.
/// @param positions m, of the calm state, in which the bodies are about to begin as if they had settled; empty:
/// undeformed
double automatic_step(const Setup& setup, const std::vector<double>& positions) {
  scene::Scene scene = with_estimate(setup.scene, scene::StepEstimate::automatic);
  scene.time.step_scale = 1;
  scene.time.end = 1;
  scene.settle.active = !positions.empty();
  Model model;
  build_model(scene, setup.assembly, model);
  if (!positions.empty()) {
    set_positions(model, positions);
    if (model.global_estimate) renew_automatic_step(model.scene, model.contacts, 0, 0, model);
  }
  return largest_step(model.scene.time, model.stable_step);
}

/// What is known of a scene in double precision, with which those in others share it.
struct Known {
  Predicted predicted;
  double exact;                   ///< s; 0: not computed
  std::vector<double> positions;  ///< m, of the calm state; empty: undeformed
};

struct Named {
  std::string kind, mesh;
  Control control;
  double penalty_scale;
  std::string precision;
};

/// Finds the border, asks whether each prediction itself is calm, and writes it down.
class Map {
 public:
  Map(const Options& options, Records& records) : options_(options), records_(records) {}

  void add(const Named& named, Model& model, const Known& known) {
    Trial trial(model);
    Border border =
        find_border(trial, known.exact > 0 ? known.exact : known.predicted.global, options_.steps, options_.width);
    // What moves fast at any step is not at rest, and has no border.
    if (!(border.calm > 0)) {
      fmt::print("{:7} {:21} {:9} {:5.2f} f_SI {:5.2f} {:6}: not at rest at the beginning; does not count\n",
                 named.kind, named.mesh, named.control.name(), named.control.coefficient, named.penalty_scale,
                 named.precision);
      ++restless_;
      return;
    }
    // Between the two the prediction itself is asked.
    const double predictions[4] = {known.predicted.element, known.predicted.eigenvalue, known.predicted.global,
                                   known.predicted.automatic};
    for (double step : predictions)
      if (step > border.calm && step < border.wild)
        (trial.blows_up(step, options_.steps) ? border.wild : border.calm) = step;
    const double ratio[4] = {predictions[0] / border.calm, predictions[1] / border.calm, predictions[2] / border.calm,
                             predictions[3] / border.calm};
    fmt::print(
        "{:7} {:21} {:9} {:5.2f} f_SI {:5.2f} {:6}: {:5} elements, border {:9.4g} s, exact/border {:6.3f}; "
        "predicted/border: element {:5.3f} "
        "eigenvalue {:5.3f} global {:5.3f} automatic {:5.3f}; in twice the steps {:6.4f}; {} runs\n",
        named.kind, named.mesh, named.control.name(), named.control.coefficient, named.penalty_scale, named.precision,
        model.element_count(), border.calm, known.exact / border.calm, ratio[0], ratio[1], ratio[2], ratio[3],
        border.calm_in_twice / border.calm, trial.runs);
    std::fflush(stdout);
    records_.add()
        .set("kind", named.kind)
        .set("mesh", named.mesh)
        .set("hourglass", named.control.name())
        .set("coefficient", named.control.coefficient)
        .set("penalty_scale", named.penalty_scale)
        .set("precision", named.precision)
        .set("elements", model.element_count())
        .set("calm", border.calm)
        .set("wild", border.wild)
        .set("exact", known.exact)
        .set("element", predictions[0])
        .set("eigenvalue", predictions[1])
        .set("global", predictions[2])
        .set("automatic", predictions[3])
        .set("calm_in_twice", border.calm_in_twice)
        .set("contact", model.stable_step.contact)
        .set("runs", trial.runs);
    for (double each : ratio) right_ = right_ && each <= 1;
    ++scenes_;
  }

  bool wanted(const Named& named) const {
    return options_.only.empty() ||
           fmt::format("{}/{}/{}/{}", named.kind, named.mesh, named.control.name(), named.precision)
                   .find(options_.only) != std::string::npos;
  }
  bool right() const { return right_; }
  int scenes() const { return scenes_; }
  int restless() const { return restless_; }
  const Options& options() const { return options_; }

 private:
  const Options& options_;
  Records& records_;
  bool right_ = true;
  int scenes_ = 0, restless_ = 0;
};

const std::vector<std::string>& precisions(const Options& options, const Control& control) {
  static const std::vector<std::string> one{"double"}, all{"double", "mixed", "float"};
  const bool own = (control.type == scene::HourglassType::viscous && control.coefficient == 0.1) ||
                   (control.type == scene::HourglassType::stiffness && control.coefficient == 0.05);
  return own && !options.smoke ? all : one;
}

void bodies(Map& map) {
  for (const Control& control : all_controls)
    for (const Distortion& distortion : distortions()) {
      if (map.options().smoke && (control.coefficient != 0.1 || distortion.name != "bar")) continue;
      Known known{};
      for (const std::string& precision : precisions(map.options(), control)) {
        const Named named{"body", distortion.name, control, 0, precision};
        if (!map.wanted(named)) continue;
        const Setup setup = body(distortion, control, precision);
        if (known.exact == 0) {
          const Setup plain = body(distortion, control, "double");
          Model model;
          build_model(with_estimate(plain.scene, scene::StepEstimate::global), plain.assembly, model);
          known = {predicted_of(model), ExactLimit(model)(model.stable_step.global), {}};
          known.predicted.automatic = automatic_step(plain, {});
        }
        try {
          Model model;
          build_model(setup.scene, setup.assembly, model);
          map.add(named, model, known);
        } catch (const InputError&) {  // a precision that is not in this build
        }
      }
    }
}

constexpr double pressure = 1e8;  // Pa
/// m/s, of what is left of the way into equilibrium: far below what counts as blown up.
constexpr double slow = 0.01;

Known known_pressed(const Pressing& pressing, const Control& control, double scale) {
  const Setup setup = pressed(pressing, control, scale, pressure, "double");
  Model model;
  build_model(with_estimate(setup.scene, scene::StepEstimate::global), setup.assembly, model);
  // Newton's method settles with stiffness control, which is that of the run or is not.
  if (control.type == scene::HourglassType::stiffness) {
    model.scene.settle.tolerance = 1e-7;
    model.scene.settle.friction = false;  // places are all that trials begin with: no shear is to be held
    if (!settle(model, [](const SettleReport&) { return true; }).settled)
      fmt::print("{}: the blocks do not settle\n", pressing.name);
  } else if (const double left =
                 calm(model, 0.5 * std::fmin(model.stable_step.by_eigenvalues, model.stable_step.global), slow, 20000);
             !(left < 5 * slow)) {
    fmt::print("{}: the blocks do not come to rest, {:.3g} m/s after {} steps\n", pressing.name, left, model.step);
  }
  renew_global_step(model.scene, model.contacts, model.time, model);
  Known known{predicted_of(model), 0, {}};
  known.positions = node_field(model, model.ties, NodeField::position,
                               [&] {
                                 std::vector<int> all(model.nodes.count);
                                 for (int n = 0; n < model.nodes.count; ++n) all[n] = n;
                                 return all;
                               }())
                        .values;
  known.predicted.automatic = automatic_step(setup, known.positions);
  return known;
}

void contacts(Map& map) {
  for (const Pressing& pressing : pressings())
    for (double scale : {1.0, 0.1, 10.0})
      for (const Control& control : {all_controls[0], all_controls[1]}) {
        if (map.options().smoke && (pressing.name != "tall elements" || scale != 1 || control.coefficient != 0.1))
          continue;
        const bool in_all_precisions =
            pressing.name == "matched" || pressing.name == "nodes between nodes" || pressing.name == "with friction";
        Known known{};
        for (const std::string& precision : scale == 1 && in_all_precisions ? precisions(map.options(), control)
                                                                            : std::vector<std::string>{"double"}) {
          const Named named{"contact", pressing.name, control, scale, precision};
          if (!map.wanted(named)) continue;
          if (known.positions.empty()) known = known_pressed(pressing, control, scale);
          try {
            const Setup setup = pressed(pressing, control, scale, pressure, precision);
            Model model;
            build_model(setup.scene, setup.assembly, model);
            set_positions(model, known.positions);
            map.add(named, model, known);
          } catch (const InputError&) {
          }
        }
      }
}

void rolling(Map& map) {
  if (map.options().smoke) return;
  const Named named{"rolling", map.options().full_rolling ? "cases/rolling.toml" : "cases/rolling.toml, short zone",
                    all_controls[0], 1, "double"};
  if (!map.wanted(named)) return;
  const auto scene = rolling_mesh_scene(map.options().full_rolling);
  Model model;
  build_model(scene, model);
  const auto report = settle(model, [](const SettleReport&) { return true; });
  calm(model, 0.5 * model.stable_step.by_eigenvalues, 1e-3, 3000);
  // The springs that count are those of the wheel that is about to roll.
  set_initial_motion(model, model.nodes, model.beams);
  renew_global_step(model.scene, model.contacts, model.time, model);
  Predicted predicted = predicted_of(model);
  // The default's own run begins with the same motion, on the same ground.
  Model own;
  scene::Scene of_default = with_estimate(scene, scene::StepEstimate::automatic);
  of_default.time.step_scale = 1;
  of_default.time.end = 1;
  build_model(of_default, own);
  Kokkos::deep_copy(own.nodes.position, model.nodes.position);
  Kokkos::deep_copy(own.nodes.velocity, model.nodes.velocity);
  if (own.global_estimate) renew_automatic_step(own.scene, own.contacts, 0, 0, own);
  predicted.automatic = largest_step(own.scene.time, own.stable_step);
  Kokkos::deep_copy(model.nodes.velocity, 0.0);
  fmt::print("rolling: settled {} by {} evaluations; {} contact springs counted\n", report.settled, report.steps,
             model.stable_step.springs);
  map.add(named, model, {predicted, 0, {}});
}

bool work(const Options& options, Records& records) {
  Map map(options, records);
  bodies(map);
  contacts(map);
  rolling(map);
  fmt::print("{} scenes, {} more not at rest; {}\n", map.scenes(), map.restless(),
             map.right() ? "no prediction is beyond the border" : "some prediction is beyond the border");
  return map.right();
}

}  // namespace
}  // namespace railwave::bench

int main(int argc, char** argv) {
  using namespace railwave::bench;
  Options options;
  return run_program(
      "stability", "The border of stability, observed against predicted", argc, argv,
      [&](CLI::App& app) {
        app.add_flag("--smoke", options.smoke, "two scenes, a few seconds");
        app.add_flag("--full-rolling", options.full_rolling,
                     "the rolling case as it is, 50 thousand elements, many minutes");
        app.add_option("--steps", options.steps, "steps in which a growth must show");
        app.add_option("--width", options.width, "of the border, relative");
        app.add_option("--only", options.only, "scenes whose kind/mesh/hourglass/precision holds this");
      },
      [&](Records& records) { return work(options, records); });
}
