#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "kernels/support/spaces.hpp"
#include "model/ranks/transport.hpp"
#include "solve/ranks/rank_lanes.hpp"

namespace railwave {

/// Messages from one GPU's memory to another's, in the order of a lane: the host waits for none of them.
class DeviceMessages {
 public:
  virtual ~DeviceMessages() = default;

  /// What is exchanged with another rank. Both are places on the device.
  struct Message {
    int other;
    const void* sent;
    std::size_t sent_bytes;
    void* received;
    std::size_t received_bytes;
  };

  /// Memory into which what is sent is packed, and where what came is found: two buffers of each, which exchanges take
  /// in turn, the first one the first. Aligned for any row.
  struct LentMemory {
    struct Part {
      unsigned char *sent, *received;
      long second_sent, second_received;  ///< bytes from the first buffer to the second
    };
    std::vector<Part> parts;              ///< in the order of ExchangeLoad
    const unsigned long long* exchanges;  ///< on the device: so many are over
  };
  /// Null: messages come from memory of the rank's own, and go there.
  virtual const LentMemory* lent() const { return nullptr; }

  /// Where launches of several lanes wait for a place on the device, those of the inner one come last.
  virtual const ExecutionSpace& space(RankLane lane) const = 0;
  virtual void wait(const LaneWait& wait) = 0;
  /// They leave when all is done that has been launched in their lane; what is launched there next comes after them.
  /// @param messages none where memory is lent
  virtual void exchange(const std::vector<Message>& messages) = 0;

  /// Launches and messages, recorded with who waits for whom.
  class Recorded {
   public:
    virtual ~Recorded() = default;
    /// In the inner lane, at the cost of one launch.
    virtual void launch() const = 0;
  };
  /// Records what is launched in the inner lane, and in the others once they have waited for it, up to where it waits
  /// for them. Nothing may be allocated, copied or waited for meanwhile, and all ranks must have exchanged messages
  /// before. Ranks need not record alike: messages meet in the order in which they leave.
  virtual std::unique_ptr<Recorded> record(const std::function<void()>& launch) = 0;
};

/// What a rank exchanges in a step, and what it computes meanwhile.
struct ExchangeLoad {
  /// With a neighbour, in the order in which messages come and go.
  struct Part {
    int other;
    std::size_t sent, received;  ///< bytes
  };
  std::vector<Part> parts;
  long elements;  ///< of the inner blocks

  /// Sent or received, whichever is more.
  std::size_t bytes() const {
    std::size_t sent = 0, received = 0;
    for (const Part& part : parts) {
      sent += part.sent;
      received += part.received;
    }
    return sent > received ? sent : received;
  }
};

/// Whether the program was built for GPUs whose memory another process may write to.
#ifdef KOKKOS_ENABLE_CUDA
inline constexpr bool has_direct_messages = true;
#else
inline constexpr bool has_direct_messages = false;
#endif

/// Whether the program was built with NCCL, for GPUs that it knows.
#if defined(RAILWAVE_NCCL) && defined(KOKKOS_ENABLE_CUDA)
inline constexpr bool has_nccl_messages = true;
#else
inline constexpr bool has_nccl_messages = false;
#endif

/// Each rank writes into its neighbours' memory, where each has a GPU of its own in the same host and these reach each
/// other; null elsewhere, on all ranks alike. All ranks must call this together.
std::unique_ptr<DeviceMessages> direct_messages(Transport& transport, const ExchangeLoad& load);

/// By NCCL, where the program was built with it and each rank has a GPU of its own; null elsewhere, on all ranks alike.
/// All ranks must call this together.
std::unique_ptr<DeviceMessages> nccl_messages(Transport& transport, const ExchangeLoad& load);

}  // namespace railwave
