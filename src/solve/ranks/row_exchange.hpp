#pragma once

#include <functional>
#include <memory>

#include "model/ranks/rank_share.hpp"
#include "model/ranks/transport.hpp"
#include "solve/ranks/device_messages.hpp"
#include "solve/tasks.hpp"

namespace railwave {

template <class S>
struct PrecisionBuffers;

/// Brings to each rank the rows of partial forces that others' blocks leave for its nodes. All ranks that have a node
/// add its rows in the same order, so that it goes the same way on each.
class RowExchange {
 public:
  RowExchange(const NodalState& nodal, RankShare share, Transport& transport);
  ~RowExchange();

  const RankShare& share() const { return share_; }
  Transport& transport() const { return transport_; }

  /// Whether rows go from GPU to GPU; else they go through the host.
  bool between_devices() const;

  /// Until no more than so many steps, or graphs of steps, are left whose rows of other ranks have not come, see
  /// Transport::wait_until().
  /// Nobody may wait for the device before that: of a rank that does not answer, it waits without end.
  void wait_for_rows(long ahead = 0) const;

  /// In whose order outer blocks may launch their forces, beside all others; null: the default one, and rows go through
  /// the host.
  const ExecutionSpace* outer_space() const;
  /// In whose order loads and contact may be launched then; null: the default one.
  const ExecutionSpace* side_space() const;
  /// The first of a step: what is launched there comes after the step before.
  std::vector<Task> begin_tasks();
  /// To come after the outer blocks' forces: the rows are on their way from then on.
  /// @param beside these are in outer_space()
  Task send_task(bool beside);
  /// Before anything that needs all forces.
  Task receive_task();

  /// Between devices: a rank's steps as a graph, see DeviceMessages::record().
  std::unique_ptr<DeviceMessages::Recorded> record(const std::function<void()>& launch);
  /// Launches such steps. The host comes no more than some graphs before the device.
  void repeat(const DeviceMessages::Recorded& steps);
  /// Launches, between devices, something beside steps that may be in outer_space() or side_space().
  void in_order(const std::function<void()>& launch) const;

 private:
  struct Buffers;

  /// In outer_space(), all of it.
  template <class S>
  void exchange_on_devices(const Array<PartialForce<S>*>& rows, const PrecisionBuffers<S>& buffers) const;

  /// Calls act(rows of partial forces, their buffers).
  template <class Do>
  void with_rows(const Do& act) const;

  const NodalState& nodal_;
  RankShare share_;
  Transport& transport_;
  std::unique_ptr<Buffers> buffers_;
  bool recording_ = false;
};

}  // namespace railwave
