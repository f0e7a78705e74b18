#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "kernels/support/spaces.hpp"
#include "model/ranks/transport.hpp"

namespace railwave {

/// Messages from one GPU's memory to another's, in the order of launches: the host waits for none of them.
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

  /// They leave when all is done that has been launched in a space, beside what is launched there next.
  virtual void start(const ExecutionSpace& space, const std::vector<Message>& messages) = 0;
  /// What is launched in the space from now on comes after them.
  virtual void finish(const ExecutionSpace& space) = 0;
};

/// By NCCL, where the program was built with it and each rank has a GPU of its own, but for
/// RAILWAVE_RANK_MESSAGES=host; null elsewhere, on all ranks alike: rows go through the host then. All ranks must call
/// this together.
std::unique_ptr<DeviceMessages> device_messages(Transport& transport);

}  // namespace railwave
