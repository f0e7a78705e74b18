#include "solve/ranks/rank_team.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/memory.hpp"
#include "model/host_copy.hpp"
#include "model/ranks/mesh_share.hpp"
#include "model/time_step/deformed_elements.hpp"
#include "solve/monitor/account.hpp"
#include "solve/ranks/static_parts.hpp"
#include "solve/step_recording.hpp"

namespace railwave {
namespace {

/// What another rank computes of a step: elements, and the motion of their nodes.
Plan follower_plan(Model& model, StepKind kind, RowExchange& exchange) {
  Plan plan;
  if (model.relative.active()) plan.forces.push_back(corotating_frames_task(model, model.elements, model, kind));
  append(plan.forces, frame_tasks(model, model, kind));
  append(plan.forces, shared_force_tasks(model, kind, exchange, {}));
  plan.motion = rank_motion_tasks(model, kind, exchange, {});
  return plan;
}

/// What a rank has measured of its elements and nodes.
struct MessageOfMeasures {
  Extreme jacobian, distortion, speed, acceleration;

  static MessageOfMeasures of(const MonitorMeasures& all) {
    return {all.jacobian, all.distortion, all.speed, all.acceleration};
  }
  MonitorMeasures measures() const { return {jacobian, distortion, speed, acceleration, {}, {}}; }
};

template <class T>
void send_to_rank_0(Transport& transport, const T& value) {
  transport.start_send(0, &value, sizeof value);
  transport.finish();
}

/// Of a model as it was built: alike for the same case, settings and program.
std::uint64_t fingerprint(const Model& model) {
  std::uint64_t hash = 14695981039346656037ull;  // of Fowler, Noll and Vo
  const auto add = [&hash](const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < bytes; ++k) hash = (hash ^ byte[k]) * 1099511628211ull;
  };
  const auto mass = to_host(model.nodes.mass);
  const double end = model.scene.time.end;
  add(mass.data(), sizeof(double) * mass.extent(0));
  add(&end, sizeof end);
  add(model.scene.static_text.data(), model.scene.static_text.size());
  return hash;
}

/// Steps of another rank than 0 need the arrays alone.
void forget_mesh(Model& model) {
  model.assembly = {};
  model.order = {};
  model.own_steps = std::vector<float>();
}

/// Rank 0's co-rotating frames, which follow from all nodes, to all ranks.
void share_frames(Model& model, Transport& transport) {
  RelativeNodes& relative = model.relative;
  if (!relative.active()) return;
  const auto share = [&transport](auto& value) { transport.broadcast(&value, sizeof value); };
  share(relative.begun);
  share(relative.block_step);
  share(relative.block_time);
  share(relative.block_size);
  relative.host_motion.resize(relative.range.size());
  transport.broadcast(relative.host_motion.data(), sizeof(FrameMotion) * relative.host_motion.size());
  const auto steps = to_host(relative.steps);
  transport.broadcast(steps.data(), sizeof(FrameStep) * steps.extent(0));
  if (transport.rank() == 0) return;
  Kokkos::deep_copy(relative.steps, steps);
  if (relative.begun) place_frames(model.elements, model);
}

/// Whether ranks that follow an order wait for their devices, whose rows must have come before.
bool waits_for_device(RankOrder::Kind kind) { return kind != RankOrder::advance; }

Instant instant_of(const RankOrder& order) {
  Instant instant;
  instant.time = order.time;
  instant.step = order.size;
  instant.elapsed = order.elapsed;
  return instant;
}

}  // namespace

RankLeader::RankLeader(Model& model, Transport& transport)
    : model_(model), transport_(transport), state_transfer_(model, transport) {
  give_order(RankOrder::deal_out, {});
  if (!rank_0_needs_all(model.scene)) keep_mesh_of_blocks(model, 0);
  const BlockPartition partition = partition_of(model, transport.ranks());
  const RankLayout layout = lay_out_ranks(model, partition);
  for (int r = 0; r < transport.ranks(); ++r) items_.push_back(items_of(model, partition, layout, r));
  own_ = own_items(model, items_[0]);
  exchange_ = std::make_unique<RowExchange>(model, take_share(model, partition, layout, 0), transport);
  give_freed_memory_back();
}

RankLeader::~RankLeader() {
  if (std::uncaught_exceptions() > exceptions_) return;  // the others may be in the middle of a step
  try {
    end_followers(transport_);
  } catch (const std::exception&) {
    // A rank that has ended needs no order.
  }
}

void RankLeader::give_order(RankOrder::Kind kind, const Instant& instant, long steps) {
  RankOrder order;
  order.kind = kind;
  order.steps = steps;
  order.step = model_.step;
  order.size = instant.step;
  order.elapsed = instant.elapsed;
  order.time = instant.time;
  order.velocity_lag = model_.velocity_lag;
  if (kind == RankOrder::deal_out) order.model = fingerprint(model_);
  give_order(order);
}

void RankLeader::give_order(RankOrder order) {
  if (exchange_ && waits_for_device(order.kind)) exchange_->wait_for_rows();
  transport_.broadcast(&order, sizeof order);
}

void RankLeader::begin(bool at_start) {
  if (!model_.whole_mesh) forget_mesh_of_blocks(model_);
  // Models begin alike where nothing has moved them yet.
  if (at_start && !model_.filled) return;
  give_order(RankOrder::take_state, {});
  if (model_.relative.active() && model_.relative.host_motion.empty()) find_frames(model_, model_);
  share_frames(model_, transport_);
  for (int r = 1; r < transport_.ranks(); ++r) state_transfer_.send(r, items_[r], Transferred::state);
  whole_ = true;
}

void RankLeader::advance(const Instant& instant, long steps) {
  whole_ = false;
  give_order(RankOrder::advance, instant, steps);
}

void RankLeader::sample(const Instant& instant) {
  whole_ = false;
  give_order(RankOrder::sample, instant);
}

void RankLeader::move(const Instant& instant) {
  whole_ = false;
  give_order(RankOrder::move, instant);
}

void RankLeader::take(Transferred what) {
  for (int r = 1; r < transport_.ranks(); ++r) state_transfer_.receive(r, items_[r], what);
  ++counts_[static_cast<int>(what)];
}

void RankLeader::gather_mesh() {
  if (model_.whole_mesh) return;
  give_order(RankOrder::gather_mesh, {});
  put_back(piece_of_arrays(model_, items_[0]), items_[0], model_);
  for (int r = 1; r < transport_.ranks(); ++r) {
    MeshPiece piece = empty_piece(model_, items_[r]);
    transport_.start_receive(r, piece.elements.data(), sizeof(piece.elements[0]) * piece.elements.size());
    transport_.start_receive(r, piece.nodes.data(), sizeof(Vec3) * piece.nodes.size());
    transport_.finish();
    put_back(piece, items_[r], model_);
  }
  model_.whole_mesh = true;
}

void RankLeader::gather() {
  gather_mesh();
  fill_rest(model_);
  if (whole_) return;
  give_order(RankOrder::gather, {});
  take(Transferred::state);
  whole_ = true;
}

void RankLeader::gather_fields() {
  if (whole_) return;
  const auto& fields = model_.scene.output.fields;
  const bool places =
      std::all_of(fields.begin(), fields.end(), [](const auto& name) { return name == "displacement"; });
  if (!places) return gather();
  give_order(RankOrder::gather_places, {});
  take(Transferred::places);
}

void RankLeader::begin_sums(SampledSums what, double step) {
  Instant instant;
  instant.step = step;
  give_order(what == SampledSums::energies ? RankOrder::energies : RankOrder::histories, instant);
}

void RankLeader::take_sums(SampledSums what) {
  take(what == SampledSums::energies ? Transferred::energies : Transferred::histories);
}

void RankLeader::join_measures(MonitorMeasures& own) {
  give_order(RankOrder::measures, {});
  for (int r = 1; r < transport_.ranks(); ++r) {
    MessageOfMeasures message;
    transport_.start_receive(r, &message, sizeof message);
    transport_.finish();
    join(own, message.measures());
  }
}

double RankLeader::largest_rate(double own) {
  give_order(RankOrder::rate, {});
  for (int r = 1; r < transport_.ranks(); ++r) {
    double other = 0;
    transport_.start_receive(r, &other, sizeof other);
    transport_.finish();
    own = std::fmax(own, other);
  }
  return own;
}

template <class Found>
void RankLeader::join_found(Found& own) {
  for (int r = 1; r < transport_.ranks(); ++r) {
    Found other;
    transport_.start_receive(r, &other, sizeof other);
    transport_.finish();
    join(own, other);
  }
}

void RankLeader::join_deformed(DeformedNow& own, double first_limit, double second_limit) {
  RankOrder order;
  order.kind = RankOrder::deformed;
  order.limits[0] = first_limit;
  order.limits[1] = second_limit;
  give_order(order);
  join_found(own);
}

void RankLeader::join_deformed(DeformedAhead& own, double limit, double step, double least) {
  RankOrder order;
  order.kind = RankOrder::deforming;
  order.limits[0] = limit;
  order.limits[1] = step;
  order.limits[2] = least;
  give_order(order);
  join_found(own);
}

std::vector<double> RankLeader::peak_memories() {
  give_order(RankOrder::memory, {});
  std::vector<double> peaks(transport_.ranks(), peak_memory());
  for (int r = 1; r < transport_.ranks(); ++r) {
    transport_.start_receive(r, &peaks[r], sizeof(double));
    transport_.finish();
  }
  return peaks;
}

std::string RankLeader::summary() const {
  const auto each = [this](Transferred what) {
    const long count = counts_[static_cast<int>(what)];
    return 1e-3 * state_transfer_.bytes(what) / static_cast<double>(std::max(1L, count));
  };
  const auto count = [this](Transferred what) { return counts_[static_cast<int>(what)]; };
  return fmt::format(
      "{} ranks, rows {}; to rank 0 came: energies {} times, {:.4g} kB each; histories {} times, {:.4g} kB each; the "
      "whole state {} times, {:.4g} kB each",
      transport_.ranks(), description(exchange_->way()), count(Transferred::energies), each(Transferred::energies),
      count(Transferred::histories), each(Transferred::histories), count(Transferred::state), each(Transferred::state));
}

void end_followers(Transport& transport) {
  if (transport.followers_have_ended) return;
  transport.followers_have_ended = true;
  RankOrder order;
  transport.broadcast(&order, sizeof order);
}

void follow_rank_0(Model& model, Transport& transport) {
  RankOrder first;
  for (;;) {
    transport.broadcast(&first, sizeof first);
    if (first.kind != RankOrder::settle) break;
    follow_static_parts(transport);
  }
  if (first.kind == RankOrder::end) return;
  if (first.model != fingerprint(model))
    throw std::runtime_error(
        "this process has another model than rank 0: all that mpirun starts must be given the same program, case and "
        "settings");
  const BlockPartition partition = partition_of(model, transport.ranks());
  RankLayout layout = lay_out_ranks(model, partition);
  const ShareItems items = items_of(model, partition, layout, transport.rank());
  RowExchange exchange(model, take_share(model, partition, layout, transport.rank()), transport);
  StateTransfer state_transfer(model, transport);
  const OwnItems own = own_items(model, items);
  std::unique_ptr<MonitorArrays> monitored;
  if (model.scene.monitor.active)
    monitored = std::make_unique<MonitorArrays>(model.assembly, std::vector<ContactPair>(), &own);
  const DeformedElements elements = deformed_elements(model, &own);
  layout = {};
  forget_mesh(model);
  give_freed_memory_back();
  StepPlans plans(model, follower_plan(model, StepKind::advancing, exchange),
                  follower_plan(model, StepKind::sampled, exchange));
  LaunchOrder order_of_launches;
  StepRecording recording(model, plans.of(StepKind::advancing), order_of_launches, &exchange);
  const auto advance = [&](Instant instant, long steps) {
    for (const long end = model.step + steps; model.step < end; instant.elapsed = instant.step) {
      // No task of these ranks asks for the time.
      const long recorded = recording.advance(instant, end - model.step, [&](long) { return instant.time; });
      if (recorded > 0) {
        plans.advance_clock(instant, recorded);
      } else {
        plans.compute_forces(instant, StepKind::advancing);
        plans.advance(instant);
      }
    }
  };
  for (;;) {
    RankOrder order;
    transport.broadcast(&order, sizeof order);
    if (waits_for_device(order.kind)) {
      exchange.wait_for_rows();
      recording.finish();
    }
    const Instant instant = instant_of(order);
    switch (order.kind) {
      case RankOrder::take_state:
        model.step = order.step;
        model.velocity_lag = order.velocity_lag;
        share_frames(model, transport);
        state_transfer.receive(0, items, Transferred::state);
        break;
      case RankOrder::advance:
        advance(instant, order.steps);
        break;
      case RankOrder::sample:
        plans.compute_forces(instant, StepKind::sampled);
        break;
      case RankOrder::gather:
        state_transfer.send(0, items, Transferred::state);
        break;
      case RankOrder::gather_mesh: {
        const MeshPiece piece = piece_of_arrays(model, items);
        transport.start_send(0, piece.elements.data(), sizeof(piece.elements[0]) * piece.elements.size());
        transport.start_send(0, piece.nodes.data(), sizeof(Vec3) * piece.nodes.size());
        transport.finish();
        break;
      }
      case RankOrder::gather_places:
        state_transfer.send(0, items, Transferred::places);
        break;
      case RankOrder::energies:
        sum_own_parts(model, SampledSums::energies, order.size);
        state_transfer.send(0, items, Transferred::energies);
        break;
      case RankOrder::histories:
        sum_own_parts(model, SampledSums::histories, order.size);
        state_transfer.send(0, items, Transferred::histories);
        break;
      case RankOrder::measures:
        send_to_rank_0(transport, MessageOfMeasures::of(monitored->measure(model, {})));
        break;
      case RankOrder::deformed:
        if (model.relative.begun) update_absolute_nodes(model);
        send_to_rank_0(transport, measure_now(elements, model, order.limits[0], order.limits[1]));
        break;
      case RankOrder::deforming:
        send_to_rank_0(transport, measure_ahead(elements, model, order.limits[0], order.limits[1], order.limits[2]));
        break;
      case RankOrder::rate:
        send_to_rank_0(transport, monitored->largest_rate(model));
        break;
      case RankOrder::memory:
        send_to_rank_0(transport, peak_memory());
        break;
      case RankOrder::move:
        plans.advance(instant);
        break;
      case RankOrder::settle:
      case RankOrder::deal_out:
      case RankOrder::end:
        return;
    }
  }
}

}  // namespace railwave
