#pragma once

#include <functional>
#include <utility>

#include "kernels/support/milestone.hpp"

namespace railwave {

/// What this thread does, bit by bit, while it waits for the device, as long as this lives. There is one at most.
class Meanwhile {
 public:
  /// @param bit is done at least once in each wait. What it waits for itself it waits for idly.
  explicit Meanwhile(std::function<void()> bit) : bit_(std::move(bit)) { present() = this; }
  ~Meanwhile() { present() = nullptr; }
  Meanwhile(const Meanwhile&) = delete;
  Meanwhile& operator=(const Meanwhile&) = delete;

  static Meanwhile*& present() {
    static thread_local Meanwhile* one = nullptr;
    return one;
  }

  void wait_for(const ExecutionSpace& order) {
    end_.put(order);
    present() = nullptr;
    do bit_();
    while (end_.ahead() > 0);
    present() = this;
    end_.wait();
  }

 private:
  const std::function<void()> bit_;
  Milestone end_;
};

/// Waits until the device has done what has been launched in an order.
inline void wait_for(const ExecutionSpace& order) {
  if (Meanwhile* const other_work = Meanwhile::present())
    other_work->wait_for(order);
  else
    order.fence();
}

}  // namespace railwave
