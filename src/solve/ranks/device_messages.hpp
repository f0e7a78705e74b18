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

  /// Where launches of several lanes wait for a place on the device, those of the inner one come last.
  virtual const ExecutionSpace& space(RankLane lane) const = 0;
  virtual void wait(const LaneWait& wait) = 0;
  /// They leave when all is done that has been launched in their lane; what is launched there next comes after them.
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
  std::size_t bytes;  ///< sent or received, whichever is more
  long elements;      ///< of the inner blocks
};

/// Whether the program was built with NCCL, for GPUs that it knows.
#if defined(RAILWAVE_NCCL) && defined(KOKKOS_ENABLE_CUDA)
inline constexpr bool has_device_messages = true;
#else
inline constexpr bool has_device_messages = false;
#endif

/// By NCCL, where the program was built with it and each rank has a GPU of its own; null elsewhere, on all ranks alike.
/// All ranks must call this together.
std::unique_ptr<DeviceMessages> device_messages(Transport& transport, const ExchangeLoad& load);

}  // namespace railwave
