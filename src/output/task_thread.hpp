#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace railwave {

/// A thread that does tasks one after the other, in the order they were added, while its owner goes on.
///
/// Bounded: a task takes `size` of the capacity from add() until it is done, and add() waits for capacity. The first
/// task that throws is the last one done: those behind it are dropped, and every later add() and finish() throws its
/// exception. Its members are called by one thread only.
class TaskThread {
 public:
  /// @param on_failure called once, by this thread, when a task throws
  explicit TaskThread(std::size_t capacity, std::function<void()> on_failure = {});
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;
  ~TaskThread();  ///< does what waits, then ends the thread; what a task throws here is lost

  /// A task larger than the capacity is taken when nothing else is there.
  void add(std::function<void()> task, std::size_t size = 1);

  /// Returns when every task is done.
  void finish();

  /// Whether the owner waits for this thread now, in add(), finish() or the destructor. Any thread may ask.
  bool is_awaited() const { return awaited_; }

 private:
  struct Waiting {
    std::function<void()> task;
    std::size_t size;
  };
  void work();
  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, const Condition& condition);
  void throw_if_failed() const;

  const std::size_t capacity_;
  const std::function<void()> on_failure_;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable added_, done_;
  std::deque<Waiting> waiting_;
  std::size_t taken_ = 0;  ///< of the capacity, by what waits and what is being done
  std::exception_ptr failure_;
  std::atomic<bool> awaited_{false};
  bool ending_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace railwave
