#pragma once

#include <optional>
#include <string>

#include "model/model.hpp"
#include "solve/checkpoint/run_state.hpp"

namespace railwave {

/// Everything of a settled scene that its run starts from, as plain data; velocities are zero.
struct StaticState {
  bool settled = false;
  double unbalance = 0;
  int steps = 0, iterations = 0;  ///< it took, see SettleReport
  RunState arrays;                ///< those for which is_settled_state()
};

StaticState save_static_state(Model& model);

/// Puts a scene at the start of its run from there: whatever the arrays held before.
/// @return false when the state is not of this model; nothing is changed then
bool restore_static_state(Model& model, const StaticState& state);

/// The contact and plastic state from which trials of settling start, kept on the device. A force evaluation leaves
/// what nodes touch, stick to and have flowed plastically in the arrays; a trial that is not taken must not.
class TrialState {
 public:
  /// Takes the present state as that one.
  void keep(Model& model);
  /// Goes back to it.
  void restore(Model& model);

 private:
  std::vector<Array<unsigned char*>> kept_;  ///< what trials change, array by array
};

/// Where settled states are kept from one run to the next.
class SettledStates {
 public:
  virtual ~SettledStates() = default;

  struct Found {
    std::optional<StaticState> state;
    std::string file;     ///< it was in; empty: there is none
    std::string trouble;  ///< why a file that is there is of no use
  };
  virtual Found find(const AssembledScene& assembled) = 0;

  /// @return why it could not be kept; empty: it is
  virtual std::string keep(const AssembledScene& assembled, const StaticState& state) = 0;
};

}  // namespace railwave
