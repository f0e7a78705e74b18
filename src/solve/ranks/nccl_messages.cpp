#include "solve/ranks/device_messages.hpp"

#if defined(RAILWAVE_NCCL) && defined(KOKKOS_ENABLE_CUDA)
#include <cuda_runtime_api.h>
#include <nccl.h>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "solve/launch_graph.hpp"

namespace railwave {

#if defined(RAILWAVE_NCCL) && defined(KOKKOS_ENABLE_CUDA)

namespace {

void check(ncclResult_t result, const char* what) {
  if (result == ncclSuccess) return;
  throw std::runtime_error(fmt::format("NCCL could not {}: {}; RAILWAVE_RANK_MESSAGES=host does without it", what,
                                       ncclGetErrorString(result)));
}

void check(cudaError_t result, const char* what) {
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

/// Of NCCL's channels so many as bring a step's rows while the inner blocks are computed, alike on all ranks. Each
/// takes room for a block of threads from elements, also while it waits for the other rank.
int channels_for(Transport& transport, const ExchangeLoad& load) {
  constexpr int fewest = 2, most = 16;
  // Between two H200 of one host two channels brought 1.8 MB in 102 us and 3.1 MB in 145 us, while others' elements
  // were computed; a GPU computes 5.5 G elements in a second.
  constexpr double bytes_in_second = 9e9, elements_in_second = 5.5e9;
  const double wanted = static_cast<double>(load.bytes) / bytes_in_second * elements_in_second /
                        static_cast<double>(std::max(1L, load.elements));
  int channels = fewest;
  while (channels < most && !transport.all_agree(wanted <= channels)) channels *= 2;
  return channels;
}

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

class NcclMessages : public DeviceMessages {
 public:
  /// @param id of rank 0, known to all
  NcclMessages(const ncclUniqueId& id, const Transport& transport, int channels)
      : spaces_{ExecutionSpace(),
                ExecutionSpace(outer_.get()),
                ExecutionSpace(late_.get()),
                ExecutionSpace(messages_.get()),
                ExecutionSpace(loads_.get()),
                ExecutionSpace(contact_.get()),
                ExecutionSpace(beams_.get())} {
    // Rows go from one rank to one other. Multicast would be set up for nothing.
    setenv("NCCL_NVLS_ENABLE", "0", 0);
    setenv("NCCL_MAX_P2P_NCHANNELS", std::to_string(channels).c_str(), 0);
    check(ncclCommInitRank(&ranks_, transport.ranks(), id, transport.rank()), "join the ranks");
  }
  ~NcclMessages() override {
    // After an error the others' messages may never come.
    if (std::uncaught_exceptions() > exceptions_) {
      ncclCommAbort(ranks_);
      return;
    }
    cudaStreamSynchronize(messages_.get());
    ncclCommDestroy(ranks_);
  }
  NcclMessages(const NcclMessages&) = delete;
  NcclMessages& operator=(const NcclMessages&) = delete;

  const ExecutionSpace& space(RankLane lane) const override { return spaces_[static_cast<int>(lane)]; }

  void wait(const LaneWait& wait) override {
    marks_[static_cast<int>(wait.for_whom)].pass(space(wait.for_whom).cuda_stream(), space(wait.who).cuda_stream());
  }

  void exchange(const std::vector<Message>& messages) override {
    check(ncclGroupStart(), "begin");
    for (const Message& one : messages) {
      if (one.sent_bytes > 0)
        check(ncclSend(one.sent, one.sent_bytes, ncclChar, one.other, ranks_, messages_.get()), "send");
      if (one.received_bytes > 0)
        check(ncclRecv(one.received, one.received_bytes, ncclChar, one.other, ranks_, messages_.get()), "receive");
    }
    check(ncclGroupEnd(), "exchange rows");
  }

  std::unique_ptr<Recorded> record(const std::function<void()>& launch) override {
    return std::make_unique<RecordedMessages>(launch);
  }

 private:
  // What has to begin while others fill the device comes first: it is small, and long in line. Messages waited for the
  // last of all teams of lanes before them.
  UrgentStream messages_{0}, loads_{1}, contact_{1}, beams_{1}, late_{2}, outer_{3};
  static constexpr int lanes = 1 + static_cast<int>(std::size(other_rank_lanes));
  const ExecutionSpace spaces_[lanes];  ///< in the order of RankLane
  Mark marks_[lanes];
  ncclComm_t ranks_ = nullptr;
  const int exceptions_ = std::uncaught_exceptions();
};

}  // namespace

std::unique_ptr<DeviceMessages> device_messages(Transport& transport, const ExchangeLoad& load) {
  const int channels = channels_for(transport, load);
  ncclUniqueId id;
  const bool ready = transport.rank() != 0 || ncclGetUniqueId(&id) == ncclSuccess;
  if (!transport.all_agree(ready)) return nullptr;
  transport.broadcast(&id, sizeof id);
  std::unique_ptr<DeviceMessages> messages;
  try {
    messages = std::make_unique<NcclMessages>(id, transport, channels);
  } catch (const std::runtime_error&) {
    // Ranks that share a GPU cannot be joined.
  }
  if (!transport.all_agree(messages != nullptr)) return nullptr;
  return messages;
}

#else

std::unique_ptr<DeviceMessages> device_messages(Transport& /*transport*/, const ExchangeLoad& /*load*/) {
  return nullptr;
}

#endif

}  // namespace railwave
