#include "model/parted_lists.hpp"

#include <algorithm>
#include <numeric>

#include "model/host_copy.hpp"

namespace railwave {

PartedLists part_lists(const std::vector<int>& first, const std::vector<int>& block, int values) {
  std::vector<int> item(block.size());
  std::iota(item.begin(), item.end(), 0);
  PartedLists lists;
  lists.values = values;
  lists.first_part = {0};
  std::vector<int> first_item{0};
  for (std::size_t l = 0; l + 1 < first.size(); ++l) {
    std::stable_sort(item.begin() + first[l], item.begin() + first[l + 1],
                     [&](int a, int b) { return block[a] < block[b]; });
    for (int begin = first[l], end = begin; begin < first[l + 1]; begin = end) {
      while (end < first[l + 1] && block[item[end]] == block[item[begin]]) ++end;
      lists.block.push_back(block[item[begin]]);
      first_item.push_back(end);
    }
    lists.first_part.push_back(lists.part_count());
  }
  lists.items = {to_device("items in parts", item), to_device("first items of parts", first_item)};
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
  lists.whole = false;
  lists.own_parts = to_device("own parts", parts);
}

}  // namespace railwave
