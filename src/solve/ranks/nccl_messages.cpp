#include "solve/ranks/device_lanes.hpp"

#if defined(RAILWAVE_NCCL) && defined(KOKKOS_ENABLE_CUDA)
#include <nccl.h>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

namespace railwave {

#if defined(RAILWAVE_NCCL) && defined(KOKKOS_ENABLE_CUDA)

namespace {

void check(ncclResult_t result, const char* what) {
  if (result == ncclSuccess) return;
  throw std::runtime_error(fmt::format("NCCL could not {}: {}; RAILWAVE_RANK_MESSAGES=host does without it", what,
                                       ncclGetErrorString(result)));
}

/// Of NCCL's channels so many as bring a step's rows while the inner blocks are computed, alike on all ranks. Each
/// takes room for a block of threads from elements, also while it waits for the other rank.
int channels_for(Transport& transport, const ExchangeLoad& load) {
  constexpr int fewest = 2, most = 16;
  // Between two H200 of one host two channels brought 1.8 MB in 102 us and 3.1 MB in 145 us, while others' elements
  // were computed; a GPU computes 5.5 G elements in a second.
  constexpr double bytes_in_second = 9e9, elements_in_second = 5.5e9;
  const double wanted = static_cast<double>(load.bytes()) / bytes_in_second * elements_in_second /
                        static_cast<double>(std::max(1L, load.elements));
  int channels = fewest;
  while (channels < most && !transport.all_agree(wanted <= channels)) channels *= 2;
  return channels;
}

class NcclMessages : public DeviceLanes {
 public:
  /// @param id of rank 0, known to all
  NcclMessages(const ncclUniqueId& id, const Transport& transport, int channels) {
    // Rows go from one rank to one other. Multicast would be set up for nothing.
    setenv("NCCL_NVLS_ENABLE", "0", 0);
    setenv("NCCL_MAX_P2P_NCHANNELS", std::to_string(channels).c_str(), 0);
    check(ncclCommInitRank(&ranks_, transport.ranks(), id, transport.rank()), "join the ranks");
  }
  ~NcclMessages() override {
    if (given_up()) {
      ncclCommAbort(ranks_);
      return;
    }
    cudaStreamSynchronize(messages());
    ncclCommDestroy(ranks_);
  }
  NcclMessages(const NcclMessages&) = delete;
  NcclMessages& operator=(const NcclMessages&) = delete;

  void exchange(const std::vector<Message>& messages_of_step) override {
    check(ncclGroupStart(), "begin");
    for (const Message& one : messages_of_step) {
      if (one.sent_bytes > 0)
        check(ncclSend(one.sent, one.sent_bytes, ncclChar, one.other, ranks_, messages()), "send");
      if (one.received_bytes > 0)
        check(ncclRecv(one.received, one.received_bytes, ncclChar, one.other, ranks_, messages()), "receive");
    }
    check(ncclGroupEnd(), "exchange rows");
  }

 private:
  ncclComm_t ranks_ = nullptr;
};

}  // namespace

std::unique_ptr<DeviceMessages> nccl_messages(Transport& transport, const ExchangeLoad& load) {
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

std::unique_ptr<DeviceMessages> nccl_messages(Transport& /*transport*/, const ExchangeLoad& /*load*/) {
  return nullptr;
}

#endif

}  // namespace railwave
