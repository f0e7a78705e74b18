#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/elements/element_blocks.hpp"
#include "model/elements/block_order.hpp"

namespace railwave {
namespace {

/// In sizes of its elements, how far a scrap may be from what it is joined with: single precision counts on blocks
/// that lie together.
constexpr double farthest = 60;

struct Scrap {
  std::vector<int> elements, nodes;  ///< both ascending
  Vec3 centre{0, 0, 0};              ///< m
  double size = 0;                   ///< m, of an element
};

Scrap scrap_of(const Assembly& assembly, std::vector<int> elements) {
  Scrap scrap;
  double volume = 0;
  for (int e : elements) {
    Vec3 low = assembly.nodes[assembly.elements[e][0]], high = low;
    for (int n : assembly.elements[e]) {
      scrap.nodes.push_back(n);
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], assembly.nodes[n][i]);
        high[i] = std::max(high[i], assembly.nodes[n][i]);
        scrap.centre[i] += assembly.nodes[n][i] / (8.0 * static_cast<double>(elements.size()));
      }
    }
    volume += (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  }
  scrap.size = std::cbrt(volume / static_cast<double>(elements.size()));
  std::sort(scrap.nodes.begin(), scrap.nodes.end());
  scrap.nodes.erase(std::unique(scrap.nodes.begin(), scrap.nodes.end()), scrap.nodes.end());
  scrap.elements = std::move(elements);
  return scrap;
}

double distance(const Scrap& a, const Scrap& b) {
  double squared = 0;
  for (int i = 0; i < 3; ++i) squared += (a.centre[i] - b.centre[i]) * (a.centre[i] - b.centre[i]);
  return std::sqrt(squared);
}

std::vector<int> together(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

/// Joins a scrap with the nearest of others that has room. @return whether there was one
bool join_nearest(const Assembly& assembly, const Scrap& scrap, const BlockLimits& limits, std::vector<Scrap>& others) {
  Scrap* nearest = nullptr;
  double best = farthest * scrap.size;
  for (Scrap& other : others) {
    const double way = distance(scrap, other);
    if (way > best || static_cast<int>(scrap.elements.size() + other.elements.size()) > limits.elements ||
        static_cast<int>(together(scrap.nodes, other.nodes).size()) > limits.nodes)
      continue;
    best = way;
    nearest = &other;
  }
  if (nearest == nullptr) return false;
  *nearest = scrap_of(assembly, together(scrap.elements, nearest->elements));
  return true;
}

}  // namespace

void join_scraps(const Assembly& assembly, std::vector<int>& elements, int begin, int end, std::vector<int>& first,
                 std::size_t from, const BlockLimits& limits) {
  // Blocks of at most so many elements are joined with others: a team takes as long for them as for a full one.
  const int most_of_scrap = limits.elements / 2;
  std::vector<Scrap> scraps;
  std::vector<int> kept, kept_first;
  for (std::size_t p = from; p < first.size(); ++p) {
    const auto at = elements.begin() + first[p];
    const auto stop = p + 1 < first.size() ? elements.begin() + first[p + 1] : elements.begin() + end;
    if (stop - at <= most_of_scrap) {
      scraps.push_back(scrap_of(assembly, {at, stop}));
      continue;
    }
    kept_first.push_back(begin + static_cast<int>(kept.size()));
    kept.insert(kept.end(), at, stop);
  }
  // The largest first: what is left to join with them gets smaller.
  std::stable_sort(scraps.begin(), scraps.end(),
                   [](const Scrap& a, const Scrap& b) { return a.elements.size() > b.elements.size(); });
  std::vector<Scrap> joined;
  for (const Scrap& scrap : scraps)
    if (!join_nearest(assembly, scrap, limits, joined)) joined.push_back(scrap);
  for (const Scrap& scrap : joined) {
    kept_first.push_back(begin + static_cast<int>(kept.size()));
    kept.insert(kept.end(), scrap.elements.begin(), scrap.elements.end());
  }
  std::copy(kept.begin(), kept.end(), elements.begin() + begin);
  first.resize(from);
  first.insert(first.end(), kept_first.begin(), kept_first.end());
}

}  // namespace railwave
