#include "model/elements/block_order.hpp"

#include <algorithm>
#include <cmath>

#include "model/elements/number_range.hpp"

namespace railwave {
namespace {

/// Splits a part's elements into compact blocks by halving: across the direction in which the group counts most
/// elements, between two layers of elements where that leaves both halves room in their blocks.
class Divider {
 public:
  Divider(const Assembly& assembly, const std::vector<int>& elements, int begin, int end, const BlockLimits& limits)
      : assembly_(assembly),
        limits_(limits),
        centre_(element_range(elements, begin, end), Vec3{}),
        extent_(element_range(elements, begin, end), Vec3{}),
        seen_(node_range(assembly.elements, elements, begin, end), -1) {
    for (int k = begin; k < end; ++k) {
      const int e = elements[k];
      Vec3 low = assembly.nodes[assembly.elements[e][0]], high = low;
      Vec3 sum{0, 0, 0};
      for (int n : assembly.elements[e])
        for (int i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], assembly.nodes[n][i]);
          high[i] = std::max(high[i], assembly.nodes[n][i]);
          sum[i] += 0.125 * assembly.nodes[n][i];
        }
      centre_[e] = sum;
      for (int i = 0; i < 3; ++i) extent_[e][i] = high[i] - low[i];
    }
  }

  /// Orders elements[begin, end) and appends the first place of each block.
  void divide(std::vector<int>& elements, int begin, int end, std::vector<int>& first) {
    const int count = end - begin;
    if (count <= limits_.elements && node_count(elements, begin, end) <= limits_.nodes) {
      std::sort(elements.begin() + begin, elements.begin() + end);
      first.push_back(begin);
      return;
    }
    const int middle = split(elements, begin, end);
    divide(elements, begin, middle, first);
    divide(elements, middle, end, first);
  }

 private:
  int node_count(const std::vector<int>& elements, int begin, int end) {
    ++stamp_;
    int count = 0;
    for (int k = begin; k < end; ++k)
      for (int n : assembly_.elements[elements[k]])
        if (seen_[n] != stamp_) {
          seen_[n] = stamp_;
          ++count;
        }
    return count;
  }

  int split(std::vector<int>& elements, int begin, int end) const {
    const int count = end - begin;
    Vec3 low = centre_[elements[begin]], high = low, size{0, 0, 0};
    for (int k = begin; k < end; ++k)
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], centre_[elements[k]][i]);
        high[i] = std::max(high[i], centre_[elements[k]][i]);
        size[i] += extent_[elements[k]][i] / count;
      }
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if ((high[i] - low[i]) * size[axis] > (high[axis] - low[axis]) * size[i]) axis = i;

    // A little room to spare lets large groups be cut between layers.
    const int blocks = std::max(2, static_cast<int>(std::ceil((count > 1500 ? 1.04 : 1.0) * count / limits_.elements)));
    const int left_blocks = blocks / 2;
    const int target = static_cast<int>(static_cast<long>(count) * left_blocks / blocks);
    const int layers = std::clamp(static_cast<int>((high[axis] - low[axis]) / size[axis] + 1.5), 2, 4096);
    const double thickness = (high[axis] - low[axis]) / (layers - 1);
    const auto layer_of = [&](int e) { return static_cast<int>((centre_[e][axis] - low[axis]) / thickness + 0.5); };
    std::vector<int> in_layer(layers + 1, 0);
    for (int k = begin; k < end; ++k) ++in_layer[std::min(layer_of(elements[k]), layers)];
    int below = 0, best = -1, best_layer = 0;
    for (int layer = 0; layer < layers; ++layer) {
      below += in_layer[layer];
      const bool fits =
          below <= left_blocks * limits_.elements && count - below <= (blocks - left_blocks) * limits_.elements;
      if (below == 0 || below == count || !fits) continue;
      if (best < 0 || std::abs(below - target) < std::abs(best - target)) {
        best = below;
        best_layer = layer;
      }
    }
    const auto from = elements.begin() + begin, to = elements.begin() + end;
    if (best > 0) {
      std::stable_partition(from, to, [&](int e) { return layer_of(e) <= best_layer; });
      return begin + best;
    }
    std::nth_element(from, from + target, to, [&](int a, int b) {
      for (int i = 0; i < 3; ++i) {
        const double x = centre_[a][(axis + i) % 3], y = centre_[b][(axis + i) % 3];
        if (x != y) return x < y;
      }
      return a < b;
    });
    return begin + target;
  }

  const Assembly& assembly_;
  const BlockLimits limits_;
  ValuesOfRange<Vec3> centre_, extent_;
  ValuesOfRange<int> seen_;
  int stamp_ = 0;
};

}  // namespace

void halve_into_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                       std::vector<int>& first, const BlockLimits& limits) {
  if (end > begin) Divider(assembly, elements, begin, end, limits).divide(elements, begin, end, first);
}

}  // namespace railwave
