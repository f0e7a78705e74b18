#pragma once

#include "model/ranks/rank_share.hpp"
#include "solve/ranks/transport.hpp"

namespace railwave {

/// Brings what a rank's blocks change between that rank and rank 0: places and velocities of their nodes, the forces
/// that stand in their rows, histories of materials, energies dissipated.
class StateCarriage {
 public:
  StateCarriage(Model& model, Transport& transport) : model_(model), transport_(transport) {}

  void send(int to, const ShareItems& items);
  void receive(int from, const ShareItems& items);

 private:
  Model& model_;
  Transport& transport_;
};

}  // namespace railwave
