#include "model/time_step/estimate_share.hpp"

#include <algorithm>
#include <unordered_map>

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
  const int blocks = (nodes + items_of_block - 1) / items_of_block;
  const double first_share = share_of_rank_0(ranks);
  for (int r = 1; r < ranks; ++r)
    first.push_back(static_cast<int>(blocks * (r - 1 + first_share) / (ranks - 1 + first_share)) * items_of_block);
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

bool EstimateShare::possible(const scene::Scene& scene) { return !on_device && scene.ties.empty(); }

double EstimateShare::part_of(int rank, int ranks) {
  const double first_share = share_of_rank_0(ranks);
  return (rank == 0 ? first_share : 1) / (ranks - 1 + first_share);
}

EstimateShare::EstimateShare(const AssembledScene& assembled, const NodalState& nodal, Transport& transport)
    : transport_(transport), ranges_(ranges_of(static_cast<int>(assembled.assembly.nodes.size()), transport.ranks())) {
  assembled_.scene = assembled.scene;
  const int own_rank = transport.rank();
  std::vector<std::vector<int>> sent(transport.ranks()), received(transport.ranks());
  std::vector<int> others;
  for (const auto& corners : assembled.assembly.elements) {
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
    if (*most < ranges_[own_rank] || *least >= ranges_[own_rank + 1]) continue;
    if (*least >= ranges_[own_rank] && *most < ranges_[own_rank + 1]) continue;
    std::vector<int> ranks;
    for (int n : corners) ranks.push_back(rank_of(ranges_, n));
    if (std::find(ranks.begin(), ranks.end(), own_rank) == ranks.end()) continue;
    for (int N = 0; N < 8; ++N) {
      if (ranks[N] != own_rank) {
        others.push_back(corners[N]);
        received[ranks[N]].push_back(corners[N]);
        continue;
      }
      for (int other : ranks)
        if (other != own_rank) sent[other].push_back(corners[N] - ranges_[own_rank]);
    }
  }
  sort_and_join(others);
  int first = own_count();
  for (int r = 0; r < transport.ranks(); ++r) {
    sort_and_join(sent[r]);
    sort_and_join(received[r]);
    if (sent[r].empty() && received[r].empty()) continue;
    neighbours_.push_back({r, sent[r], first, static_cast<int>(received[r].size())});
    first += static_cast<int>(received[r].size());
  }
  take_nodes(assembled, nodal, others);
  take_elements(assembled, others);
  std::size_t rows = 0;
  for (const Neighbour& one : neighbours_) rows += one.sent.size();
  packed_.resize(3 * rows);
  const int all = ranges_.back(), own = own_count();
  const int blocks = ((own_rank == 0 ? all : own) + items_of_block - 1) / items_of_block;
  sums_.resize(blocks);
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

void EstimateShare::take_elements(const AssembledScene& whole, const std::vector<int>& others) {
  const int begin = first_node(), end = begin + own_count();
  std::unordered_map<int, int> place;  // of nodes of other ranks
  for (std::size_t k = 0; k < others.size(); ++k) place[others[k]] = own_count() + static_cast<int>(k);
  const auto is_own = [&](int n) { return n >= begin && n < end; };
  const auto has_own = [&](const auto& corners) { return std::any_of(corners.begin(), corners.end(), is_own); };
  const auto& all = whole.assembly.elements;
  assembled_.assembly.elements.reserve(std::count_if(all.begin(), all.end(), has_own));
  for (const auto& part : whole.assembly.parts) {
    Assembly::PartRange range = part;
    range.first_element = static_cast<int>(assembled_.assembly.elements.size());
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e) {
      auto corners = all[e];
      if (!has_own(corners)) continue;
      for (int& n : corners) n = is_own(n) ? n - begin : place[n];
      assembled_.assembly.elements.push_back(corners);
    }
    range.element_count = static_cast<int>(assembled_.assembly.elements.size()) - range.first_element;
    assembled_.assembly.parts.push_back(range);
  }
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
  const int own = own_count(), blocks = (own + items_of_block - 1) / items_of_block;
  if (own > 0)
    Kokkos::parallel_for("reduce_blocks", SpreadRange(0, blocks),
                         BlockSum<InnerProduct>{{a, b}, own, blocks, sums_.data()});
  double all = 0;
  if (transport_.rank() == 0) {
    for (int r = 1; r < transport_.ranks(); ++r) {
      const int first = ranges_[r] / items_of_block;
      const int count = (ranges_[r + 1] - ranges_[r] + items_of_block - 1) / items_of_block;
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
