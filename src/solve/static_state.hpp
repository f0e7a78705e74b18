#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave {

/// Everything of a settled scene that its run starts from, as plain data; velocities are zero.
struct StaticState {
  struct Contact {
    std::vector<int> tracked, status;  ///< by slave node, as in ContactArrays
    std::vector<double> place, gap, normal_force, tangential_force, way_since_stuck;
  };

  bool settled = false;
  double unbalance = 0;
  int steps = 0, iterations = 0;                          ///< it took, see SettleReport
  std::vector<double> position;                           ///< m, node by node
  std::vector<Contact> contacts;                          ///< by pair of the model
  std::vector<std::vector<double>> plastic, back_stress;  ///< by element group
  std::vector<double> beam_rotation,
      beam_stretch;                 ///< by beam node and beam element, as in BeamArrays; empty without beams
  std::vector<double> end_support;  ///< N by node of non-reflecting ends
};

StaticState take_static_state(const Model& model);

/// Puts a scene at the start of its run from there: whatever the arrays held before.
/// @return false when the state is not of this model; nothing is changed then
bool lay_static_state(Model& model, const StaticState& state);

/// Where settled states are kept from one run to the next.
class SettledStates {
 public:
  virtual ~SettledStates() = default;

  struct Found {
    std::optional<StaticState> state;
    std::string file;     ///< it was in; empty: there is none
    std::string trouble;  ///< why a file that is there is of no use
  };
  virtual Found find(const Model& model) = 0;

  /// @return why it could not be kept; empty: it is
  virtual std::string keep(const Model& model, const StaticState& state) = 0;
};

}  // namespace railwave
