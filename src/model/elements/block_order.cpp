#include "model/elements/block_order.hpp"

#include <algorithm>
#include <utility>

#include "model/elements/number_range.hpp"

namespace railwave {
namespace {

/// A few blocks less do not make up for the rows that grown ones leave ragged: a block of 4 million elements is 9 %
/// slower.
constexpr double worthwhile_share = 0.95;

/// A node that a block has more takes as long as an element gains in a row, or somewhat longer.
constexpr double worth_of_row = 0.3;

void divide_into_blocks(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                        std::vector<int>& first) {
  std::vector<int> grown = elements, first_halved, first_grown;
  halve_into_blocks(assembly, elements, begin, end, first_halved);
  // Full ones all of them: growing cannot do better, and takes a second for a million elements.
  const std::size_t fewest = (end - begin + elements_of_block - 1) / elements_of_block;
  const double few = worthwhile_share * static_cast<double>(first_halved.size());
  if (fewest < few) grow_blocks(assembly, grown, begin, end, first_grown);
  const bool grows = fewest < few && first_grown.size() < few;
  if (grows) std::copy(grown.begin() + begin, grown.begin() + end, elements.begin() + begin);
  const std::vector<int>& found = grows ? first_grown : first_halved;
  first.insert(first.end(), found.begin(), found.end());
}

/// Blocks of 5 x 5 x 5 elements have the fewest nodes an element.
constexpr double fewest_nodes_of_element = 216.0 / 125;

/// Nodes of all blocks from first[from] on, those of several counted for each.
double node_count(const Assembly& assembly, const std::vector<int>& elements, const std::vector<int>& first,
                  std::size_t from, int end) {
  ValuesOfRange<int> seen(node_range(assembly.elements, elements, first[from], end), -1);
  double count = 0;
  for (std::size_t p = from; p < first.size(); ++p)
    for (int k = first[p]; k < (p + 1 < first.size() ? first[p + 1] : end); ++k)
      for (int n : assembly.elements[elements[k]]) {
        if (seen[n] == static_cast<int>(p)) continue;
        seen[n] = static_cast<int>(p);
        ++count;
      }
  return count;
}

/// The same with as many elements as possible in rows.
/// @param elements ascending from begin to end
void divide_with_rows(const Assembly& assembly, std::vector<int>& elements, int begin, int end,
                      std::vector<int>& first) {
  const std::size_t from = first.size();
  const int left = gather_rows(assembly, elements, begin, end, first);
  if (left < end) divide_into_blocks(assembly, elements, left, end, first);
  if (left == begin || left == end) return;
  // What rows are worth, in nodes. Blocks without are found only where they can have so few.
  const double as_good = node_count(assembly, elements, first, from, end) - worth_of_row * (left - begin);
  if (fewest_nodes_of_element * (end - begin) > as_good) return;
  std::vector<int> plain = elements, first_plain(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(from));
  std::sort(plain.begin() + begin, plain.begin() + end);
  divide_into_blocks(assembly, plain, begin, end, first_plain);
  if (node_count(assembly, plain, first_plain, from, end) > as_good) return;
  // In place, for the caller has iterators.
  std::copy(plain.begin() + begin, plain.begin() + end, elements.begin() + begin);
  first = std::move(first_plain);
}

/// New number of each node.
std::vector<int> node_order(const Assembly& assembly, const std::vector<int>& elements, const std::vector<int>& first) {
  const int blocks = static_cast<int>(first.size()) - 1;
  std::vector<int> last_block(assembly.nodes.size(), -1), number(assembly.nodes.size(), -1);
  std::vector<char> shared(assembly.nodes.size(), 0);
  for (int p = 0; p < blocks; ++p)
    for (int k = first[p]; k < first[p + 1]; ++k)
      for (int n : assembly.elements[elements[k]]) {
        if (last_block[n] >= 0 && last_block[n] != p) shared[n] = 1;
        last_block[n] = p;
      }
  for (const auto& part : assembly.parts) {
    int next = part.first_node;
    for (int p = 0; p < blocks; ++p) {
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
  // Points and nodes inside beams come after those of the parts.
  for (std::size_t n = 0; n < number.size(); ++n)
    if (number[n] == -1) number[n] = static_cast<int>(n);
  return number;
}

/// Moves each value to its new place, without a second list of them: they are the largest that a mesh has.
template <class T>
void put_in_order(std::vector<T>& values, const std::vector<int>& place) {
  std::vector<bool> moved(values.size(), false);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (moved[k]) continue;
    T value = values[k];
    for (auto to = static_cast<std::size_t>(place[k]); !moved[to]; to = static_cast<std::size_t>(place[to])) {
      std::swap(value, values[to]);
      moved[to] = true;
    }
  }
}

void renumber(Assembly& assembly, const std::vector<int>& elements, const std::vector<int>& node_number) {
  std::vector<int> element_number(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) element_number[elements[k]] = static_cast<int>(k);
  put_in_order(assembly.nodes, node_number);
  for (auto& corners : assembly.elements)
    for (int& n : corners) n = node_number[n];
  put_in_order(assembly.elements, element_number);
  for (auto& chain : assembly.beam_chains)
    for (int& n : chain.nodes) n = node_number[n];
  for (auto& [name, set] : assembly.node_sets)
    for (int& n : set) n = node_number[n];
  for (auto& [name, set] : assembly.element_sets)
    for (int& e : set) e = element_number[e];
  for (auto& [name, surface] : assembly.surfaces)
    for (Face& face : surface) face.element = element_number[face.element];
}

}  // namespace

BlockOrder order_in_blocks(Assembly& assembly, const std::vector<int>& levels, bool in_rows) {
  std::vector<int> elements(assembly.elements.size());
  BlockOrder order;
  auto& first = order.first_element;
  for (std::size_t e = 0; e < elements.size(); ++e) elements[e] = static_cast<int>(e);
  const auto level_of = [&](int e) { return levels.empty() ? 0 : levels[e]; };
  for (const auto& part : assembly.parts) {
    const auto begin = elements.begin() + part.first_element, end = begin + part.element_count;
    std::stable_sort(begin, end, [&](int a, int b) { return level_of(a) < level_of(b); });
    for (auto same = begin; same != end;) {
      const int level = level_of(*same);
      const auto next = std::find_if(same, end, [&](int e) { return level_of(e) != level; });
      (in_rows ? divide_with_rows : divide_into_blocks)(assembly, elements, static_cast<int>(same - elements.begin()),
                                                        static_cast<int>(next - elements.begin()), first);
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
