#include "solve/ranks/row_exchange.hpp"

#include <algorithm>
#include <stdexcept>

#include "kernels/elements/element_blocks.hpp"
#include "kernels/support/milestone.hpp"
#include "kernels/support/packed_rows.hpp"
#include "kernels/support/team.hpp"
#include "solve/launch_graph.hpp"
#include "solve/ranks/device_messages.hpp"

namespace railwave {

/// Rows on the device, and on the host where messages are to have them there.
template <class S>
struct RowBuffer {
  Array<PartialForce<S>*> device;
  PinnedArray<PartialForce<S>*> host;
  bool copied;  ///< between the two

  RowBuffer(std::size_t rows, RowWay way)
      : device(unset_array<PartialForce<S>*>("rows of other ranks", rows)), copied(on_device && way == RowWay::host) {
    if (copied) host = PinnedArray<PartialForce<S>*>("rows of other ranks, on the host", rows);
  }

  PartialForce<S>* of_messages() const { return copied ? host.data() : device.data(); }
};

template <class S>
struct PrecisionBuffers {
  RowBuffer<S> sent, received;

  PrecisionBuffers(const RankShare& share, RowWay way, bool used)
      : sent(used ? share.sent.extent(0) : 0, way), received(used ? share.received.extent(0) : 0, way) {}
};

/// So many steps, or graphs of steps, the host launches before the device has come to the first of them: more would
/// gain nothing, and a rank that does not answer is found out by the wait for its rows.
constexpr long most_ahead = 2;

struct RowExchange::Buffers {
  PrecisionBuffers<double> in_double;
  PrecisionBuffers<float> in_single;
  Milestone packed, unpacked;
  ExecutionSpace copies = separate_spaces(1).front();  ///< beside the inner blocks
  std::unique_ptr<DeviceMessages> on_devices;          ///< null: the host has MPI exchange rows

  Buffers(const RankShare& share, RowWay way, bool single)
      : in_double(share, way, !single), in_single(share, way, single) {}
};

namespace {

template <class S>
void pack(const ExecutionSpace& space, const Array<PartialForce<S>*>& rows, const PrecisionBuffers<S>& buffers,
          const RankShare& share) {
  const int count = static_cast<int>(share.sent.extent(0));
  if (count > 0)
    Kokkos::parallel_for("pack_rows", Range(space, 0, count),
                         PackedValues<PartialForce<S>, true>{rows, share.sent, 1, buffers.sent.device});
}

template <class S>
void unpack(const ExecutionSpace& space, const Array<PartialForce<S>*>& rows, const PrecisionBuffers<S>& buffers,
            const RankShare& share) {
  const int count = static_cast<int>(share.received.extent(0));
  if (count > 0)
    Kokkos::parallel_for("unpack_rows", Range(space, 0, count),
                         PackedValues<PartialForce<S>, false>{rows, share.received, 1, buffers.received.device});
}

/// What has been packed comes after the last step's unpacking in the device's order, so that both buffers are free.
template <class S>
void start_messages(const PrecisionBuffers<S>& buffers, const RankShare& share, const ExecutionSpace& copies,
                    Transport& transport) {
  const RowBuffer<S>&sent = buffers.sent, &received = buffers.received;
  for (const RankShare::Neighbour& one : share.neighbours)
    transport.start_receive(one.rank, received.of_messages() + one.first_received,
                            sizeof(PartialForce<S>) * one.received_count);
  if (sent.copied) {
    Kokkos::deep_copy(copies, sent.host, sent.device);
    copies.fence();
  }
  for (const RankShare::Neighbour& one : share.neighbours)
    transport.start_send(one.rank, sent.of_messages() + one.first_sent, sizeof(PartialForce<S>) * one.sent_count);
}

template <class S>
std::vector<DeviceMessages::Message> device_messages_of(const PrecisionBuffers<S>& buffers, const RankShare& share) {
  std::vector<DeviceMessages::Message> messages;
  for (const RankShare::Neighbour& one : share.neighbours)
    messages.push_back({one.rank, buffers.sent.device.data() + one.first_sent, sizeof(PartialForce<S>) * one.sent_count,
                        buffers.received.device.data() + one.first_received,
                        sizeof(PartialForce<S>) * one.received_count});
  return messages;
}

ExchangeLoad load_of(const RankShare& share, bool single) {
  long inner_blocks = 0;
  for (const Array<int*>& of_group : share.inner) inner_blocks += static_cast<long>(of_group.extent(0));
  const std::size_t row = single ? sizeof(PartialForce<float>) : sizeof(PartialForce<double>);
  return {row * std::max(share.sent.extent(0), share.received.extent(0)), inner_blocks * elements_of_block};
}

template <class S>
void finish_messages(const PrecisionBuffers<S>& buffers, const ExecutionSpace& copies, Transport& transport) {
  transport.finish();
  if (buffers.received.copied) {
    Kokkos::deep_copy(copies, buffers.received.device, buffers.received.host);
    copies.fence();
  }
}

/// Null: by MPI.
std::unique_ptr<DeviceMessages> messages_for(RowWay wanted, Transport& transport, const ExchangeLoad& load) {
  if (wanted != RowWay::automatic && wanted != RowWay::nccl) return nullptr;
  auto messages = device_messages(transport, load);
  if (wanted == RowWay::nccl && !messages)
    throw std::runtime_error(
        "NCCL, which RAILWAVE_RANK_MESSAGES=nccl wants, cannot join the ranks: each needs a GPU of its own "
        "(NCCL_DEBUG=WARN says more). Unset the variable, and rows go the best way that there is");
  return messages;
}

/// Of those by MPI the one that all ranks have.
RowWay way_by_mpi(RowWay wanted, Transport& transport) {
  if (wanted != RowWay::automatic) return wanted;
  return transport.all_agree(on_device && transport.takes_device_memory()) ? RowWay::mpi : RowWay::host;
}

}  // namespace

RowExchange::RowExchange(const NodalState& nodal, RankShare share, Transport& transport,
                         std::unique_ptr<DeviceMessages> messages)
    : nodal_(nodal), share_(std::move(share)), transport_(transport), way_(wanted_row_way(transport)) {
  const bool single = nodal.partial.single_precision;
  if (!messages) messages = messages_for(way_, transport, load_of(share_, single));
  way_ = messages ? RowWay::nccl : way_by_mpi(way_, transport);
  buffers_ = std::make_unique<Buffers>(share_, way_, single);
  buffers_->on_devices = std::move(messages);
}

RowExchange::~RowExchange() = default;

void RowExchange::wait_for_rows(long ahead) const {
  transport_.wait_until([&] { return buffers_->unpacked.ahead() <= ahead; });
}

template <class Do>
void RowExchange::with_rows(const Do& act) const {
  if (nodal_.partial.single_precision)
    act(nodal_.partial.in_single, buffers_->in_single);
  else
    act(nodal_.partial.in_double, buffers_->in_double);
}

std::vector<Task> RowExchange::in_lane(RankLane lane, std::vector<Task> tasks) const {
  if (!buffers_->on_devices) return tasks;
  const ExecutionSpace* const space = &buffers_->on_devices->space(lane);
  for (Task& task : tasks) {
    task.rank_lane = lane;
    task.run = [run = std::move(task.run), space](const Instant& instant) {
      Instant here = instant;
      here.own_space = space;
      run(here);
    };
  }
  return tasks;
}

void RowExchange::pass(const std::vector<LaneWait>& waits) const {
  for (const LaneWait& wait : waits) buffers_->on_devices->wait(wait);
}

Task RowExchange::after(std::vector<LaneWait> waits, Task task) const {
  task.run = [this, waits, run = std::move(task.run)](const Instant& instant) {
    pass(waits);
    run(instant);
  };
  task.waits = std::move(waits);
  return task;
}

Task RowExchange::wait_task(std::vector<LaneWait> waits) const {
  Task task{"wait for what goes on beside", "b, c", [](const Instant&) {}};
  task.stage = Stage::own_forces;
  return after(std::move(waits), std::move(task));
}

std::vector<Task> RowExchange::begin_tasks() const {
  if (!buffers_->on_devices) return {};
  Task task = wait_task(others_wait());
  task.stage = Stage::begin;
  return {task};
}

template <class S>
void RowExchange::exchange_on_devices(const Array<PartialForce<S>*>& rows, const PrecisionBuffers<S>& buffers) const {
  const ExecutionSpace& space = buffers_->on_devices->space(RankLane::messages);
  pack(space, rows, buffers, share_);
  buffers_->on_devices->exchange(device_messages_of(buffers, share_));
  unpack(space, rows, buffers, share_);
  if (!recording_) buffers_->unpacked.put(space);
}

Task RowExchange::send_task(bool beside) {
  Task task{"forces on nodes of other ranks, sent", "b, c", [this](const Instant&) {
              with_rows([this](const auto& rows, const auto& buffers) {
                if (buffers_->on_devices) return exchange_on_devices(rows, buffers);
                pack(ExecutionSpace(), rows, buffers, share_);
                if (starts_late())
                  buffers_->packed.put(ExecutionSpace());
                else
                  start_messages(buffers, share_, buffers_->copies, transport_);
              });
            }};
  task.stage = Stage::own_forces;
  task.recordable = between_devices();
  task.rank_lane = RankLane::messages;
  return between_devices() && !beside ? after(others_wait(), std::move(task)) : task;
}

Task RowExchange::receive_task() {
  Task task{"forces of other ranks, received", "b, c", [this](const Instant&) {
              if (buffers_->on_devices) {
                if (!recording_) wait_for_rows(most_ahead);
                return;
              }
              with_rows([this](const auto& rows, const auto& buffers) {
                if (starts_late()) {
                  buffers_->packed.wait();
                  start_messages(buffers, share_, buffers_->copies, transport_);
                }
                finish_messages(buffers, buffers_->copies, transport_);
                unpack(ExecutionSpace(), rows, buffers, share_);
              });
            }};
  task.stage = Stage::own_forces;
  task.recordable = between_devices();
  return between_devices() ? after(inner_waits(), std::move(task)) : task;
}

std::unique_ptr<DeviceMessages::Recorded> RowExchange::record(const std::function<void()>& launch) {
  recording_ = true;
  try {
    auto recorded = buffers_->on_devices->record(launch);
    recording_ = false;
    return recorded;
  } catch (...) {
    recording_ = false;
    throw;
  }
}

void RowExchange::repeat(const DeviceMessages::Recorded& steps) {
  steps.launch();
  buffers_->unpacked.put(ExecutionSpace());
  wait_for_rows(most_ahead);
}

void RowExchange::in_order(const std::function<void()>& launch) const {
  pass(others_wait());
  launch();
  pass(inner_waits());
}

}  // namespace railwave
