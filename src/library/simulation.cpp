#include "library/simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/error.hpp"
#include "case/read_case.hpp"
#include "library/listener.hpp"
#include "mesh/contact_zone.hpp"
#include "model/assembly.hpp"
#include "output/output_sets.hpp"
#include "output/settled_file.hpp"
#include "solve/stepped_run.hpp"

namespace railwave {

namespace {

/// For the rest of the process: arrays of simulations may outlive everything else that could end it.
void begin_kokkos() {
  if (Kokkos::is_initialized()) return;
  setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);
  Kokkos::initialize();
}

std::string among(const std::vector<std::string>& names) {
  return names.empty() ? "there are none" : fmt::format("known are {}", fmt::join(names, ", "));
}

scene::Scene scene_of(const std::string& case_file, double window, const std::vector<std::string>& settings) {
  if (!(window > 0)) throw InputError(fmt::format("a simulation's window is {} s; a time above 0 is wanted", window));
  scene::Scene scene = read_case(case_file, settings);
  place_contact_zones(scene);
  scene.output.history_interval = window;
  return scene;
}

}  // namespace

struct SimulationState::Kept {
  RunState run;
  HistorySample sample;
  std::vector<scene::Curve> curves;
  std::vector<std::vector<double>> fields;
  std::string end;
};

SimulationState::SimulationState() = default;
SimulationState::~SimulationState() = default;
SimulationState::SimulationState(SimulationState&&) noexcept = default;
SimulationState& SimulationState::operator=(SimulationState&&) noexcept = default;

struct Simulation::Run {
  Run(const std::string& case_file, double the_window, const std::vector<std::string>& settings) : window(the_window) {
    const scene::Scene scene = scene_of(case_file, window, settings);
    begin_kokkos();
    std::vector<std::string> notes;
    build_model(scene, assemble(scene, notes), model);
    histories = named_histories(model);
    sets = resolve_output_sets(model.scene, model.assembly);
    listener.fields = asked_fields(model.scene.output, sets);
    loop = std::make_unique<SteppedRun>(model, std::vector<RunObserver*>{&listener}, &settled);
    advance();
  }

  bool advance() {
    const long before = listener.samples;
    while (end.empty() && listener.samples == before)
      if (!loop->go_on()) {
        const RunSummary summary = loop->summary();
        end = summary.completed ? "completed" : summary.reason;
      }
    return end.empty();
  }

  const AskedField& field(const std::string& name, const std::string& set) const {
    std::vector<std::string> names;
    for (const AskedField& one : listener.fields) {
      if (one.row->name == name && one.set->name == set) return one;
      names.push_back(fmt::format("{} of {}", one.row->name, one.set->name));
    }
    throw InputError(fmt::format("the case's output.fields and output.field_sets do not ask for {} of {}: {}", name,
                                 set, among(names)));
  }

  double window;
  Model model;
  Listener listener;
  SettledFiles settled{RAILWAVE_VERSION};
  std::vector<NamedHistory> histories;
  std::vector<OutputSet> sets;
  std::unique_ptr<SteppedRun> loop;
  std::string end;
};

Simulation::Simulation(const std::string& case_file, double window, const std::vector<std::string>& settings)
    : run_(std::make_unique<Run>(case_file, window, settings)) {}

Simulation::~Simulation() = default;

double Simulation::time() const { return run_->listener.sample.time; }

double Simulation::window() const { return run_->window; }

bool Simulation::advance() {
  if (!run_->end.empty()) throw std::runtime_error("the simulation has ended: " + run_->end);
  return run_->advance();
}

std::string Simulation::end() const { return run_->end; }

void Simulation::drive(const std::string& curve, double value) {
  if (!std::isfinite(value))
    throw InputError(fmt::format("the curve {} is to be driven to {}; a finite number is wanted", curve, value));
  std::vector<std::string> names;
  for (scene::Curve& one : run_->model.scene.curves) {
    if (one.type == scene::CurveType::table) names.push_back(one.name);
    if (one.name != curve) continue;
    if (one.type != scene::CurveType::table)
      throw InputError(fmt::format("the curve {} cannot be driven: only those of type = \"table\" can", curve));
    const double now = time(), present = curve_value(&one, now);
    while (!one.points.empty() && one.points.back()[0] >= now) one.points.pop_back();
    one.points.push_back({now, present});
    one.points.push_back({run_->loop->next_history(), value});
    run_->loop->inputs_changed();
    return;
  }
  throw InputError(fmt::format("the case has no curve {} of type = \"table\": {}", curve, among(names)));
}

std::vector<double> Simulation::values(const std::string& history) const {
  const auto& known = run_->histories;
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const NamedHistory& one) { return one.name == history; });
  if (found == known.end()) throw InputError(fmt::format("there is no history {}: {}", history, among(histories())));
  return found->values(run_->listener.sample);
}

std::vector<std::string> Simulation::histories() const {
  std::vector<std::string> names;
  for (const NamedHistory& one : run_->histories) names.push_back(one.name);
  return names;
}

const std::vector<double>& Simulation::field(const std::string& name, const std::string& set) const {
  return run_->field(name, set).values;
}

int Simulation::field_components(const std::string& name) const {
  const FieldRow* row = find_field(name);
  if (row == nullptr) throw InputError("there is no field " + name);
  return row->components;
}

const std::vector<double>& Simulation::coordinates(const std::string& set) const {
  std::vector<std::string> names;
  for (const OutputSet& one : run_->sets) {
    if (one.name == set) return one.coordinates;
    names.push_back(one.name);
  }
  throw InputError(fmt::format("the case's output.field_sets do not name {}: {}", set, among(names)));
}

SimulationState Simulation::save() {
  SimulationState state;
  state.kept_ = std::make_unique<SimulationState::Kept>();
  SimulationState::Kept& kept = *state.kept_;
  kept.run = run_->loop->state();
  kept.sample = run_->listener.sample;
  kept.curves = run_->model.scene.curves;
  for (const AskedField& field : run_->listener.fields) kept.fields.push_back(field.values);
  kept.end = run_->end;
  return state;
}

void Simulation::restore(const SimulationState& state) {
  if (state.kept_ == nullptr) throw std::runtime_error("a state that holds nothing cannot be restored");
  const SimulationState::Kept& kept = *state.kept_;
  run_->loop->take_up(kept.run);
  run_->listener.sample = kept.sample;
  for (std::size_t c = 0; c < kept.curves.size(); ++c)  // in place: loads know where they are
    run_->model.scene.curves[c].points = kept.curves[c].points;
  for (std::size_t f = 0; f < kept.fields.size(); ++f) run_->listener.fields[f].values = kept.fields[f];
  run_->end = kept.end;
}

}  // namespace railwave
