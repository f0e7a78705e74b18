#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "case/scene_meshes.hpp"

/// How a case is computed and what is written of it: static start, time loop, checks, checkpoints, outputs. Keys:
/// keys_run.cpp.
namespace railwave::scene {

/// automatic: Newton's method, and relaxation where that finds no equilibrium.
enum class SettleMethod { automatic, newton, relaxation };

/// Static equilibrium before the run; absent: the run starts from the undeformed mesh.
struct Settle {
  bool active = false;
  SettleMethod method = SettleMethod::automatic;
  double tolerance = 1e-3;  ///< residual force over applied force at which it counts as settled
  int max_steps = 20000;
  bool friction = true;        ///< false: contacts are frictionless while the scene settles
  bool cache = true;           ///< keep the settled state in a file, and take it from there
  std::string cache_folder;    ///< where that lies; empty: beside the results
  bool keep_unsettled = true;  ///< also a state that is not settled yet, from which a later run settles on
};

struct Time {
  double end = 0;           ///< s
  double step_scale = 0.9;  ///< sf, thesis 3.3.6
  double step = 0;          ///< s; 0: from elements and contact
};

enum class Precision { double_precision, mixed, single_precision };

/// automatic: the global one where it pays, else by elements (src/model/time_step/automatic_step.hpp).
enum class StepEstimate { automatic, element, eigenvalue, global };

/// What is kept of a run so that it can be taken up again.
struct Checkpoint {
  double interval = 300;  ///< wall seconds; 0: none but where the run is stopped
  std::string file;       ///< empty: beside the results
};

/// How the time loop computes; what it computes is the other sections' matter.
struct Solver {
  Precision precision =
      Precision::double_precision;  ///< mixed: elements in single, nodes in double; single: both in single
  StepEstimate step_estimate = StepEstimate::automatic;  ///< what the stable step is taken from
  bool subcycling = false;                               ///< coarse regions take larger steps than fine ones
  int renew_steps = 20000;                               ///< steps between renewals of the global estimate; 0: never

  bool elements_in_single() const { return precision != Precision::double_precision; }
};

/// Limits of the checks of a running solution: beyond one the run warns, beyond a fatal one it stops.
struct Monitor {
  bool active = true;
  double energy_error = 0.05;       ///< of the balance, over what deformation has held and dissipated
  double fatal_energy_error = 0.5;  ///< the same; the run stops
  double kinetic_growth = 0.1;      ///< kinetic energy beyond what the run was given, over the same
  double hourglass_share =
      0.1;  ///< hourglass energy of a part, stored or dissipated within a millisecond, over that of its deformation
  double hourglass_distortion = 0.3;  ///< hourglass displacement of an element over its size
  double penetration = 0.1;           ///< of a contact node over the size of the face under it
  double volume_ratio = 0.3;          ///< smallest Jacobian of an element over its undeformed one; the run stops at 0
  double speed = 500;                 ///< m/s, of a node
  double fatal_speed = 20000;         ///< m/s; the run stops
  double contact_edge = 0.1;  ///< normal force of a contact node at an end of its surface over the contact's largest
  double fine_zone = 0.1;     ///< the same outside the fine zone of a part
  int chatter = 10;           ///< times that a contact node was seen to open and to close again
  double box = 0;             ///< m, half the edge of what is written about a fault; 0: six times the element's size
};

enum class ResultsPrecision { double_precision, single };

/// Without a list of names all are meant.
inline bool is_among(const std::string& one, const std::optional<std::vector<std::string>>& names) {
  return !names || std::find(names->begin(), names->end(), one) != names->end();
}

struct Output {
  std::string file = "results.h5";  ///< relative to the folder the program runs in unless absolute
  double history_interval = 0;      ///< s; 0: every step
  double field_interval = 0;        ///< s; 0: only at the beginning and the end
  std::vector<std::string>
      field_sets;  ///< `part` or `part.element_set` or `part.surface`: element and node fields on these
  std::vector<std::string> fields;  ///< names of case/field_table.hpp that serve fields
  std::vector<std::string>
      history_sets;  ///< `part.node_set` or point masses: mean motion; `part.element_set`: mean stress and strain
  std::optional<std::vector<std::string>> history_beams;   ///< of which section forces are written; absent: all
  std::optional<double> contact_margin;                    ///< m; absent: contact surfaces are written whole
  std::optional<std::vector<std::string>> contact_fields;  ///< names of case/field_table.hpp; absent: all
  std::vector<std::string> contact_sides = {"slave", "master"};
  ResultsPrecision precision = ResultsPrecision::double_precision;  ///< of fields and contacts; histories are in double
  std::optional<int> significant_digits;                            ///< of fields and contacts but places; absent: all
  double progress_interval = 5;                                     ///< wall seconds between progress lines
};

/// Part of a run in which fields are written besides those of Output::field_interval. Absent lists: all.
struct OutputWindow : Place {
  double start = 0;                                    ///< s
  std::optional<double> end;                           ///< s; absent: the run's
  double interval = 0;                                 ///< s; 0: every step
  std::optional<std::vector<std::string>> field_sets;  ///< of Output::field_sets
  std::optional<std::vector<std::string>> contacts;    ///< names

  bool has_set(const std::string& set) const { return is_among(set, field_sets); }
  bool has_contact(const std::string& contact) const { return is_among(contact, contacts); }
};

}  // namespace railwave::scene
