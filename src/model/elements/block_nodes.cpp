#include "model/elements/block_nodes.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "kernels/elements/element_blocks.hpp"

namespace railwave {
namespace {

int rounds_of(const BlockNode& node) { return (node.corners + corners_at_once - 1) / corners_at_once; }

/// Nodes that threads ask for at once, each once: request by request, one for each corner of each group of threads.
std::vector<std::vector<int>> requests_of(const std::vector<CornerNodes>& elements, int threads) {
  std::vector<std::vector<int>> requests;
  for (std::size_t first = 0; first < elements.size(); first += threads)
    for (int N = 0; N < 8; ++N) {
      std::vector<int>& nodes = requests.emplace_back();
      for (std::size_t e = first; e < std::min(elements.size(), first + threads); ++e) nodes.push_back(elements[e][N]);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
  return requests;
}

/// Exchanges nodes of a warp as long as that makes fewer of those that are asked for at once lie in one bank.
class BankOrder {
 public:
  BankOrder(const std::vector<CornerNodes>& elements, int banks, std::vector<int>& place)
      : banks_(banks), place_(place), requests_(place.size()) {
    const auto requests = requests_of(elements, banks);
    in_bank_.assign(requests.size() * banks, 0);
    for (std::size_t r = 0; r < requests.size(); ++r)
      for (int n : requests[r]) {
        requests_[n].push_back(static_cast<int>(r) * banks);
        ++in_bank_[r * banks + bank(n)];
      }
  }

  /// @param group nodes that may take each other's places
  /// @return whether any did
  bool improve(const std::vector<int>& group) {
    bool any = false;
    for (int n : group) {
      int best = -1;
      long least = 0;
      for (int other : group) {
        const int from = bank(n), to = bank(other);
        if (from == to) continue;
        const long change = moved(n, from, to) + moved(other, to, from);
        if (change < least) {
          least = change;
          best = other;
        }
        moved(n, to, from);
        moved(other, from, to);
      }
      if (best < 0) continue;
      const int from = bank(n), to = bank(best);
      moved(n, from, to);
      moved(best, to, from);
      std::swap(place_[n], place_[best]);
      any = true;
    }
    return any;
  }

 private:
  int bank(int n) const { return place_[n] % banks_; }

  /// What many in one bank cost: more than in proportion, as it is the fullest that is waited for.
  static long cost(long in_bank) { return in_bank * in_bank * in_bank; }

  /// Moves a node to another bank. @return what that adds to the cost
  long moved(int n, int from, int to) {
    long change = 0;
    for (int r : requests_[n]) {
      int& before = in_bank_[r + from];
      int& after = in_bank_[r + to];
      change += cost(before - 1) - cost(before) + cost(after + 1) - cost(after);
      --before;
      ++after;
    }
    return change;
  }

  const int banks_;
  std::vector<int>& place_;
  std::vector<std::vector<int>> requests_;  ///< by node: where each one's banks begin
  std::vector<int> in_bank_;                ///< nodes, by request and bank
};

}  // namespace

void order_for_packs(std::vector<BlockNode>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const BlockNode& one, const BlockNode& other) {
    return std::tie(one.corners, one.mesh_number) < std::tie(other.corners, other.mesh_number);
  });
}

void order_for_warps(const std::vector<CornerNodes>& elements, int banks, std::vector<BlockNode>& nodes) {
  const int count = static_cast<int>(nodes.size());
  std::vector<int> ordered(count);
  std::iota(ordered.begin(), ordered.end(), 0);
  std::sort(ordered.begin(), ordered.end(), [&](int one, int other) {
    return std::make_pair(rounds_of(nodes[one]), nodes[one].number) <
           std::make_pair(rounds_of(nodes[other]), nodes[other].number);
  });
  std::vector<int> place(count);
  for (int l = 0; l < count; ++l) place[ordered[l]] = l;
  std::vector<std::vector<int>> groups;
  for (int l = 0; l < count; ++l) {
    if (l % warp_lanes == 0 || rounds_of(nodes[ordered[l]]) != rounds_of(nodes[ordered[l - 1]])) groups.emplace_back();
    groups.back().push_back(ordered[l]);
  }
  BankOrder order(elements, banks, place);
  // Most of what there is to gain comes in two sweeps, hardly anything after four.
  bool any = true;
  for (int sweep = 0; any && sweep < 4; ++sweep) {
    any = false;
    for (const std::vector<int>& group : groups) any = order.improve(group) || any;
  }
  const std::vector<BlockNode> before = nodes;
  for (int n = 0; n < count; ++n) nodes[place[n]] = before[n];
}

int bank_turns(const std::vector<CornerNodes>& elements, int banks, const std::vector<int>& place) {
  int turns = 0;
  for (const std::vector<int>& nodes : requests_of(elements, banks)) {
    std::vector<int> in_bank(banks, 0);
    for (int n : nodes) ++in_bank[place[n] % banks];
    turns += *std::max_element(in_bank.begin(), in_bank.end());
  }
  return turns;
}

}  // namespace railwave
