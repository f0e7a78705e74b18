#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "kernels/support/spaces.hpp"
#include "model/ranks/transport.hpp"

namespace railwave {

/// What a rank launches side by side: each lane in an order of its own.
enum class RankLane : int {
  inner,    ///< the default order: blocks without late nodes or nodes of other ranks, then all nodes but these
  outer,    ///< blocks with nodes of other ranks, messages, and these nodes
  late,     ///< blocks with late nodes, which ties, multipliers, prescribed motions or ends move
  loads,    ///< loads; then what moves late nodes
  contact,  ///< contact, and beams
};
inline constexpr int rank_lanes = 5;

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

  /// Launches of other lanes than the inner one come before its own where both wait for a place on the device.
  virtual const ExecutionSpace& space(RankLane lane) const = 0;
  /// What is launched in a lane from now on comes after all that has been launched in another.
  virtual void wait(RankLane who, RankLane for_whom) = 0;
  /// All wait for the inner lane.
  void begin();
  /// The inner lane waits for all.
  void finish();
  /// They leave when all is done that has been launched in the outer lane; what is launched there next comes after
  /// them.
  virtual void exchange(const std::vector<Message>& messages) = 0;
  /// Launches and messages, recorded with who waits for whom.
  class Recorded {
   public:
    virtual ~Recorded() = default;
    /// In the inner lane, at the cost of one launch.
    virtual void launch() const = 0;
  };
  /// Records what is launched in the inner lane, and between begin() and finish() in the others. Nothing may be
  /// allocated, copied or waited for meanwhile, and all ranks must have exchanged messages before. Ranks need not
  /// record alike: messages meet in the order in which they leave.
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
