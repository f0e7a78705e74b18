#include "model/elements/block_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/elements/number_range.hpp"

namespace railwave {
namespace {

/// What an element's freedom and distance weigh against a node that it shares with the block. Of the values tried
/// (freedom 0 to 0.15, distance 0.05 to 1) these left the fewest blocks of the rolling scene, with 50 thousand
/// elements and a million.
constexpr double freedom_weight = 0.06, distance_weight = 0.2;

constexpr int no_block = -1, not_asked_for = -2;

class Grower {
 public:
  Grower(const Assembly& assembly, const std::vector<int>& elements, int begin, int end, const BlockLimits& limits)
      : Grower(assembly, elements, begin, end, limits, element_range(elements, begin, end),
               node_range(assembly.elements, elements, begin, end)) {}

  void divide(std::vector<int>& elements, int begin, int end, std::vector<int>& first) {
    const std::vector<int> all(elements.begin() + begin, elements.begin() + end);
    // Blocks begin where the least room is left, so that no scraps stay behind.
    std::set<std::pair<int, int>> edge;  // freedom when it was last looked at, element
    auto next = all.begin();
    int place = begin;
    for (int p = 0; place < end; ++p) {
      int seed = -1;
      while (seed < 0 && !edge.empty()) {
        const auto [freedom_before, e] = *edge.begin();
        edge.erase(edge.begin());
        if (block_[e] != no_block) continue;
        const int now = freedom(e);
        if (now == freedom_before)
          seed = e;
        else
          edge.insert({now, e});
      }
      if (seed < 0) seed = *(next = std::find_if(next, all.end(), [&](int e) { return block_[e] == no_block; }));
      first.push_back(place);
      for (int e : grow(seed, p)) elements[place++] = e;
      std::sort(elements.begin() + first.back(), elements.begin() + place);
      for (int e : considered_)
        if (block_[e] == no_block) edge.insert({freedom(e), e});
    }
  }

 private:
  Grower(const Assembly& assembly, const std::vector<int>& elements, int begin, int end, const BlockLimits& limits,
         const NumberRange& numbers, const NumberRange& nodes)
      : assembly_(assembly),
        limits_(limits),
        first_around_({nodes.first, nodes.last + 1}, 0),
        left_(nodes, 0),
        centre_(numbers, Vec3{}),
        block_(numbers, not_asked_for),
        shared_(numbers, 0),
        considered_by_(numbers, no_block),
        staged_by_(nodes, no_block) {
    for (int k = begin; k < end; ++k) {
      const int e = elements[k];
      block_[e] = no_block;
      for (int n : assembly.elements[e]) {
        ++left_[n];
        for (int i = 0; i < 3; ++i) centre_[e][i] += 0.125 * assembly.nodes[n][i];
      }
    }
    for (int n = nodes.first; n <= nodes.last; ++n) first_around_[n + 1] = first_around_[n] + left_[n];
    around_.resize(8 * static_cast<std::size_t>(end - begin));
    ValuesOfRange<int> filled = first_around_;
    for (int k = begin; k < end; ++k)
      for (int n : assembly.elements[elements[k]]) around_[filled[n]++] = elements[k];
  }

  /// Elements that lie around an element's corners and are in no block yet.
  int freedom(int e) const {
    int sum = 0;
    for (int n : assembly_.elements[e]) sum += left_[n];
    return sum;
  }

  double size(int e) const {
    const Vec3 &a = assembly_.nodes[assembly_.elements[e][0]], &b = assembly_.nodes[assembly_.elements[e][6]];
    return std::sqrt(((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) + (b[2] - a[2]) * (b[2] - a[2])) /
                     3);
  }

  std::vector<int> grow(int seed, int number) {
    std::vector<int> block;
    considered_.clear();
    node_count_ = 0;
    Vec3 sum{0, 0, 0};
    const double scale = distance_weight / size(seed);
    for (int e = seed; e >= 0; e = best(number, sum, static_cast<double>(block.size()), scale)) {
      take(e, number);
      block.push_back(e);
      for (int i = 0; i < 3; ++i) sum[i] += centre_[e][i];
      if (static_cast<int>(block.size()) == limits_.elements) break;
    }
    return block;
  }

  void take(int e, int number) {
    block_[e] = number;
    for (int n : assembly_.elements[e]) {
      --left_[n];
      if (staged_by_[n] == number) continue;
      staged_by_[n] = number;
      ++node_count_;
      for (int k = first_around_[n]; k < first_around_[n + 1]; ++k) {
        const int other = around_[k];
        if (block_[other] != no_block) continue;
        if (considered_by_[other] != number) {
          considered_by_[other] = number;
          shared_[other] = 0;
          considered_.push_back(other);
        }
        ++shared_[other];
      }
    }
  }

  /// The element that brings the fewest new nodes, fills a gap, and lies near the block's middle; -1: none has room.
  int best(int number, const Vec3& sum, double count, double scale) {
    int chosen = -1;
    double highest = std::numeric_limits<double>::lowest();
    std::size_t kept = 0;
    for (int e : considered_) {
      if (block_[e] == number) continue;
      considered_[kept++] = e;
      if (node_count_ + 8 - shared_[e] > limits_.nodes) continue;
      double squared = 0;
      for (int i = 0; i < 3; ++i) squared += (centre_[e][i] - sum[i] / count) * (centre_[e][i] - sum[i] / count);
      const double score = shared_[e] - freedom_weight * freedom(e) - scale * std::sqrt(squared);
      if (score > highest) {
        highest = score;
        chosen = e;
      }
    }
    considered_.resize(kept);
    return chosen;
  }

  const Assembly& assembly_;
  const BlockLimits limits_;
  ValuesOfRange<int> first_around_;  ///< of each node: where the elements around it begin
  std::vector<int> around_;          ///< of the elements to divide
  ValuesOfRange<int> left_;          ///< of each node: how many of those around it are in no block yet
  ValuesOfRange<Vec3> centre_;       ///< m
  ValuesOfRange<int> block_;         ///< of each element
  ValuesOfRange<int> shared_;        ///< nodes of a considered element that are the growing block's
  ValuesOfRange<int> considered_by_;
  std::vector<int> considered_;
  ValuesOfRange<int> staged_by_;  ///< last block that took a node
  int node_count_ = 0;
};

}  // namespace

void grow_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first,
                 const BlockLimits& limits) {
  const std::size_t from = first.size();
  Grower(assembly, elements, begin, end, limits).divide(elements, begin, end, first);
  join_scraps(assembly, elements, begin, end, first, from, limits);
}

}  // namespace railwave
