#include "model/parted_lists.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Of a part whose items lie at `begin` to `end`. Threads of a device side by side read what lies side by side.
void add_chunks(int begin, int end, std::vector<std::array<int, 3>>& chunks) {
  const int count = (end - begin + items_of_block - 1) / items_of_block;
  for (int c = 0; c < count; ++c) {
    const int first = begin + c * items_of_block;
    if (on_device)
      chunks.push_back({begin + c, count, end});
    else
      chunks.push_back({first, 1, std::min(first + items_of_block, end)});
  }
}

}  // namespace

PartedLists part_lists(const std::vector<int>& first, const std::vector<int>& block, int values) {
  std::vector<int> item(block.size());
  std::iota(item.begin(), item.end(), 0);
  PartedLists lists;
  lists.values = values;
  lists.first_part = {0};
  std::vector<int> first_chunk{0};
  std::vector<std::array<int, 3>> chunks;
  for (std::size_t l = 0; l + 1 < first.size(); ++l) {
    std::stable_sort(item.begin() + first[l], item.begin() + first[l + 1],
                     [&](int a, int b) { return block[a] < block[b]; });
    for (int begin = first[l], end = begin; begin < first[l + 1]; begin = end) {
      while (end < first[l + 1] && block[item[end]] == block[item[begin]]) ++end;
      lists.block.push_back(block[item[begin]]);
      add_chunks(begin, end, chunks);
      first_chunk.push_back(static_cast<int>(chunks.size()));
    }
    lists.first_part.push_back(lists.part_count());
  }
  lists.chunk_count = static_cast<int>(chunks.size());
  lists.items = {to_device("items in parts", item), to_device("chunks of parts", chunks),
                 to_device("first chunks of parts", first_chunk)};
  lists.chunk_sums = unset_array<double*>("sums of chunks", chunks.size() * values);
  lists.part_sums = unset_array<double*>("sums of parts", lists.block.size() * values);
  return lists;
}

std::vector<int> parts_of(const PartedLists& lists, const std::vector<char>& has_block, bool of_rank_0) {
  std::vector<int> parts;
  for (int q = 0; q < lists.part_count(); ++q)
    if (const int block = lists.block[q]; block < 0 ? of_rank_0 : has_block[block] != 0) parts.push_back(q);
  return parts;
}

void keep_parts(PartedLists& lists, const std::vector<int>& parts) {
  std::vector<int> chunks;
  const std::vector<int> first_chunk = to_vector(lists.items.first_chunk);
  for (int q : parts)
    for (int c = first_chunk[q]; c < first_chunk[q + 1]; ++c) chunks.push_back(c);
  lists.whole = false;
  lists.own_parts = to_device("own parts", parts);
  lists.own_chunks = to_device("own chunks", chunks);
}

}  // namespace railwave
