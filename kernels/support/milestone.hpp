#pragma once

#include <atomic>

#include "kernels/support/spaces.hpp"

namespace railwave {

struct ReachMilestone {
  PinnedArray<long*> reached;
  long number;
  KOKKOS_INLINE_FUNCTION void operator()(const int) const { reached(0) = number; }
};

/// A word of the host's that the device counts up when it has come to a place in the order of its launches. A fence
/// would wait for all that was launched after that place, too, and nobody could ask whether it would wait.
class Milestone {
 public:
  Milestone() : reached_("milestone", 1) {}

  /// The place after all that has been launched in a space.
  void put(const ExecutionSpace& space) {
    ++wanted_;
    Kokkos::parallel_for("milestone", SpreadRange(space, 0, 1), ReachMilestone{reached_, wanted_});
  }

  /// Places that the device has still to come to.
  long ahead() const {
    const volatile long& reached = reached_(0);
    return wanted_ - reached;
  }

  void wait() const {
    while (ahead() > 0) {
    }
    std::atomic_thread_fence(std::memory_order_acquire);
  }

 private:
  PinnedArray<long*> reached_;
  long wanted_ = 0;
};

}  // namespace railwave
