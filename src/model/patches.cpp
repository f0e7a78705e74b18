#include "model/patches.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/patches.hpp"

namespace railwave {
namespace {

/// Splits a part's elements into compact patches by halving: across the direction in which the group counts most elements,
/// between two layers of elements where that leaves both halves room in their patches.
class Divider {
 public:
  explicit Divider(const Assembly& assembly)
      : assembly_(assembly), centre_(assembly.elements.size()), extent_(assembly.elements.size()), seen_(assembly.nodes.size(), -1) {
    for (std::size_t e = 0; e < assembly.elements.size(); ++e) {
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

  /// Orders elements[begin, end) and appends the first place of each patch.
  void divide(std::vector<int>& elements, int begin, int end, std::vector<int>& first) {
    const int count = end - begin;
    if (count <= patch_size && node_count(elements, begin, end) <= patch_nodes) {
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
    const int patches = std::max(2, static_cast<int>(std::ceil((count > 1500 ? 1.04 : 1.0) * count / patch_size)));
    const int left_patches = patches / 2;
    const int target = static_cast<int>(static_cast<long>(count) * left_patches / patches);
    const int layers = std::clamp(static_cast<int>((high[axis] - low[axis]) / size[axis] + 1.5), 2, 4096);
    const double thickness = (high[axis] - low[axis]) / (layers - 1);
    const auto layer_of = [&](int e) { return static_cast<int>((centre_[e][axis] - low[axis]) / thickness + 0.5); };
    std::vector<int> in_layer(layers + 1, 0);
    for (int k = begin; k < end; ++k) ++in_layer[std::min(layer_of(elements[k]), layers)];
    int below = 0, best = -1, best_layer = 0;
    for (int layer = 0; layer < layers; ++layer) {
      below += in_layer[layer];
      const bool fits = below <= left_patches * patch_size && count - below <= (patches - left_patches) * patch_size;
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
  std::vector<Vec3> centre_, extent_;
  std::vector<int> seen_;
  int stamp_ = 0;
};

/// New number of each node.
std::vector<int> node_order(const Assembly& assembly, const std::vector<int>& elements, const std::vector<int>& first) {
  const int patches = static_cast<int>(first.size()) - 1;
  std::vector<int> last_patch(assembly.nodes.size(), -1), number(assembly.nodes.size(), -1);
  std::vector<char> shared(assembly.nodes.size(), 0);
  for (int p = 0; p < patches; ++p)
    for (int k = first[p]; k < first[p + 1]; ++k)
      for (int n : assembly.elements[elements[k]]) {
        if (last_patch[n] >= 0 && last_patch[n] != p) shared[n] = 1;
        last_patch[n] = p;
      }
  for (const auto& part : assembly.parts) {
    int next = part.first_node;
    for (int p = 0; p < patches; ++p) {
      const bool own = first[p] >= part.first_element && first[p] < part.first_element + part.element_count;
      if (!own) continue;
      std::vector<int> fresh;
      for (int k = first[p]; k < first[p + 1]; ++k)
        for (int n : assembly.elements[elements[k]])
          if (number[n] == -1) {
            number[n] = -2;
            fresh.push_back(n);
          }
      std::sort(fresh.begin(), fresh.end(),
                [&](int a, int b) { return shared[a] != shared[b] ? shared[a] > shared[b] : a < b; });
      for (int n : fresh) number[n] = next++;
    }
    for (int n = part.first_node; n < part.first_node + part.node_count; ++n)
      if (number[n] < 0) number[n] = next++;  // of no element; refused later, with its place
  }
  for (int n : assembly.point_nodes) number[n] = n;
  return number;
}

void renumber(Assembly& assembly, const std::vector<int>& elements, const std::vector<int>& node_number) {
  std::vector<int> element_number(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) element_number[elements[k]] = static_cast<int>(k);
  std::vector<Vec3> nodes(assembly.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[node_number[n]] = assembly.nodes[n];
  assembly.nodes = std::move(nodes);
  std::vector<std::array<int, 8>> corners(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k)
    for (int N = 0; N < 8; ++N) corners[k][N] = node_number[assembly.elements[elements[k]][N]];
  assembly.elements = std::move(corners);
  for (auto& [name, set] : assembly.node_sets)
    for (int& n : set) n = node_number[n];
  for (auto& [name, set] : assembly.element_sets)
    for (int& e : set) e = element_number[e];
  for (auto& [name, surface] : assembly.surfaces)
    for (Face& face : surface) face.element = element_number[face.element];
}

}  // namespace

PatchOrder order_in_patches(Assembly& assembly, const std::vector<int>& levels) {
  std::vector<int> elements(assembly.elements.size());
  PatchOrder order;
  auto& first = order.first_element;
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e] = static_cast<int>(e);
  Divider divider(assembly);
  const auto level_of = [&](int e) { return levels.empty() ? 0 : levels[e]; };
  for (const auto& part : assembly.parts) {
    const auto begin = elements.begin() + part.first_element, end = begin + part.element_count;
    std::stable_sort(begin, end, [&](int a, int b) { return level_of(a) < level_of(b); });
    for (auto same = begin; same != end;) {
      const int level = level_of(*same);
      const auto next = std::find_if(same, end, [&](int e) { return level_of(e) != level; });
      divider.divide(elements, static_cast<int>(same - elements.begin()), static_cast<int>(next - elements.begin()), first);
      order.level.resize(first.size(), level);
      same = next;
    }
  }
  first.push_back(static_cast<int>(elements.size()));
  const auto number = node_order(assembly, elements, first);
  order.mesh_number.resize(number.size());
  for (std::size_t n = 0; n < number.size(); ++n) order.mesh_number[number[n]] = static_cast<int>(n);
  renumber(assembly, elements, number);
  return order;
}

}  // namespace railwave
