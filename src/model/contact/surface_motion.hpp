#pragma once

#include "kernels/support/milestone.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

struct ContactPair;
struct NodeArrays;

/// Of some nodes, at most.
struct SquaredMotion {
  double moved;  ///< m2, from where they were
  double speed;  ///< m2/s2
};

/// How far a pair's surfaces have moved since its window was built, and how fast they move, at most: the slave's and
/// the master's added.
struct SurfaceMotion {
  double moved = 0;  ///< m
  double speed = 0;  ///< m/s
  long step = -1;    ///< of which it is; -1: none was measured
};

/// The same as the device is asked for it, which answers while the host goes on.
struct AskedMotion {
  PinnedArray<SquaredMotion*> largest;  ///< of blocks of nodes, as the device has sent it
  Milestone arrives;
  bool under_way = false;
  SurfaceMotion last;  ///< once it has arrived

  /// It was asked of another window or state, also what the device has still to answer.
  void forget() {
    last.step = -1;
    under_way = false;
  }

  /// Whether it was asked for at a step or in the steps before.
  bool is_of(long step, long steps_before) const {
    return last.step >= 0 && last.step <= step && step <= last.step + steps_before;
  }
};

/// Asks for the motion at a step.
/// @param space in whose order
void ask_for_motion(const ExecutionSpace& space, const NodeArrays& nodes, ContactPair& pair, long step);

/// Waits for what was asked last. @return it
const SurfaceMotion& take_motion(ContactPair& pair);

}  // namespace railwave
