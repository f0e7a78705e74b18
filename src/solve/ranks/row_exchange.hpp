#pragma once

#include <functional>
#include <memory>

#include "model/ranks/rank_share.hpp"
#include "model/ranks/transport.hpp"
#include "solve/ranks/device_messages.hpp"
#include "solve/tasks.hpp"

namespace railwave {

/// How the rows of partial forces go from rank to rank.
enum class RowWay : int {
  automatic,  ///< the first of those below that all ranks have
  direct,     ///< from GPU to GPU of a host, see direct_messages()
  nccl,       ///< from GPU to GPU, see nccl_messages()
  mpi,        ///< by an MPI that is given the device's memory
  host        ///< by MPI through the host's memory
};

/// The way that RAILWAVE_RANK_MESSAGES names on rank 0: launchers of MPI need not pass variables on to other hosts.
/// All ranks must call this together.
/// Throws InputError, on all of them, where the variable names no way, or one that a rank does not have.
RowWay wanted_row_way(Transport& transport);

/// For people.
const char* description(RowWay way);

/// Brings to each rank the rows of partial forces that others' blocks leave for its nodes, and the forces by which rank
/// 0's contact pushes them. All ranks that have a node add its rows in the same order, so that it goes the same way on
/// each.
class RowExchange {
 public:
  /// All ranks must make theirs together. Throws what wanted_row_way() throws, and std::runtime_error where a way from
  /// GPU to GPU is wanted that the ranks' GPUs do not have.
  /// @param messages in place of those of GPUs
  RowExchange(const NodalState& nodal, RankShare share, Transport& transport,
              std::unique_ptr<DeviceMessages> messages = nullptr);
  ~RowExchange();

  const RankShare& share() const { return share_; }
  Transport& transport() const { return transport_; }

  /// Never automatic.
  RowWay way() const { return way_; }
  /// Whether contact of this rank acts on nodes of others.
  bool pushes_others() const { return share_.rank == 0 && share_.touched.extent(0) > 0; }
  /// Whether devices exchange rows by themselves; else the host waits for them in each step.
  bool between_devices() const { return way_ == RowWay::direct || way_ == RowWay::nccl; }

  /// Until no more than so many steps, or graphs of steps, are left whose rows of other ranks have not come, see
  /// Transport::wait_until().
  /// Nobody may wait for the device before that: of a rank that does not answer, it waits without end.
  void wait_for_rows(long ahead = 0) const;

  /// Between devices: the tasks launch in a lane's order. Else the host waits for rows, and they stay in the default
  /// one.
  std::vector<Task> in_lane(RankLane lane, std::vector<Task> tasks) const;
  /// The first of a step: other lanes than the inner one wait for the step before.
  /// @param waits for it
  std::vector<Task> begin_tasks(std::vector<LaneWait> waits) const;
  /// Between devices.
  Task wait_task(std::vector<LaneWait> waits) const;
  /// To come after the outer blocks' forces, and on rank 0 after contact's springs: the rows are on their way from then
  /// on.
  /// @param beside these are in lanes of their own: it waits for the blocks' lanes
  Task send_task(bool beside);
  /// Before anything that needs rows of others in another lane than that of messages. Between devices the inner lane
  /// waits for all others.
  Task receive_task();
  /// Between devices, of a step that goes on in lanes to its end: what comes after it waits for all of them, unless
  /// that is such a step of the same graph.
  Task end_task();

  /// Between devices: a rank's steps as a graph, see DeviceMessages::record().
  std::unique_ptr<DeviceMessages::Recorded> record(const std::function<void()>& launch);
  /// Launches such steps. The host comes no more than some graphs before the device.
  void repeat(const DeviceMessages::Recorded& steps);
  /// Launches, between devices, something beside steps that may be in any lane.
  void in_order(const std::function<void()>& launch) const;

 private:
  struct Buffers;

  /// Messages by MPI leave when the inner blocks are launched: a device has yet to begin with the outer ones when these
  /// are, while a host is done with them. Where a host's memory stands for a device's, it does as for a device.
  bool starts_late() const { return on_device || way_ == RowWay::mpi; }

  /// In the lane of messages, all of it.
  template <class Rows>
  void exchange_on_devices(const Rows& rows) const;

  void pass(const std::vector<LaneWait>& waits) const;
  /// The task, with the waits before it.
  Task after(std::vector<LaneWait> waits, Task task) const;

  /// Calls act(what is exchanged).
  template <class Do>
  void with_rows(const Do& act) const;

  const NodalState& nodal_;
  RankShare share_;
  Transport& transport_;
  RowWay way_;
  std::unique_ptr<Buffers> buffers_;
  bool recording_ = false;
};

}  // namespace railwave
