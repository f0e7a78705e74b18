#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bogie.hpp"
#include "interface_motion.hpp"
#include "library/simulation.hpp"

namespace railwave::vehicle {

struct CouplingChoice {
  int samples = 1;           ///< of a window, each as long as the simulation's
  double tolerance = 1e-10;  ///< of the forces, over the largest so far
  int most_iterations = 30;
  std::vector<std::string> histories;  ///< of the simulation, whose values each sample has
};

/// Both sides at an instant on which they agree.
struct CoupledSample {
  InterfaceMotion motion;    ///< displacement from the undeformed place
  Vector force{};            ///< N, on the wheelset: what Railwave had
  BogieSample bogie;         ///< its force is what the bogie answers; both differ by the tolerance
  double wheelset_work = 0;  ///< J, by the force on the wheelset, by Railwave's account, since the start
  double bogie_work = 0;     ///< J, by the wheelset on the bogie: what the bogie's energy and its dampers' heat grew by
  std::vector<double> histories;  ///< values of those that were asked for, one after the other
};

/// Couples a wheelset in Railwave with a bogie in Simbody, window by window (waveform relaxation): forces of the
/// primary suspension act on the wheelset, whose motion carries the suspension's foot.
///
/// In a window the forces are guessed at all its samples, straight lines between. Railwave computes the motion that
/// comes of them, Simbody the forces that come of that motion. Where these are not those of the guess, both go back to
/// the window's begin and take them as the next guess.
class Coupling {
 public:
  /// Called with each sample of a window once both sides agree.
  using Record = std::function<void(const CoupledSample&)>;

  /// The simulation is at its time 0, and its curves begin with the bogie's forces at that time. The bogie takes up the
  /// wheelset's speed along x.
  Coupling(Simulation& simulation, Bogie& bogie, const Interface& interface, const CouplingChoice& choice);

  /// A window. Throws std::runtime_error where the sides do not agree within most_iterations.
  /// @return false: the simulation has come to its end
  bool advance(const Record& record);

  /// Both sides as they are now.
  CoupledSample sample() const;

  long windows() const { return windows_; }
  long iterations() const { return iterations_; }  ///< of all windows together; taken back: less by one a window

  /// All that is needed to go on from here; restore() goes back to it, bit for bit.
  struct State {
    SimulationState simulation;
    BogieState bogie;
    std::vector<double> times;
    std::vector<Vector> forces;
    double largest;
    long windows, iterations;
  };
  State save();
  void restore(const State& state);

 private:
  struct Window;
  std::vector<Vector> guess() const;
  void run_wheelset(Window& window, const std::vector<Vector>& forces);
  double difference(const Window& window, const std::vector<Vector>& forces) const;
  InterfaceMotion motion() const;
  InterfaceMotion for_bogie(const InterfaceMotion& motion) const;
  double work_on_wheelset() const;
  std::vector<double> histories() const;

  Simulation& simulation_;
  Bogie& bogie_;
  Interface interface_;
  CouplingChoice choice_;
  InterfaceMotion start_;
  double work_at_start_ = 0, energy_at_start_ = 0;
  std::vector<double> times_;   ///< s, of the last samples
  std::vector<Vector> forces_;  ///< N, at these
  double largest_ = 0;          ///< N
  long windows_ = 0, iterations_ = 0;
};

}  // namespace railwave::vehicle
