#include "coupling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace railwave::vehicle {

/// What one iteration of a window found.
struct Coupling::Window {
  std::vector<InterfaceMotion> path;           ///< the begin and each sample, from the undeformed place
  std::vector<double> work;                    ///< J on the wheelset, at each sample
  std::vector<std::vector<double>> histories;  ///< at each sample
  std::vector<BogieSample> bogie;              ///< at each sample
};

namespace {

double largest_of(const std::vector<BogieSample>& samples) {
  double largest = 0;
  for (const BogieSample& sample : samples)
    for (double force : sample.force) largest = std::max(largest, std::fabs(force));
  return largest;
}

}  // namespace

Coupling::Coupling(Simulation& simulation, Bogie& bogie, const Interface& interface, const CouplingChoice& choice)
    : simulation_(simulation), bogie_(bogie), interface_(interface), choice_(choice), start_(motion()) {
  bogie_.start(interface_.loads[0].empty() ? 0 : start_.velocity[0]);
  work_at_start_ = work_on_wheelset();
  const BogieSample first = bogie_.sample();
  energy_at_start_ = first.energy + first.dissipated;
  times_ = {simulation_.time()};
  forces_ = {first.force};
  largest_ = largest_of({first});
}

InterfaceMotion Coupling::motion() const {
  InterfaceMotion now;
  now.time = simulation_.time();
  const auto place = simulation_.values("set." + interface_.set + ".displacement");
  const auto speed = simulation_.values("set." + interface_.set + ".velocity");
  for (int i = 0; i < 3; ++i) {
    now.displacement[i] = place[i];
    now.velocity[i] = speed[i];
  }
  return now;
}

/// The motion since the start, along the coupled directions.
InterfaceMotion Coupling::for_bogie(const InterfaceMotion& motion) const {
  InterfaceMotion moved;
  moved.time = motion.time;
  for (int i = 0; i < 3; ++i) {
    if (interface_.loads[i].empty()) continue;
    moved.displacement[i] = motion.displacement[i] - start_.displacement[i];
    moved.velocity[i] = motion.velocity[i];
  }
  return moved;
}

std::vector<double> Coupling::histories() const {
  std::vector<double> all;
  for (const std::string& name : choice_.histories) {
    const std::vector<double> values = simulation_.values(name);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

double Coupling::work_on_wheelset() const {
  double work = 0;
  for (const std::string& load : interface_.loads)
    if (!load.empty()) work += simulation_.values("load." + load + ".work")[0];
  return work;
}

/// Forces at the samples to come, on the parabola through the last three of the past.
std::vector<Vector> Coupling::guess() const {
  const double step = simulation_.window(), now = times_.back();
  std::vector<Vector> forces(choice_.samples, Vector{});
  for (int k = 0; k < choice_.samples; ++k) {
    const double time = now + (k + 1) * step;
    for (std::size_t a = 0; a < times_.size(); ++a) {
      double share = 1;  // Lagrange's polynomial
      for (std::size_t b = 0; b < times_.size(); ++b)
        if (b != a) share *= (time - times_[b]) / (times_[a] - times_[b]);
      for (int i = 0; i < 3; ++i) forces[k][i] += share * forces_[a][i];
    }
  }
  return forces;
}

/// The wheelset's motion under forces at the samples, and their work.
void Coupling::run_wheelset(Window& window, const std::vector<Vector>& forces) {
  window.path = {motion()};
  window.work.clear();
  window.histories.clear();
  for (const Vector& force : forces) {
    if (!simulation_.end().empty()) return;
    for (int i = 0; i < 3; ++i)
      if (!interface_.loads[i].empty()) simulation_.drive(interface_.loads[i], force[i]);
    simulation_.advance();
    if (simulation_.time() <= window.path.back().time) return;
    window.path.push_back(motion());
    window.work.push_back(work_on_wheelset());
    window.histories.push_back(histories());
  }
}

/// N, the largest between what acted on the wheelset and what the bogie answers.
double Coupling::difference(const Window& window, const std::vector<Vector>& forces) const {
  double largest = 0;
  for (std::size_t k = 0; k < window.bogie.size(); ++k)
    for (int i = 0; i < 3; ++i)
      if (!interface_.loads[i].empty()) largest = std::max(largest, std::fabs(window.bogie[k].force[i] - forces[k][i]));
  return largest;
}

bool Coupling::advance(const Record& record) {
  if (!simulation_.end().empty()) return false;
  const SimulationState wheelset_begin = simulation_.save();
  const BogieState bogie_begin = bogie_.save();
  std::vector<Vector> forces = guess();
  Window window;
  double first = 0;  ///< N, difference of the first iteration
  for (int iteration = 1;; ++iteration) {
    run_wheelset(window, forces);
    if (window.work.empty()) return false;
    std::vector<InterfaceMotion> path;
    for (const InterfaceMotion& sample : window.path) path.push_back(for_bogie(sample));
    window.bogie = bogie_.follow(MotionPath(path));
    ++iterations_;
    const double differ = difference(window, forces), largest = std::max(largest_, largest_of(window.bogie));
    if (differ <= choice_.tolerance * largest) {
      largest_ = largest;
      break;
    }
    if (iteration == 1) first = differ;
    constexpr double diverged = 100;
    if (iteration >= choice_.most_iterations || !(differ <= diverged * first))
      throw std::runtime_error("the window from " + std::to_string(times_.back()) + " s: after " +
                               std::to_string(iteration) + " iterations the forces of both sides still differ by " +
                               std::to_string(differ) + " N; take fewer samples a window, or a shorter one");
    for (std::size_t k = 0; k < window.bogie.size(); ++k) forces[k] = window.bogie[k].force;
    simulation_.restore(wheelset_begin);
    bogie_.restore(bogie_begin);
  }
  ++windows_;
  for (std::size_t k = 0; k < window.bogie.size(); ++k) {
    const BogieSample& bogie = window.bogie[k];
    times_.push_back(window.path[k + 1].time);
    forces_.push_back(forces[k]);
    record({window.path[k + 1], forces[k], bogie, window.work[k] - work_at_start_,
            bogie.energy + bogie.dissipated - energy_at_start_, window.histories[k]});
  }
  constexpr std::size_t kept = 3;
  if (times_.size() > kept) {
    times_.erase(times_.begin(), times_.end() - kept);
    forces_.erase(forces_.begin(), forces_.end() - kept);
  }
  return simulation_.end().empty();
}

CoupledSample Coupling::sample() const {
  const BogieSample bogie = bogie_.sample();
  return {motion(),
          forces_.back(),
          bogie,
          work_on_wheelset() - work_at_start_,
          bogie.energy + bogie.dissipated - energy_at_start_,
          histories()};
}

Coupling::State Coupling::save() {
  return {simulation_.save(), bogie_.save(), times_, forces_, largest_, windows_, iterations_};
}

void Coupling::restore(const State& state) {
  simulation_.restore(state.simulation);
  bogie_.restore(state.bogie);
  times_ = state.times;
  forces_ = state.forces;
  largest_ = state.largest;
  windows_ = state.windows;
  iterations_ = state.iterations;
}

}  // namespace railwave::vehicle
