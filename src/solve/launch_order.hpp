#pragma once

#include "kernels/support/meanwhile.hpp"

namespace railwave {

/// In whose order a run launches: that of the default space, as all that is not a run's does, or that of a space of its
/// own, beside which what other runs launch goes on. Where it has its own, what it launches in one of the two waits for
/// the other.
class LaunchOrder {
 public:
  /// @param own null: the default one
  explicit LaunchOrder(const ExecutionSpace* own = nullptr)
      : space_(own != nullptr ? *own : ExecutionSpace()), own_(own != nullptr) {}
  LaunchOrder(const LaunchOrder&) = delete;
  LaunchOrder& operator=(const LaunchOrder&) = delete;

  const ExecutionSpace& space() const { return space_; }
  bool own() const { return own_; }

  /// As Instant has it.
  const ExecutionSpace* own_space() const { return own_ ? &space_ : nullptr; }

  /// Before launches in this order.
  void enter() {
    if (own_ && others_launched_) wait_for(ExecutionSpace());
    others_launched_ = false;
    launched_ = true;
  }

  /// Before launches of the run's in the default one.
  void leave() {
    if (own_ && launched_) wait_for(space_);
    launched_ = false;
    others_launched_ = true;
  }

 private:
  const ExecutionSpace space_;
  const bool own_;
  bool launched_ = false;        ///< here since leave()
  bool others_launched_ = true;  ///< in the default one since enter()
};

}  // namespace railwave
