#include "solve/launch_graph.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

namespace railwave {
namespace {

/// What each node waits for.
class Ancestry {
 public:
  Ancestry(const GraphEdges& edges, const std::vector<bool>& empty)
      : empty_(empty), from_(empty.size()), nodes_(empty.size()) {
    for (const auto& [from, to] : edges) from_[to].push_back(from);
  }

  /// Nodes that do something and that a node waits for, without any that another of these has waited for. Ascending.
  const std::vector<int>& direct(int node) {
    Node& known = nodes_[node];
    if (known.found) return known.direct;
    known.found = true;
    std::vector<int> candidates;
    for (int one : from_[node]) {
      const std::vector<int>& before = direct(one);
      if (empty_[one])
        candidates.insert(candidates.end(), before.begin(), before.end());
      else
        candidates.push_back(one);
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    known.past.assign(empty_.size(), false);
    for (int one : candidates) {
      const std::vector<bool>& before = nodes_[one].past;
      std::transform(before.begin(), before.end(), known.past.begin(), known.past.begin(), std::logical_or<>());
    }
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(known.direct),
                 [&known](int one) { return !known.past[one]; });
    for (int one : known.direct) known.past[one] = true;
    return known.direct;
  }

 private:
  struct Node {
    bool found = false;
    std::vector<int> direct;
    std::vector<bool> past;  ///< of each node, whether this one comes after it
  };

  const std::vector<bool>& empty_;
  std::vector<std::vector<int>> from_;
  std::vector<Node> nodes_;
};

}  // namespace

GraphEdges fewest_edges(const GraphEdges& edges, const std::vector<bool>& empty) {
  Ancestry ancestry(edges, empty);
  GraphEdges fewest;
  for (std::size_t node = 0; node < empty.size(); ++node) {
    if (empty[node]) continue;
    const int to = static_cast<int>(node);
    for (int from : ancestry.direct(to)) fewest.emplace_back(from, to);
  }
  std::sort(fewest.begin(), fewest.end());
  return fewest;
}

}  // namespace railwave
