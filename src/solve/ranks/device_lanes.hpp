#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "solve/launch_graph.hpp"
#include "solve/ranks/device_messages.hpp"

#ifdef KOKKOS_ENABLE_CUDA

namespace railwave {

inline void check(cudaError_t result, const char* what) {
  if (result == cudaSuccess) return;
  throw std::runtime_error(fmt::format("CUDA could not {}: {}", what, cudaGetErrorString(result)));
}

/// A mark in the order of a stream, for which other streams wait.
class Mark {
 public:
  Mark() { check(cudaEventCreateWithFlags(&event_, cudaEventDisableTiming), "make an event"); }
  ~Mark() { cudaEventDestroy(event_); }
  Mark(const Mark&) = delete;
  Mark& operator=(const Mark&) = delete;

  /// Whoever has waited for it before waits for where it was then.
  void pass(cudaStream_t from, cudaStream_t to) const {
    check(cudaEventRecord(event_, from), "record an event");
    check(cudaStreamWaitEvent(to, event_, 0), "wait for an event");
  }

 private:
  cudaEvent_t event_ = nullptr;
};

/// A stream whose launches come before those of the default one.
class UrgentStream {
 public:
  /// @param behind how many more urgent ones, as far as the device has so many priorities
  explicit UrgentStream(int behind) {
    int least = 0, greatest = 0;  // the greatest has the smallest number
    check(cudaDeviceGetStreamPriorityRange(&least, &greatest), "say its priorities");
    const int priority = std::min(greatest + behind, std::max(greatest, least - 1));
    check(cudaStreamCreateWithPriority(&stream_, cudaStreamNonBlocking, priority), "make a stream");
  }
  ~UrgentStream() {
    cudaStreamSynchronize(stream_);
    cudaStreamDestroy(stream_);
  }
  UrgentStream(const UrgentStream&) = delete;
  UrgentStream& operator=(const UrgentStream&) = delete;

  cudaStream_t get() const { return stream_; }

 private:
  cudaStream_t stream_ = nullptr;
};

class RecordedMessages : public DeviceMessages::Recorded {
 public:
  explicit RecordedMessages(const std::function<void()>& launch) {
    const cudaStream_t stream = ExecutionSpace().cuda_stream();
    // Of this thread alone: NCCL has threads of its own.
    check(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal), "begin to record launches");
    std::exception_ptr failure;
    try {
      launch();
    } catch (...) {
      failure = std::current_exception();
    }
    cudaGraph_t graph = nullptr;
    const cudaError_t ended = cudaStreamEndCapture(stream, &graph);
    const std::unique_ptr<std::remove_pointer_t<cudaGraph_t>, cudaError_t (*)(cudaGraph_t)> owned(graph,
                                                                                                  cudaGraphDestroy);
    if (failure) std::rethrow_exception(failure);
    check_graph(ended, "record steps");
    // Outer blocks and messages come before inner blocks in a graph, too.
    launches_ = std::make_unique<RepeatedLaunches>(graph);
  }

  void launch() const override { launches_->launch(ExecutionSpace()); }

 private:
  std::unique_ptr<RepeatedLaunches> launches_;
};

/// A rank's lanes on a GPU: streams, and how they wait for each other.
class DeviceLanes : public DeviceMessages {
 public:
  const ExecutionSpace& space(RankLane lane) const override { return spaces_[static_cast<int>(lane)]; }

  void wait(const LaneWait& wait) override {
    marks_[static_cast<int>(wait.for_whom)].pass(space(wait.for_whom).cuda_stream(), space(wait.who).cuda_stream());
  }

  std::unique_ptr<Recorded> record(const std::function<void()>& launch) override {
    return std::make_unique<RecordedMessages>(launch);
  }

 protected:
  cudaStream_t messages() const { return messages_.get(); }
  /// Whether an error ends the rank: the others' messages may never come.
  bool given_up() const { return std::uncaught_exceptions() > exceptions_; }

 private:
  // What has to begin while others fill the device comes first: it is small, and long in line. Messages waited for the
  // last of all teams of lanes before them.
  UrgentStream messages_{0}, loads_{1}, contact_{1}, beams_{1}, motion_{1}, late_{2}, outer_{3};
  static constexpr int lanes = 1 + static_cast<int>(std::size(other_rank_lanes));
  /// In the order of RankLane.
  const ExecutionSpace spaces_[lanes] = {ExecutionSpace(),
                                         ExecutionSpace(outer_.get()),
                                         ExecutionSpace(late_.get()),
                                         ExecutionSpace(messages_.get()),
                                         ExecutionSpace(loads_.get()),
                                         ExecutionSpace(contact_.get()),
                                         ExecutionSpace(beams_.get()),
                                         ExecutionSpace(motion_.get())};
  Mark marks_[lanes];
  const int exceptions_ = std::uncaught_exceptions();
};

}  // namespace railwave

#endif
