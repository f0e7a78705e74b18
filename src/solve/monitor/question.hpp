#pragma once

#include <memory>
#include <utility>

#include "kernels/support/milestone.hpp"
#include "kernels/support/reductions.hpp"

namespace railwave {

/// Reductions that a check asks of the device, while the host may launch something else until it needs the answer.
/// @tparam Found what they are put into
template <class Found>
class Question {
 public:
  /// @param order in which the launches come
  /// @param queue queue(Reductions&, Found&) queues them; what it is given stays where it is until answer()
  template <class Queue>
  void ask(const ExecutionSpace& order, const Queue& queue) {
    asked_ = std::make_unique<Asked>(Asked{Reductions(space_, order), {}});
    queue(asked_->reductions, asked_->found);
    asked_->reductions.start_fetch(answered_);
  }

  bool asked() const { return asked_ != nullptr; }
  /// Whether the device has yet to come to the answer.
  bool waits() const { return answered_.ahead() > 0; }

  /// Waits for the answer to what was asked. Once.
  Found answer() {
    asked_->reductions.finish_fetch(answered_);
    Found found = std::move(asked_->found);
    asked_.reset();
    return found;
  }

 private:
  struct Asked {
    Reductions reductions;
    Found found;
  };
  ReductionSpace space_;  ///< a sample of the same instant has the model's
  Milestone answered_;
  std::unique_ptr<Asked> asked_;  ///< null: nothing was asked
};

}  // namespace railwave
