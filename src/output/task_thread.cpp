#include "output/task_thread.hpp"

#include <utility>

namespace railwave {

TaskThread::TaskThread(std::size_t capacity, std::function<void()> on_failure)
    : capacity_(capacity), on_failure_(std::move(on_failure)), thread_([this] { work(); }) {}

TaskThread::~TaskThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    awaited_ = true;
  }
  added_.notify_one();
  thread_.join();
}

template <class Condition>
void TaskThread::wait(std::unique_lock<std::mutex>& lock, const Condition& condition) {
  awaited_ = true;
  done_.wait(lock, condition);
  awaited_ = false;
}

void TaskThread::add(std::function<void()> task, std::size_t size) {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    wait(lock, [&] { return failure_ || taken_ == 0 || taken_ + size <= capacity_; });
    throw_if_failed();
    waiting_.push_back({std::move(task), size});
    taken_ += size;
  }
  added_.notify_one();
}

void TaskThread::finish() {
  std::unique_lock<std::mutex> lock(mutex_);
  wait(lock, [&] { return failure_ || taken_ == 0; });
  throw_if_failed();
}

void TaskThread::throw_if_failed() const {
  if (failure_) std::rethrow_exception(failure_);
}

void TaskThread::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    added_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      next.task();
    } catch (...) {
      failure = std::current_exception();
    }
    if (failure && on_failure_) on_failure_();
    next.task = nullptr;  // what it holds goes before its share of the capacity is free, and outside the lock
    lock.lock();
    taken_ -= next.size;
    if (failure) {
      failure_ = failure;
      waiting_.clear();
      taken_ = 0;
    }
    done_.notify_all();
  }
}

}  // namespace railwave
