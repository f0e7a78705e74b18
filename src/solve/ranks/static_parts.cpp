#include "solve/ranks/static_parts.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "model/time_step/estimate_share.hpp"
#include "model/time_step/tangent_operator.hpp"
#include "solve/ranks/rank_team.hpp"

namespace railwave {
namespace {

enum class Order : int { place, apply, end };

/// First nodes of the ranks' ranges, and the number of nodes at the end: alike many corners of elements for each.
std::vector<int> ranges_of(const Assembly& assembly, int ranks) {
  const int nodes = static_cast<int>(assembly.nodes.size());
  std::vector<long> before(nodes + 1, 0);
  for (const auto& corners : assembly.elements)
    for (int n : corners) ++before[n + 1];
  for (int n = 0; n < nodes; ++n) before[n + 1] += before[n];
  std::vector<int> first;
  for (int r = 0; r <= ranks; ++r)
    first.push_back(
        static_cast<int>(std::lower_bound(before.begin(), before.end(), before.back() * r / ranks) - before.begin()));
  first.front() = 0;
  first.back() = nodes;
  return first;
}

}  // namespace

/// A rank's elements, with numbers of its own for their nodes.
struct StaticParts::Part {
  /// Numbers of nodes, elements and parts of the scene.
  struct Size {
    int own = 0, nodes = 0, elements = 0, parts = 0;
  } size;
  Assembly assembly;
  std::vector<ElementStiffness> stiffness;  ///< by part of the scene
  std::unique_ptr<TangentOperator> tangent;
  NodeVector position, u, f;

  /// Once elements and ranges of parts are there, of which the ranges stay.
  void make() {
    assembly.nodes.resize(size.nodes);
    tangent = std::make_unique<TangentOperator>(assembly);
    const auto parts = assembly.parts;
    assembly = {};
    assembly.parts = parts;
    position = unset_array<double* [3]>("places of a rank's part", size.nodes);
    u = unset_array<double* [3]>("displacements of a rank's part", size.nodes);
    f = unset_array<double* [3]>("forces of a rank's part", size.nodes);
  }

  void apply() const { tangent->apply(assembly, stiffness, position, u, 0, f); }
};

namespace {

/// Of nodes of [begin, end). @param others their elements' other nodes, ascending
std::unique_ptr<StaticParts::Part> part_of(const AssembledScene& assembled, int begin, int end,
                                           std::vector<int>& others) {
  ElementsAround around = elements_around(assembled.assembly, begin, end);
  others = std::move(around.others);
  auto part = std::make_unique<StaticParts::Part>();
  part->assembly.elements = std::move(around.elements);
  part->assembly.parts = std::move(around.parts);
  for (std::size_t p = 0; p < assembled.scene.parts.size(); ++p)
    part->stiffness.push_back(
        settling_stiffness(assembled.scene.parts[p], assembled.scene.materials[assembled.assembly.parts[p].material]));
  part->size = {end - begin, end - begin + static_cast<int>(others.size()),
                static_cast<int>(part->assembly.elements.size()), static_cast<int>(part->stiffness.size())};
  return part;
}

template <class T>
void send_all(Transport& transport, int rank, const std::vector<T>& values) {
  transport.start_send(rank, values.data(), sizeof(T) * values.size());
}

template <class T>
void receive_all(Transport& transport, std::vector<T>& values, int count) {
  values.resize(count);
  transport.start_receive(0, values.data(), sizeof(T) * values.size());
}

/// Numbers of elements alone.
std::vector<int> counts_of(const Assembly& assembly) {
  std::vector<int> counts;
  for (const auto& range : assembly.parts) counts.push_back(range.element_count);
  return counts;
}

void send_part(const StaticParts::Part& part, int rank, Transport& transport) {
  const std::vector<int> counts = counts_of(part.assembly);
  transport.start_send(rank, &part.size, sizeof part.size);
  send_all(transport, rank, counts);
  send_all(transport, rank, part.stiffness);
  send_all(transport, rank, part.assembly.elements);
  transport.finish();
}

StaticParts::Part receive_part(Transport& transport) {
  StaticParts::Part part;
  transport.start_receive(0, &part.size, sizeof part.size);
  transport.finish();
  std::vector<int> counts;
  receive_all(transport, counts, part.size.parts);
  receive_all(transport, part.stiffness, part.size.parts);
  receive_all(transport, part.assembly.elements, part.size.elements);
  transport.finish();
  int first = 0;
  for (int count : counts) {
    Assembly::PartRange& range = part.assembly.parts.emplace_back();
    range.first_element = first;
    range.element_count = count;
    first += count;
  }
  part.make();
  return part;
}

/// Others wait for an order as long as rank 0 takes.
template <class T>
void give(Transport& transport, T order) {
  transport.broadcast(&order, sizeof order);
}

template <class T>
T order_of_rank_0(Transport& transport) {
  T order{};
  transport.broadcast(&order, sizeof order);
  return order;
}

}  // namespace

StaticParts::StaticParts(const AssembledScene& assembled, Transport& transport) : transport_(transport) {
  RankOrder settle;
  settle.kind = RankOrder::settle;
  give(transport, settle);
  const std::vector<int> first = ranges_of(assembled.assembly, transport.ranks());
  for (int r = 0; r < transport.ranks(); ++r) {
    Rows& rows = rows_.emplace_back(Rows{first[r], first[r + 1] - first[r], {}, {}});
    auto part = part_of(assembled, first[r], first[r + 1], rows.others);
    if (r == 0) {
      own_ = std::move(part);
      own_->make();
      continue;
    }
    rows.packed.resize(3 * static_cast<std::size_t>(part->size.nodes));
    give(transport, r);
    send_part(*part, r, transport);
  }
}

StaticParts::~StaticParts() {
  try {
    give(transport_, Order::end);
  } catch (const std::exception&) {
    // The others find out at their next meeting.
  }
}

void StaticParts::pack(const Rows& rows, const NodeVector& vector, double* to) {
  const double* const from = vector.data();
  to = std::copy_n(from + 3L * rows.first, 3L * rows.count, to);
  for (int n : rows.others) to = std::copy_n(from + 3L * n, 3, to);
}

void StaticParts::send(const NodeVector& vector, const NodeVector& own) {
  ExecutionSpace().fence();
  for (int r = 1; r < transport_.ranks(); ++r) {
    std::vector<double>& packed = rows_[r].packed;
    pack(rows_[r], vector, packed.data());
    transport_.start_send(r, packed.data(), sizeof(double) * packed.size());
  }
  pack(rows_[0], vector, own.data());
}

void StaticParts::place(const NodeVector& position) {
  give(transport_, Order::place);
  send(position, own_->position);
  transport_.finish();
}

void StaticParts::apply(const NodeVector& u, const NodeVector& f) {
  give(transport_, Order::apply);
  for (int r = 1; r < transport_.ranks(); ++r)
    transport_.start_receive(r, f.data() + 3L * rows_[r].first, sizeof(double) * 3 * rows_[r].count);
  send(u, own_->u);
  own_->apply();
  ExecutionSpace().fence();
  std::copy_n(own_->f.data(), 3L * rows_[0].count, f.data());
  transport_.finish();
}

void follow_static_parts(Transport& transport) {
  StaticParts::Part part;
  for (int r = 1; r < transport.ranks(); ++r)
    if (order_of_rank_0<int>(transport) == transport.rank()) part = receive_part(transport);
  const auto receive = [&](const NodeVector& vector) {
    transport.start_receive(0, vector.data(), sizeof(double) * 3 * part.size.nodes);
    transport.finish();
  };
  for (;;) switch (order_of_rank_0<Order>(transport)) {
      case Order::place:
        receive(part.position);
        break;
      case Order::apply:
        receive(part.u);
        part.apply();
        ExecutionSpace().fence();
        transport.start_send(0, part.f.data(), sizeof(double) * 3 * part.size.own);
        transport.finish();
        break;
      case Order::end:
        return;
    }
}

}  // namespace railwave
