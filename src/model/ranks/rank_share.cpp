#include "model/ranks/rank_share.hpp"

#include <algorithm>
#include <functional>

#include "model/elements/element_histories.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Calls `one(node, rank, first row, second row)` for each node of each block; the second is of damping, -1: none.
template <class Do>
void each_node_of_blocks(const Model& model, const BlockPartition& partition, const Do& one) {
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    const ElementGroup& group = model.elements[g];
    const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
    for (int p = 0; p < group.blocks.count; ++p)
      for (int l = 0; l < count(p); ++l) {
        const int k = p * group.blocks.node_stride + l;
        one(node(k) & ~advance_bit, partition.owner[g][p], group.first_partial + k,
            group.damping.active() ? group.damping.first_partial + k : -1);
      }
  }
}

/// By node, those from NodalState::first_late on; none where one of them is `outer`, so that others' rows must come
/// before it moves.
std::vector<char> late_nodes(const Model& model, const std::vector<char>& outer) {
  std::vector<char> late(model.nodes.count, 0);
  if (model.subcycling.levels > 1) return late;
  const auto shared = to_host(model.shared.nodes);
  for (std::size_t i = model.first_late; i < shared.extent(0); ++i) {
    const int n = shared(i).node & ~special_bit;
    if (outer[n] != 0) return std::vector<char>(model.nodes.count, 0);
    late[n] = 1;
  }
  return late;
}

/// Of the model's shared nodes those that a rank moves. Those with blocks of other ranks are put together where plain
/// nodes end and special ones begin, so that all others may move before rows come; else they stay in their order.
void keep_shared_nodes(Model& model, const RankLayout& layout, int rank) {
  SharedNodes& shared = model.shared;
  const auto all = to_host(shared.nodes);
  const auto all_special = to_host(shared.special);
  const auto first = to_host(model.nodes.first_partial);
  const int count = static_cast<int>(all.extent(0));
  const auto node_of = [&](int i) { return all(i).node & ~special_bit; };
  std::vector<int> kept, kept_before(count + 1, 0);
  for (int i = 0; i < count; ++i) {
    const int n = node_of(i);
    const bool of_no_block = first(n + 1) == first(n);
    if (layout.ranks.has(n, rank) || (rank == 0 && of_no_block)) kept.push_back(i);
    kept_before[i + 1] = static_cast<int>(kept.size());
  }
  const int first_special = kept_before[shared.first_special];
  model.first_late = kept_before[model.first_late];
  model.early_shared = kept_before[model.early_shared];
  for (int& end : model.subcycling.shared_end) end = kept_before[end];
  if (model.subcycling.levels == 1) {  // else they are in order of levels
    const auto special = kept.begin() + first_special, late = kept.begin() + model.first_late;
    const auto is_between = [&](int i) { return layout.ranks.several(node_of(i)); };
    const auto begin = std::stable_partition(kept.begin(), special, std::not_fn(is_between));
    const auto end = std::stable_partition(special, late, is_between);
    model.between_ranks = {static_cast<int>(begin - kept.begin()), static_cast<int>(end - kept.begin())};
  }
  std::vector<SharedNode> nodes;
  std::vector<SpecialNode> specials;
  for (int i : kept) {
    nodes.push_back(all(i));
    if (i >= shared.first_special) specials.push_back(all_special(i - shared.first_special));
  }
  shared = {to_device("shared nodes of this rank", nodes), to_device("special nodes of this rank", specials),
            first_special};
}

/// Blocks and parts of lists that the rank's accounts and histories sum.
void keep_sums(Model& model, const ShareItems& items) {
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    model.elements[g].whole = false;
    model.elements[g].own_blocks = to_device("own blocks", items.blocks[g]);
  }
  const auto keep = [&](PartedLists& lists) { keep_parts(lists, parts_of_rank(lists, model.elements, items)); };
  keep(model.node_parts);
  keep(model.motion_histories.parts);
  if (model.element_histories) keep(model.element_histories->parts);
  keep_listed_elements(model);
}

}  // namespace

void RanksOfNodes::add(int node, int rank) {
  int& only = only_[node];
  if (only == rank) return;
  if (only == nobody) {
    only = rank;
    return;
  }
  auto& ranks = several_[node];
  if (only != several_ranks) ranks = {only};
  only = several_ranks;
  const auto place = std::lower_bound(ranks.begin(), ranks.end(), rank);
  if (place == ranks.end() || *place != rank) ranks.insert(place, rank);
}

bool RanksOfNodes::has(int node, int rank) const {
  if (!several(node)) return only_[node] == rank;
  const auto& ranks = of(node);
  return std::binary_search(ranks.begin(), ranks.end(), rank);
}

RankLayout lay_out_ranks(const Model& model, const BlockPartition& partition) {
  RankLayout layout;
  layout.ranks = RanksOfNodes(model.nodes.count);
  layout.sent.assign(partition.ranks, std::vector<std::vector<int>>(partition.ranks));
  each_node_of_blocks(model, partition, [&](int node, int rank, int, int) { layout.ranks.add(node, rank); });
  const std::vector<int> in_contact = nodes_of_contact_springs(model);
  for (int n : in_contact)
    if (layout.ranks.any(n)) layout.ranks.add(n, 0);
  layout.touched.resize(partition.ranks);
  const auto external_row = to_host(model.nodes.external_row);
  for (int n : in_contact) {
    if (!layout.ranks.several(n)) continue;
    for (int rank : layout.ranks.of(n))
      if (rank > 0) layout.touched[rank].push_back(external_row(n));
  }
  each_node_of_blocks(model, partition, [&](int node, int rank, int row, int damping_row) {
    if (!layout.ranks.several(node)) return;
    for (int other : layout.ranks.of(node)) {
      if (other == rank) continue;
      layout.sent[rank][other].push_back(row);
      if (damping_row >= 0) layout.sent[rank][other].push_back(damping_row);
    }
  });
  return layout;
}

std::vector<int> nodes_of_fields(const scene::Scene& scene, const Assembly& assembly) {
  std::vector<int> nodes;
  for (const std::string& name : scene.output.field_sets) {
    if (const auto set = assembly.node_sets.find(name); set != assembly.node_sets.end())
      nodes.insert(nodes.end(), set->second.begin(), set->second.end());
    if (const auto set = assembly.element_sets.find(name); set != assembly.element_sets.end())
      for (int e : set->second) nodes.insert(nodes.end(), assembly.elements[e].begin(), assembly.elements[e].end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

ShareItems items_of(const Model& model, const BlockPartition& partition, const RankLayout& layout, int rank) {
  ShareItems items;
  items.rank = rank;
  for (int n = 0; n < model.nodes.count; ++n)
    if (layout.ranks.has(n, rank)) items.nodes.push_back(n);
  for (int n : model.shown_nodes)
    if (layout.ranks.has(n, rank)) items.shown.push_back(n);
  for (const auto& owner : partition.owner) {
    auto& blocks = items.blocks.emplace_back();
    for (std::size_t p = 0; p < owner.size(); ++p)
      if (owner[p] == rank) blocks.push_back(static_cast<int>(p));
  }
  return items;
}

std::vector<char> nodes_of_rank(const Model& model, int rank) {
  std::vector<char> wanted(model.nodes.count, 0);
  if (rank == 0) {
    for (int n : model.shown_nodes) wanted[n] = 1;
    for (int n : to_vector(model.sets.nodes)) wanted[n] = 1;
    for (int n : nodes_of_no_block(model)) wanted[n] = 1;
  }
  for (const ElementGroup& group : model.elements) {
    const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
    for (int p = 0; p < group.blocks.count; ++p)
      for (int l = 0; group.owner[p] == rank && l < count(p); ++l)
        wanted[node(static_cast<std::size_t>(p) * group.blocks.node_stride + l) & ~advance_bit] = 1;
  }
  return wanted;
}

std::vector<int> nodes_of_no_block(const Model& model) {
  std::vector<int> nodes;
  const auto first = to_host(model.nodes.first_partial);
  for (int n = 0; n < model.nodes.count; ++n)
    if (first(n + 1) == first(n)) nodes.push_back(n);
  return nodes;
}

std::vector<int> elements_of_rank(const Model& model, int rank) {
  std::vector<int> elements;
  for (const ElementGroup& group : model.elements)
    for (std::size_t p = 0; p < group.owner.size(); ++p)
      for (int e = 0; group.owner[p] == rank && e < group.element_count[p]; ++e)
        elements.push_back(group.first_element[p] + e);
  std::sort(elements.begin(), elements.end());
  return elements;
}

std::vector<int> parts_of_rank(const PartedLists& lists, const std::vector<ElementGroup>& groups,
                               const ShareItems& items) {
  const std::vector<int> first = first_blocks(groups);
  std::vector<char> has(first.back(), 0);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int p : items.blocks[g]) has[first[g] + p] = 1;
  return parts_of(lists, has, items.rank == 0);
}

OwnItems own_items(const Model& model, const ShareItems& items) {
  OwnItems own;
  own.nodes = items.nodes;
  if (items.rank == 0) {
    const auto of_no_block = nodes_of_no_block(model);
    own.nodes.insert(own.nodes.end(), of_no_block.begin(), of_no_block.end());
    std::sort(own.nodes.begin(), own.nodes.end());
  }
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    const ElementGroup& group = model.elements[g];
    for (int p : items.blocks[g])
      for (int e = 0; e < group.element_count[p]; ++e) own.elements.push_back(group.first_element[p] + e);
  }
  std::sort(own.elements.begin(), own.elements.end());
  return own;
}

RankShare take_share(Model& model, const BlockPartition& partition, const RankLayout& layout, int rank) {
  RankShare share;
  share.rank = rank;
  share.ranks = partition.ranks;
  std::vector<char> outer(model.nodes.count, 0);
  for (int n = 0; n < model.nodes.count; ++n) outer[n] = layout.ranks.several(n) && layout.ranks.has(n, rank) ? 1 : 0;
  const std::vector<char> late = late_nodes(model, outer);
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    const ElementGroup& group = model.elements[g];
    const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
    std::vector<int> of_late, of_outer, of_inner;
    for (int p = 0; p < group.blocks.count; ++p) {
      if (partition.owner[g][p] != rank) continue;
      const int* const nodes = node.data() + static_cast<std::size_t>(p) * group.blocks.node_stride;
      const auto has_any = [&](const std::vector<char>& of) {
        return std::any_of(nodes, nodes + count(p), [&](int n) { return of[n & ~advance_bit] != 0; });
      };
      (has_any(late) ? of_late : has_any(outer) ? of_outer : of_inner).push_back(p);
    }
    share.late.push_back(to_device("blocks with late nodes", of_late));
    share.outer.push_back(to_device("outer blocks", of_outer));
    share.inner.push_back(to_device("inner blocks", of_inner));
  }
  std::vector<int> sent, received, touched;
  for (int other = 0; other < partition.ranks; ++other) {
    const auto &to = layout.sent[rank][other], &from = layout.sent[other][rank];
    if (to.empty() && from.empty()) continue;
    const std::vector<int> none, &pushed = rank == 0 ? layout.touched[other] : other == 0 ? layout.touched[rank] : none;
    const auto place = [](const std::vector<int>& in) { return static_cast<int>(in.size()); };
    share.neighbours.push_back(
        {other, place(sent), place(to), place(received), place(from), place(touched), place(pushed)});
    sent.insert(sent.end(), to.begin(), to.end());
    received.insert(received.end(), from.begin(), from.end());
    touched.insert(touched.end(), pushed.begin(), pushed.end());
  }
  share.sent = to_device("rows sent", sent);
  share.received = to_device("rows received", received);
  share.touched = to_device("rows of contact forces", touched);
  keep_shared_nodes(model, layout, rank);
  const ShareItems items = items_of(model, partition, layout, rank);
  model.own_nodes = to_device("own nodes", own_items(model, items).nodes);
  if (rank > 0) keep_relative_nodes(model);  // rank 0 has those of all, which come back to it
  keep_sums(model, items);
  return share;
}

}  // namespace railwave
