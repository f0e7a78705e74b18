#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

/// Railwave as a part of another program, such as one for the dynamics of a vehicle: a case that goes on window by
/// window, takes forces and motions in between and gives back what comes of them. Needs no other header.
namespace railwave {

/// A state of a simulation, kept in memory.
class SimulationState {
 public:
  SimulationState();
  ~SimulationState();
  SimulationState(SimulationState&&) noexcept;
  SimulationState& operator=(SimulationState&&) noexcept;

 private:
  friend class Simulation;
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// A case that is computed in windows of time. It computes what `railwave run` does, bit for bit: its histories are
/// those that a run writes with output.history_interval = window, and nothing is written.
///
/// All functions throw std::runtime_error, or InputError (of case/error.hpp, a std::runtime_error too) for what a user
/// has written, with a message that says what, where and how to mend it. A simulation belongs to one thread.
class Simulation {
 public:
  /// Reads a case, settles it and computes the forces of its first instant, time 0.
  /// @param case_file path of the TOML file
  /// @param window s, from one instant at which it can be asked to the next; rounded to whole steps
  /// @param settings "section.key=value", in place of what the case says
  Simulation(const std::string& case_file, double window, const std::vector<std::string>& settings = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// s, of the present instant, which all values and fields are of.
  double time() const;
  double window() const;  ///< s, as it was asked for

  /// To the end of the next window. @return false: the case has ended (time.end, or a fault; see end())
  bool advance();
  /// Why it has ended, such as "completed"; empty as long as it goes on.
  std::string end() const;

  /// Has a curve of the case (type = "table") lead from its present value to this one over the next window, and stay
  /// there. Loads and prescribed motions follow their curves: this is how a force or a motion is set from outside.
  /// @throws InputError for an unknown curve, or a value that is not finite
  void drive(const std::string& curve, double value);

  /// A quantity of the present instant by its name in the results' group /history with dots, such as
  /// "contact.tread.normal_force", "set.wheel.bore.velocity", "energy.kinetic", "load.drive.moment": one value, or
  /// three (x, y, z). SI units.
  std::vector<double> values(const std::string& history) const;
  /// All names that values() knows.
  std::vector<std::string> histories() const;

  /// A field of those that output.fields names, of a set that output.field_sets names, at the present instant: entry by
  /// entry, see field_components(). All of these are fetched at each window, so name what is needed.
  const std::vector<double>& field(const std::string& name, const std::string& set) const;
  int field_components(const std::string& name) const;
  /// Undeformed places of the set's nodes, three each, m.
  const std::vector<double>& coordinates(const std::string& set) const;

  /// What the simulation is now, curves included.
  SimulationState save();
  /// Takes up a state of this simulation. What follows is, bit for bit, what followed then.
  void restore(const SimulationState& state);

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

}  // namespace railwave
