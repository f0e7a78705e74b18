#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <random>
#include <set>

#include "solve/launch_graph.hpp"

using railwave::fewest_edges;
using railwave::GraphEdges;

namespace {

/// Of each node that does something, those before it that do.
std::vector<std::set<int>> pasts(const GraphEdges& edges, const std::vector<bool>& empty) {
  const int count = static_cast<int>(empty.size());
  std::vector<std::vector<bool>> before(count, std::vector<bool>(count, false));
  for (const auto& [from, to] : edges) before[to][from] = true;
  for (int k = 0; k < count; ++k)
    for (int to = 0; to < count; ++to)
      for (int from = 0; from < count; ++from)
        if (before[to][k] && before[k][from]) before[to][from] = true;
  std::vector<std::set<int>> past(count);
  for (int to = 0; to < count; ++to)
    for (int from = 0; from < count; ++from)
      if (!empty[to] && !empty[from] && before[to][from]) past[to].insert(from);
  return past;
}

}  // namespace

TEST_CASE("a graph's edges go from one node that does something to another") {
  // 0 and 1 are joined by 2, for 3 and 4.
  const GraphEdges edges{{0, 2}, {1, 2}, {2, 3}, {2, 4}};
  CHECK(fewest_edges(edges, {false, false, true, false, false}) == GraphEdges{{0, 3}, {0, 4}, {1, 3}, {1, 4}});
  // An empty root, and one after the other.
  CHECK(fewest_edges({{0, 1}, {1, 2}, {2, 3}}, {true, false, true, false}) == GraphEdges{{1, 3}});
}

TEST_CASE("a graph's node does not wait for what others that it waits for have waited for") {
  CHECK(fewest_edges({{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}}, std::vector<bool>(4, false)) ==
        GraphEdges{{0, 1}, {1, 2}, {2, 3}});
  // The same through a join, in any order of numbers.
  CHECK(fewest_edges({{3, 2}, {2, 0}, {3, 1}, {0, 1}}, {true, false, false, false}) == GraphEdges{{2, 1}, {3, 2}});
}

TEST_CASE("graphs with the fewest edges have the order that they had") {
  std::mt19937 random(1);
  for (int graph = 0; graph < 50; ++graph) {
    const int count = 2 + static_cast<int>(random() % 30);
    std::vector<int> number(count);
    for (int n = 0; n < count; ++n) number[n] = n;
    std::shuffle(number.begin(), number.end(), random);
    GraphEdges edges;
    std::vector<bool> empty(count);
    for (int to = 0; to < count; ++to) {
      empty[number[to]] = random() % 3 == 0;
      for (int from = 0; from < to; ++from)
        if (random() % 5 == 0) edges.emplace_back(number[from], number[to]);
    }
    const GraphEdges fewest = fewest_edges(edges, empty);
    CHECK(pasts(fewest, empty) == pasts(edges, empty));
    // None can be left out.
    for (std::size_t k = 0; k < fewest.size(); ++k) {
      GraphEdges less = fewest;
      less.erase(less.begin() + static_cast<std::ptrdiff_t>(k));
      CHECK(pasts(less, empty) != pasts(edges, empty));
    }
  }
}
