#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/elements/history_sets.hpp"
#include "solve/run_summary.hpp"

namespace railwave {

struct Model;
struct SettleReport;

/// Energies at one instant, J. `balance_error` = total now - total at the run's start - external work since; it is what
/// the time integration failed to account for.
struct EnergyAccount {
  double kinetic = 0;
  double internal = 0;   ///< elastic, of solids and beams
  double hourglass = 0;  ///< dissipated (viscous) and stored (stiffness)
  double contact =
      0;  ///< stored in the penalty springs, normal and tangential; of multipliers: taken out by nodes' impacts
  double friction = 0;       ///< dissipated
  double connector = 0;      ///< stored in springs
  double damping = 0;        ///< dissipated in dashpots and by contact damping
  double plastic = 0;        ///< dissipated by plastic flow
  double external_work = 0;  ///< by loads and gravity
  double balance_error = 0;
  double impacts = 0;  ///< of `contact`, what nodes' impacts on multipliers took out
};

/// Sums over one contact pair, on the slave, N, global axes.
struct ContactTotals {
  Vec3 normal_force{};
  Vec3 tangential_force{};
  Vec3 master_force{};  ///< sum gathered on the master's nodes; minus the slave's to rounding
  int nodes_in_contact = 0;
  int nodes_slipping = 0;
};

/// Mean motion of a history set, mass weighted.
struct MeanMotion {
  Vec3 displacement{};
  Vec3 velocity{};
  Vec3 acceleration{};
};

/// Section forces and moments of the elements of one of scene.beams, in the middle of each, in its own axes (the first
/// along it): three values for each element, chain by chain.
struct BeamResultants {
  std::vector<double> force;   ///< N: axial (tension positive), shear along the second and third axis
  std::vector<double> moment;  ///< N m: torsion, bending about the second and third axis
};

/// What one of the scene's loads comes to.
struct LoadTotals {
  Vec3 force{};       ///< N; none of a torque
  double moment = 0;  ///< N m, of a torque about its axis
  double work = 0;    ///< J, since the run's start
};

/// What it takes to move a set as one of the scene's prescribed motions says.
struct ReactionTotals {
  Vec3 force{};     ///< N, on the set, along the prescribed directions
  double work = 0;  ///< J, since the run's start
};

struct HistorySample {
  double time = 0;
  long step = 0;
  EnergyAccount energy;
  std::vector<ContactTotals> contacts;    ///< one for each contact of the scene
  std::vector<MeanMotion> sets;           ///< one for each of scene.output.history_sets whose motion is written
  std::vector<ElementMeans> elements;     ///< one for each of these whose stress, strain or plastic strain is written
  std::vector<BeamResultants> beams;      ///< one for each of the scene's beams
  std::vector<LoadTotals> loads;          ///< one for each of the scene's loads
  std::vector<ReactionTotals> reactions;  ///< one for each of the scene's prescribed motions
};

/// Who asks for an output of fields.
struct DueFields {
  bool all = false;           ///< output.field_interval, or it is the last one
  std::vector<bool> windows;  ///< each of the scene's output windows

  bool any() const { return all || std::find(windows.begin(), windows.end(), true) != windows.end(); }
};

/// Energies of one part's elements, J.
struct PartEnergy {
  double internal = 0;  ///< elastic, and the work of plastic flow
  double hourglass = 0;
};

/// What the time loop tells the outside. Called on the host thread, between two steps.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void begin(const Model& /*model*/) {}
  /// Next: what in the scene may be a mistake (model/checks/doubts.hpp), a line each.
  virtual void doubts(const std::vector<std::string>& /*lines*/) {}
  /// Every few steps of a dynamic relaxation.
  virtual void settling(const Model& /*model*/, const SettleReport& /*so_far*/) {}
  /// After a dynamic relaxation, before the first step.
  virtual void settled(const Model& /*model*/, const SettleReport& /*report*/) {}
  virtual void history(const Model& /*model*/, const HistorySample& /*sample*/) {}
  /// Whether history() and progress() look at the model and not at the sample alone. If nobody does, a GPU may be some
  /// steps ahead when they are called.
  virtual bool looks_at_model() const { return true; }
  /// The model stands at `sample.time`; fields are fetched by the functions of model/fields.hpp.
  virtual void fields(const Model& /*model*/, const HistorySample& /*sample*/, const DueFields& /*due*/) {}
  /// At every history sample, and at checks of the monitor, where histories are rarer.
  virtual void progress(const Model& /*model*/, const HistorySample& /*sample*/) {}
  /// Once for each kind of thing that the monitor warns of, when it is first seen; again if it becomes fatal.
  virtual void warning(const Model& /*model*/, const Fault& /*fault*/) {}
  virtual void end(const Model& /*model*/, const RunSummary& /*summary*/) {}
};

}  // namespace railwave
