#include "model/time_step/estimate_share.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "kernels/support/block_sum.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Rank 0's share over another's. It has the whole mesh, lengths and masses beside it, so that few ranks take alike
/// memory with this share; of many ranks all take more when the model is made. Bytes of an element: others' mesh and
/// own steps, lengths and masses, the search.
double share_of_rank_0(int ranks) {
  constexpr double mesh = 61, values = 16, search = 396, least = 0.5;
  const double more = (values + mesh * (ranks - 1) / ranks) / search;
  return std::max(least, (1 - more * (ranks - 1)) / (1 + more));
}

/// Ranges begin where blocks of sums do.
std::vector<int> ranges_of(int nodes, int ranks) {
  std::vector<int> first{0};
  const int blocks = (nodes + sum_block - 1) / sum_block;
  const double first_share = share_of_rank_0(ranks);
  for (int r = 1; r < ranks; ++r)
    first.push_back(static_cast<int>(blocks * (r - 1 + first_share) / (ranks - 1 + first_share)) * sum_block);
  first.push_back(nodes);
  return first;
}

int rank_of(const std::vector<int>& ranges, int node) {
  return static_cast<int>(std::upper_bound(ranges.begin(), ranges.end() - 1, node) - ranges.begin()) - 1;
}

void sort_and_join(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// What BlockSum's sums come to, as Reductions adds them.
double sum_of_blocks(const std::vector<double>& blocks) {
  double all = 0;
  const std::size_t count = blocks.size();
  if (count <= static_cast<std::size_t>(sum_block)) {
    for (double one : blocks) all += one;
    return all;
  }
  for (std::size_t begin = 0; begin < count; begin += sum_block) {
    double part = 0;
    for (std::size_t b = begin; b < std::min(count, begin + sum_block); ++b) part += blocks[b];
    all += part;
  }
  return all;
}

}  // namespace

ElementsAround elements_around(const Assembly& whole, int begin, int end) {
  ElementsAround around;
  auto& [elements, parts, others] = around;
  const auto in_range = [&](int n) { return n >= begin && n < end; };
  const auto is_around = [&](const CornerNodes& corners) {
    return std::any_of(corners.begin(), corners.end(), in_range);
  };
  elements.reserve(std::count_if(whole.elements.begin(), whole.elements.end(), is_around));
  for (const Assembly::PartRange& part : whole.parts) {
    Assembly::PartRange& range = parts.emplace_back(part);
    range.first_element = static_cast<int>(elements.size());
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
      const CornerNodes& corners = whole.elements[e];
      if (!is_around(corners)) continue;
      elements.push_back(corners);
      std::copy_if(corners.begin(), corners.end(), std::back_inserter(others), [&](int n) { return !in_range(n); });
    }
    range.element_count = static_cast<int>(elements.size()) - range.first_element;
  }
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  for (CornerNodes& corners : elements)
    for (int& n : corners)
      n = in_range(n)
              ? n - begin
              : end - begin + static_cast<int>(std::lower_bound(others.begin(), others.end(), n) - others.begin());
  return around;
}

bool EstimateShare::possible(const scene::Scene& scene) { return !on_device && scene.ties.empty(); }

double EstimateShare::part_of(int rank, int ranks) {
  const double first_share = share_of_rank_0(ranks);
  return (rank == 0 ? first_share : 1) / (ranks - 1 + first_share);
}

EstimateShare::EstimateShare(const AssembledScene& assembled, const NodalState& nodal, Transport& transport)
    : transport_(transport), ranges_(ranges_of(static_cast<int>(assembled.assembly.nodes.size()), transport.ranks())) {
  assembled_.scene = assembled.scene;
  ElementsAround around = elements_around(assembled.assembly, first_node(), first_node() + own_count());
  find_neighbours(around);
  take_nodes(assembled, nodal, around.others);
  assembled_.assembly.elements = std::move(around.elements);
  assembled_.assembly.parts = std::move(around.parts);
  std::size_t rows = 0;
  for (const Neighbour& one : neighbours_) rows += one.sent.size();
  packed_.resize(3 * rows);
  const int all = ranges_.back(), own = own_count();
  const int blocks = ((transport.rank() == 0 ? all : own) + sum_block - 1) / sum_block;
  sums_.resize(blocks);
}

void EstimateShare::find_neighbours(const ElementsAround& around) {
  const int own = own_count();
  std::vector<std::vector<int>> sent(transport_.ranks());
  for (const CornerNodes& corners : around.elements)
    for (int other : corners) {
      if (other < own) continue;
      std::vector<int>& rows = sent[rank_of(ranges_, around.others[other - own])];
      std::copy_if(corners.begin(), corners.end(), std::back_inserter(rows), [&](int n) { return n < own; });
    }
  auto first = around.others.begin();
  for (int r = 0; r < transport_.ranks(); ++r) {
    if (r == transport_.rank()) continue;
    sort_and_join(sent[r]);
    // Ranks' ranges ascend like the nodes.
    const auto last = std::lower_bound(first, around.others.end(), ranges_[r + 1]);
    if (first != last)
      neighbours_.push_back(
          {r, sent[r], own + static_cast<int>(first - around.others.begin()), static_cast<int>(last - first)});
    first = last;
  }
}

void EstimateShare::take_nodes(const AssembledScene& whole, const NodalState& nodal, const std::vector<int>& others) {
  std::vector<int> numbers(own_count());
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = first_node() + static_cast<int>(k);
  numbers.insert(numbers.end(), others.begin(), others.end());
  const auto all_masses = to_host(nodal.nodes.mass);
  const auto all_constraints = to_host(nodal.nodes.constraint);
  std::vector<double> mass;
  std::vector<int> constraint;
  mass.reserve(numbers.size());
  constraint.reserve(numbers.size());
  assembled_.assembly.nodes.reserve(numbers.size());
  for (int n : numbers) {
    assembled_.assembly.nodes.push_back(whole.assembly.nodes[n]);
    mass.push_back(all_masses(n));
    constraint.push_back(all_constraints(n));
  }
  nodal_.nodes.count = static_cast<int>(numbers.size());
  nodal_.nodes.mass = to_device("mass", mass);
  nodal_.nodes.constraint = to_device("constraint", constraint);
  nodal_.nodes.reference = to_device("reference", assembled_.assembly.nodes);
  nodal_.nodes.position = nodal_.nodes.reference;
  nodal_.constraints = nodal.constraints;
}

void EstimateShare::forget_mesh() {
  const auto parts = assembled_.assembly.parts;
  assembled_.assembly = {};
  assembled_.assembly.parts = parts;
}

ContactOnNodes EstimateShare::own_part(const ContactOnNodes& whole) const {
  const auto part = [&](const std::vector<double>& values) {
    return values.empty()
               ? values
               : std::vector<double>(values.begin() + first_node(), values.begin() + first_node() + own_count());
  };
  return {part(whole.stiffness), part(whole.damping)};
}

void EstimateShare::bring(const NodeVector& rows) const {
  if constexpr (on_device) return;  // it is not shared there
  double* next = packed_.data();
  double* const values = rows.data();
  for (const Neighbour& one : neighbours_)
    transport_.start_receive(one.rank, values + 3L * one.first_received, sizeof(double) * 3 * one.received_count);
  for (const Neighbour& one : neighbours_) {
    double* const first = next;
    for (int n : one.sent) next = std::copy(values + 3L * n, values + 3L * n + 3, next);
    transport_.start_send(one.rank, first, sizeof(double) * 3 * one.sent.size());
  }
  transport_.finish();
}

double EstimateShare::sum(const NodeVector& a, const NodeVector& b) const {
  const int own = own_count(), blocks = (own + sum_block - 1) / sum_block;
  if (own > 0)
    Kokkos::parallel_for("sum_blocks", SpreadRange(0, blocks), BlockSum<InnerProduct>{{a, b}, own, sums_.data()});
  double all = 0;
  if (transport_.rank() == 0) {
    for (int r = 1; r < transport_.ranks(); ++r) {
      const int first = ranges_[r] / sum_block;
      const int count = (ranges_[r + 1] - ranges_[r] + sum_block - 1) / sum_block;
      if (count > 0) transport_.start_receive(r, sums_.data() + first, sizeof(double) * count);
    }
    transport_.finish();
    all = sum_of_blocks(sums_);
  } else if (blocks > 0) {
    transport_.start_send(0, sums_.data(), sizeof(double) * blocks);
    transport_.finish();
  }
  transport_.broadcast(&all, sizeof all);
  return all;
}

}  // namespace railwave
