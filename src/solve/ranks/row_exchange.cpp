#include "solve/ranks/row_exchange.hpp"

#include <algorithm>

#include "kernels/elements/element_blocks.hpp"
#include "kernels/support/milestone.hpp"
#include "kernels/support/packed_rows.hpp"
#include "kernels/support/team.hpp"
#include "solve/launch_graph.hpp"
#include "solve/ranks/device_messages.hpp"

namespace railwave {

/// Rows on the device, and on the host where messages are; one memory where the device is the host.
template <class S>
struct RowBuffer {
  Array<PartialForce<S>*> device;
  PinnedArray<PartialForce<S>*> host;

  explicit RowBuffer(std::size_t rows) : device(unset_array<PartialForce<S>*>("rows of other ranks", rows)) {
    if constexpr (on_device)
      host = PinnedArray<PartialForce<S>*>("rows of other ranks, on the host", rows);
    else
      host = device;
  }
};

template <class S>
struct PrecisionBuffers {
  RowBuffer<S> sent, received;

  PrecisionBuffers(const RankShare& share, bool used)
      : sent(used ? share.sent.extent(0) : 0), received(used ? share.received.extent(0) : 0) {}
};

/// So many steps, or graphs of steps, the host launches before the device has come to the first of them: more would
/// gain nothing, and a rank that does not answer is found out by the wait for its rows.
constexpr long most_ahead = 2;

struct RowExchange::Buffers {
  PrecisionBuffers<double> in_double;
  PrecisionBuffers<float> in_single;
  Milestone packed, unpacked;
  ExecutionSpace copies = separate_spaces(1).front();  ///< beside the inner blocks
  std::unique_ptr<DeviceMessages> on_devices;          ///< null: rows go through the host

  Buffers(const RankShare& share, bool single) : in_double(share, !single), in_single(share, single) {}
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
    transport.start_receive(one.rank, received.host.data() + one.first_received,
                            sizeof(PartialForce<S>) * one.received_count);
  if constexpr (on_device) {
    Kokkos::deep_copy(copies, sent.host, sent.device);
    copies.fence();
  }
  for (const RankShare::Neighbour& one : share.neighbours)
    transport.start_send(one.rank, sent.host.data() + one.first_sent, sizeof(PartialForce<S>) * one.sent_count);
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
  if constexpr (on_device) {
    Kokkos::deep_copy(copies, buffers.received.device, buffers.received.host);
    copies.fence();
  }
}

}  // namespace

RowExchange::RowExchange(const NodalState& nodal, RankShare share, Transport& transport)
    : nodal_(nodal),
      share_(std::move(share)),
      transport_(transport),
      buffers_(std::make_unique<Buffers>(share_, nodal.partial.single_precision)) {
  buffers_->on_devices = device_messages(transport, load_of(share_, nodal.partial.single_precision));
}

RowExchange::~RowExchange() = default;

bool RowExchange::between_devices() const { return buffers_->on_devices != nullptr; }

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

std::vector<Task> RowExchange::begin_tasks() {
  if (!buffers_->on_devices) return {};
  return {{"beginning of outer blocks", "b, c", [this](const Instant&) { buffers_->on_devices->begin(); }}};
}

const ExecutionSpace* RowExchange::outer_space() const {
  return buffers_->on_devices ? &buffers_->on_devices->space() : nullptr;
}

const ExecutionSpace* RowExchange::side_space() const {
  return buffers_->on_devices ? &buffers_->on_devices->side_space() : nullptr;
}

template <class S>
void RowExchange::exchange_on_devices(const Array<PartialForce<S>*>& rows, const PrecisionBuffers<S>& buffers) const {
  const ExecutionSpace& space = *outer_space();
  pack(space, rows, buffers, share_);
  buffers_->on_devices->exchange(device_messages_of(buffers, share_));
  unpack(space, rows, buffers, share_);
  if (!recording_) buffers_->unpacked.put(space);
}

Task RowExchange::send_task(bool beside) {
  Task task{"forces on nodes of other ranks, sent", "b, c", [this, beside](const Instant&) {
              if (buffers_->on_devices && !beside) buffers_->on_devices->begin();
              with_rows([this](const auto& rows, const auto& buffers) {
                if (buffers_->on_devices) return exchange_on_devices(rows, buffers);
                pack(ExecutionSpace(), rows, buffers, share_);
                // A host is done with them now; a device has yet to begin, and gets the inner blocks first.
                if constexpr (on_device)
                  buffers_->packed.put(ExecutionSpace());
                else
                  start_messages(buffers, share_, buffers_->copies, transport_);
              });
            }};
  task.stage = Stage::own_forces;
  task.recordable = between_devices();
  return task;
}

Task RowExchange::receive_task() {
  Task task{"forces of other ranks, received", "b, c", [this](const Instant&) {
              if (buffers_->on_devices) {
                buffers_->on_devices->finish();
                if (!recording_) wait_for_rows(most_ahead);
                return;
              }
              with_rows([this](const auto& rows, const auto& buffers) {
                if constexpr (on_device) {
                  buffers_->packed.wait();
                  start_messages(buffers, share_, buffers_->copies, transport_);
                }
                finish_messages(buffers, buffers_->copies, transport_);
                unpack(ExecutionSpace(), rows, buffers, share_);
              });
            }};
  task.stage = Stage::own_forces;
  task.recordable = between_devices();
  return task;
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
  buffers_->on_devices->begin();
  launch();
  buffers_->on_devices->finish();
}

}  // namespace railwave
