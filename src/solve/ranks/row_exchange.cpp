#include "solve/ranks/row_exchange.hpp"

#include "kernels/support/packed_rows.hpp"

namespace railwave {

/// Rows on the device, and on the host where messages are; one memory where the device is the host.
template <class S>
struct RowBuffer {
  Array<PartialForce<S>*> device;
  typename Array<PartialForce<S>*>::HostMirror host;

  explicit RowBuffer(std::size_t rows)
      : device(unset_array<PartialForce<S>*>("rows of other ranks", rows)), host(Kokkos::create_mirror_view(device)) {}
};

struct RowExchange::Buffers {
  RowBuffer<double> sent, received;
  RowBuffer<float> sent_single, received_single;

  explicit Buffers(const RankShare& share, bool single)
      : sent(single ? 0 : share.sent.extent(0)),
        received(single ? 0 : share.received.extent(0)),
        sent_single(single ? share.sent.extent(0) : 0),
        received_single(single ? share.received.extent(0) : 0) {}
};

namespace {

template <class S>
void send(const Array<PartialForce<S>*>& rows, const RowBuffer<S>& sent, const RowBuffer<S>& received,
          const RankShare& share, Transport& transport) {
  const int count = static_cast<int>(share.sent.extent(0));
  if (count > 0)
    Kokkos::parallel_for("pack_rows", Range(0, count),
                         PackedValues<PartialForce<S>, true>{rows, share.sent, 1, sent.device});
  Kokkos::deep_copy(sent.host, sent.device);
  ExecutionSpace().fence();
  for (const RankShare::Neighbour& one : share.neighbours)
    transport.start_receive(one.rank, received.host.data() + one.first_received,
                            sizeof(PartialForce<S>) * one.received_count);
  for (const RankShare::Neighbour& one : share.neighbours)
    transport.start_send(one.rank, sent.host.data() + one.first_sent, sizeof(PartialForce<S>) * one.sent_count);
}

template <class S>
void receive(const Array<PartialForce<S>*>& rows, const RowBuffer<S>& received, const RankShare& share,
             Transport& transport) {
  transport.finish();
  Kokkos::deep_copy(received.device, received.host);
  const int count = static_cast<int>(share.received.extent(0));
  if (count > 0)
    Kokkos::parallel_for("unpack_rows", Range(0, count),
                         PackedValues<PartialForce<S>, false>{rows, share.received, 1, received.device});
}

}  // namespace

RowExchange::RowExchange(const NodalState& nodal, RankShare share, Transport& transport)
    : nodal_(nodal),
      share_(std::move(share)),
      transport_(transport),
      buffers_(std::make_unique<Buffers>(share_, nodal.partial.single_precision)) {}

RowExchange::~RowExchange() = default;

Task RowExchange::send_task() {
  Task task{"forces on nodes of other ranks, sent", "b, c", [this](const Instant&) {
              if (nodal_.partial.single_precision)
                send(nodal_.partial.in_single, buffers_->sent_single, buffers_->received_single, share_, transport_);
              else
                send(nodal_.partial.in_double, buffers_->sent, buffers_->received, share_, transport_);
            }};
  task.stage = Stage::own_forces;
  task.recordable = false;
  return task;
}

Task RowExchange::receive_task() {
  Task task{"forces of other ranks, received", "b, c", [this](const Instant&) {
              if (nodal_.partial.single_precision)
                receive(nodal_.partial.in_single, buffers_->received_single, share_, transport_);
              else
                receive(nodal_.partial.in_double, buffers_->received, share_, transport_);
            }};
  task.stage = Stage::own_forces;
  task.recordable = false;
  return task;
}

}  // namespace railwave
