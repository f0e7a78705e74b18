#include "solve/ranks/row_exchange.hpp"

#include <algorithm>
#include <stdexcept>

#include "kernels/elements/element_blocks.hpp"
#include "kernels/support/milestone.hpp"
#include "kernels/support/packed_rows.hpp"
#include "kernels/support/team.hpp"
#include "model/host_copy.hpp"
#include "solve/launch_graph.hpp"
#include "solve/ranks/device_messages.hpp"

namespace railwave {

/// Rows on the device, and on the host where messages are to have them there.
template <class Row>
struct RowBuffer {
  Array<Row*> device;
  PinnedArray<Row*> host;
  bool copied;  ///< between the two

  RowBuffer(std::size_t rows, RowWay way)
      : device(unset_array<Row*>("rows of other ranks", rows)), copied(on_device && way == RowWay::host) {
    if (copied) host = PinnedArray<Row*>("rows of other ranks, on the host", rows);
  }

  Row* of_messages() const { return copied ? host.data() : device.data(); }
};

template <class S>
struct PrecisionBuffers {
  RowBuffer<PartialForce<S>> sent, received;

  PrecisionBuffers(const RankShare& share, RowWay way, bool used)
      : sent(used ? share.sent.extent(0) : 0, way), received(used ? share.received.extent(0) : 0, way) {}
};

/// Where packed rows lie, on this GPU or a neighbour's.
struct RowPlaces {
  Array<PackedPiece*> rows, contact;
  const unsigned long long* exchanges = nullptr;
  unsigned long long over = 0;

  template <class S>
  PackedPieces<PartialForce<S>> of_rows() const {
    return {rows, exchanges, over};
  }
  PackedPieces<std::uint64_t> of_contact() const { return {contact, exchanges, over}; }
};

/// So many steps, or graphs of steps, the host launches before the device has come to the first of them: more would
/// gain nothing, and a rank that does not answer is found out by the wait for its rows.
constexpr long most_ahead = 2;

struct RowExchange::Buffers {
  PrecisionBuffers<double> in_double;
  PrecisionBuffers<float> in_single;
  RowBuffer<std::uint64_t> touched;  ///< contact forces from rank 0
  Milestone packed, unpacked;
  ExecutionSpace copies = separate_spaces(1).front();  ///< beside the inner blocks
  std::unique_ptr<DeviceMessages> on_devices;          ///< null: the host has MPI exchange rows
  RowPlaces sent, received;

  Buffers(const RankShare& share, RowWay way, bool single, std::unique_ptr<DeviceMessages> messages)
      : in_double(share, way, !single && !lends(messages)),
        in_single(share, way, single && !lends(messages)),
        touched(lends(messages) ? 0 : 3 * share.touched.extent(0), way),
        on_devices(std::move(messages)) {
    if (lends(on_devices))
      find_places_in(*on_devices->lent(), share, single);
    else if (single)
      find_places_in(in_single);
    else
      find_places_in(in_double);
  }

 private:
  static bool lends(const std::unique_ptr<DeviceMessages>& messages) { return messages && messages->lent() != nullptr; }

  template <class Row>
  static Array<PackedPiece*> one_piece(const RowBuffer<Row>& buffer) {
    return to_device("packed rows",
                     std::vector<PackedPiece>{{reinterpret_cast<unsigned char*>(buffer.device.data()), 0, 0}});
  }

  template <class S>
  void find_places_in(const PrecisionBuffers<S>& rows) {
    sent = {one_piece(rows.sent), one_piece(touched)};
    received = {one_piece(rows.received), one_piece(touched)};
  }

  /// A neighbour's part has rows, then contact forces.
  void find_places_in(const DeviceMessages::LentMemory& lent, const RankShare& share, bool single) {
    const long row = single ? sizeof(PartialForce<float>) : sizeof(PartialForce<double>);
    std::vector<PackedPiece> rows_sent, rows_received, contact;
    for (std::size_t k = 0; k < lent.parts.size(); ++k) {
      const RankShare::Neighbour& one = share.neighbours[k];
      const DeviceMessages::LentMemory::Part& part = lent.parts[k];
      rows_sent.push_back({part.sent, part.second_sent, one.first_sent});
      rows_received.push_back({part.received, part.second_received, one.first_received});
      const bool pushes = share.rank == 0;
      contact.push_back({pushes ? part.sent + row * one.sent_count : part.received + row * one.received_count,
                         pushes ? part.second_sent : part.second_received, 3 * one.first_touched});
    }
    const Array<PackedPiece*> of_contact = to_device("packed contact forces", contact);
    sent = {to_device("packed rows", rows_sent), of_contact, lent.exchanges, 0};
    received = {to_device("packed rows", rows_received), of_contact, lent.exchanges, 1};
  }
};

namespace {

/// What a rank sends and receives in a step: rows of partial forces, and the contact forces of rank 0.
template <class S>
struct ExchangedRows {
  Array<PartialForce<S>*> partial;
  Array<std::uint64_t* [3]> contact;
  const RankShare& share;
  const PrecisionBuffers<S>& buffers;
  const RowBuffer<std::uint64_t>& touched;
  const RowPlaces &sent, &received;

  bool pushes() const { return share.rank == 0; }
  bool is_pushed() const { return share.rank > 0; }
};

/// Both lists in one launch. @tparam There true: into the buffers; false: from them
template <bool There, class S>
void copy_rows(const ExecutionSpace& space, const ExchangedRows<S>& rows) {
  const RankShare& share = rows.share;
  const Array<int*>& places = There ? share.sent : share.received;
  const RowPlaces& packed = There ? rows.sent : rows.received;
  const int partial = static_cast<int>(places.extent(0));
  const int contact = There == rows.pushes() ? static_cast<int>(share.touched.extent(0)) : 0;
  using Partial = PackedValues<PartialForce<S>, There, PackedPieces<PartialForce<S>>>;
  using Contact = PackedRows<std::uint64_t, 3, There, PackedPieces<std::uint64_t>>;
  if (partial + contact > 0)
    Kokkos::parallel_for(There ? "pack_rows" : "unpack_rows", Range(space, 0, partial + contact),
                         OneAfterOther<Partial, Contact>{{rows.partial, places, 1, packed.template of_rows<S>()},
                                                         {rows.contact, share.touched, packed.of_contact()},
                                                         partial});
}

template <class S>
void pack(const ExecutionSpace& space, const ExchangedRows<S>& rows) {
  copy_rows<true>(space, rows);
}

template <class S>
void unpack(const ExecutionSpace& space, const ExchangedRows<S>& rows) {
  copy_rows<false>(space, rows);
}

/// Calls act(neighbour, first row, count of rows, buffer) for what is sent or received, in the order of the messages.
template <bool Sent, class S, class Do>
void each_message(const ExchangedRows<S>& rows, const Do& act) {
  for (const RankShare::Neighbour& one : rows.share.neighbours) {
    if constexpr (Sent)
      act(one.rank, one.first_sent, one.sent_count, rows.buffers.sent);
    else
      act(one.rank, one.first_received, one.received_count, rows.buffers.received);
    if (one.touched_count > 0 && (Sent ? rows.pushes() : rows.is_pushed()))
      act(one.rank, 3 * one.first_touched, 3 * one.touched_count, rows.touched);
  }
}

/// What has been packed comes after the last step's unpacking in the device's order, so that both buffers are free.
template <class S>
void start_messages(const ExchangedRows<S>& rows, const ExecutionSpace& copies, Transport& transport) {
  each_message<false>(rows, [&](int from, int first, int count, const auto& buffer) {
    auto* const row = buffer.of_messages() + first;
    transport.start_receive(from, row, sizeof(*row) * count);
  });
  if (rows.buffers.sent.copied) {
    Kokkos::deep_copy(copies, rows.buffers.sent.host, rows.buffers.sent.device);
    if (rows.pushes()) Kokkos::deep_copy(copies, rows.touched.host, rows.touched.device);
    copies.fence();
  }
  each_message<true>(rows, [&](int to, int first, int count, const auto& buffer) {
    const auto* const row = buffer.of_messages() + first;
    transport.start_send(to, row, sizeof(*row) * count);
  });
}

template <class S>
std::vector<DeviceMessages::Message> device_messages_of(const ExchangedRows<S>& rows) {
  std::vector<DeviceMessages::Message> messages;
  each_message<true>(rows, [&](int to, int first, int count, const auto& buffer) {
    const auto* const row = buffer.device.data() + first;
    messages.push_back({to, row, sizeof(*row) * count, nullptr, 0});
  });
  each_message<false>(rows, [&](int from, int first, int count, const auto& buffer) {
    auto* const row = buffer.device.data() + first;
    messages.push_back({from, nullptr, 0, row, sizeof(*row) * count});
  });
  return messages;
}

ExchangeLoad load_of(const RankShare& share, bool single) {
  const std::size_t row = single ? sizeof(PartialForce<float>) : sizeof(PartialForce<double>);
  ExchangeLoad load{{}, 0};
  for (const RankShare::Neighbour& one : share.neighbours) {
    const std::size_t pushes = sizeof(FixedForce) * one.touched_count;
    load.parts.push_back({one.rank, row * one.sent_count + (share.rank == 0 ? pushes : 0),
                          row * one.received_count + (share.rank > 0 ? pushes : 0)});
  }
  for (const Array<int*>& of_group : share.inner)
    load.elements += static_cast<long>(of_group.extent(0)) * elements_of_block;
  return load;
}

template <class S>
void finish_messages(const ExchangedRows<S>& rows, const ExecutionSpace& copies, Transport& transport) {
  transport.finish();
  if (!rows.buffers.received.copied) return;
  Kokkos::deep_copy(copies, rows.buffers.received.device, rows.buffers.received.host);
  if (rows.is_pushed()) Kokkos::deep_copy(copies, rows.touched.device, rows.touched.host);
  copies.fence();
}

/// Null: by MPI. @param way the one that was found, if any
std::unique_ptr<DeviceMessages> messages_for(RowWay wanted, Transport& transport, const ExchangeLoad& load,
                                             RowWay& way) {
  const auto may_be = [wanted](RowWay one) { return wanted == RowWay::automatic || wanted == one; };
  std::unique_ptr<DeviceMessages> messages;
  const auto try_way = [&](RowWay one, const auto& make) {
    if (messages || !may_be(one)) return;
    messages = make(transport, load);
    if (messages) way = one;
  };
  try_way(RowWay::direct, direct_messages);
  try_way(RowWay::nccl, nccl_messages);
  if (messages) return messages;
  if (wanted == RowWay::direct)
    throw std::runtime_error(
        "RAILWAVE_RANK_MESSAGES=direct wants GPUs that write into each other's memory, which the ranks' cannot: each "
        "needs one of its own, all in one host, and must see the others'. Unset the variable, and rows go the best way "
        "that there is");
  if (wanted == RowWay::nccl)
    throw std::runtime_error(
        "NCCL, which RAILWAVE_RANK_MESSAGES=nccl wants, cannot join the ranks: each needs a GPU of its own "
        "(NCCL_DEBUG=WARN says more). Unset the variable, and rows go the best way that there is");
  return nullptr;
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
  if (messages)
    way_ = RowWay::direct;
  else
    messages = messages_for(way_, transport, load_of(share_, single), way_);
  if (!messages) way_ = way_by_mpi(way_, transport);
  buffers_ = std::make_unique<Buffers>(share_, way_, single, std::move(messages));
}

RowExchange::~RowExchange() = default;

void RowExchange::wait_for_rows(long ahead) const {
  transport_.wait_until([&] { return buffers_->unpacked.ahead() <= ahead; });
}

template <class Do>
void RowExchange::with_rows(const Do& act) const {
  const Array<std::uint64_t* [3]>& contact = nodal_.external.sum.contact;
  const Buffers& all = *buffers_;
  if (nodal_.partial.single_precision)
    act(ExchangedRows<float>{nodal_.partial.in_single, contact, share_, all.in_single, all.touched, all.sent,
                             all.received});
  else
    act(ExchangedRows<double>{nodal_.partial.in_double, contact, share_, all.in_double, all.touched, all.sent,
                              all.received});
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

std::vector<Task> RowExchange::begin_tasks(std::vector<LaneWait> waits) const {
  if (!buffers_->on_devices) return {};
  Task task = wait_task(std::move(waits));
  task.stage = Stage::begin;
  return {task};
}

template <class Rows>
void RowExchange::exchange_on_devices(const Rows& rows) const {
  const ExecutionSpace& space = buffers_->on_devices->space(RankLane::messages);
  pack(space, rows);
  DeviceMessages& messages = *buffers_->on_devices;
  messages.exchange(messages.lent() != nullptr ? std::vector<DeviceMessages::Message>{} : device_messages_of(rows));
  unpack(space, rows);
  if (!recording_) buffers_->unpacked.put(space);
}

Task RowExchange::send_task(bool beside) {
  Task task{"forces on nodes of other ranks, sent", "b, c", [this](const Instant&) {
              with_rows([this](const auto& rows) {
                if (buffers_->on_devices) return exchange_on_devices(rows);
                pack(ExecutionSpace(), rows);
                if (starts_late())
                  buffers_->packed.put(ExecutionSpace());
                else
                  start_messages(rows, buffers_->copies, transport_);
              });
            }};
  task.stage = Stage::own_forces;
  task.recordable = between_devices();
  task.rank_lane = RankLane::messages;
  if (!between_devices()) return task;
  const std::vector<LaneWait> blocks{{RankLane::messages, RankLane::outer}, {RankLane::messages, RankLane::late}};
  return after(beside ? blocks : others_wait(), std::move(task));
}

Task RowExchange::receive_task() {
  Task task{"forces of other ranks, received", "b, c", [this](const Instant&) {
              if (buffers_->on_devices) {
                if (!recording_) wait_for_rows(most_ahead);
                return;
              }
              with_rows([this](const auto& rows) {
                if (starts_late()) {
                  buffers_->packed.wait();
                  start_messages(rows, buffers_->copies, transport_);
                }
                finish_messages(rows, buffers_->copies, transport_);
                unpack(ExecutionSpace(), rows);
              });
            }};
  task.stage = Stage::own_forces;
  task.recordable = between_devices();
  return between_devices() ? after(inner_waits(), std::move(task)) : task;
}

Task RowExchange::end_task() {
  Task task{"end of a step in lanes", "b, c", [this](const Instant&) {
              if (recording_) return;
              pass(inner_waits());
              wait_for_rows(most_ahead);
            }};
  task.stage = Stage::tied_motion;
  return task;
}

std::unique_ptr<DeviceMessages::Recorded> RowExchange::record(const std::function<void()>& launch) {
  recording_ = true;
  try {
    auto recorded = buffers_->on_devices->record([&] {
      launch();
      pass(inner_waits());
    });
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
