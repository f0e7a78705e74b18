#include "model/ranks/block_partition.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#ifdef RAILWAVE_MPI
#include <metis.h>
#endif

#include "case/error.hpp"
#include "case/memory.hpp"
#include "model/beams/beams.hpp"
#include "model/host_copy.hpp"
#include "model/ranks/rank_share.hpp"
#include "model/ranks/transport.hpp"

namespace railwave {
namespace {

/// Contact costs about as much as so many elements for each slave node: a few of them are near the other surface.
constexpr double elements_of_slave_node = 1;
/// On a GPU each of the small launches that rank 0 has besides its elements costs as much as so many of these.
constexpr double elements_of_small_launch = on_device ? 1.5e4 : 0;
/// Weights of METIS are whole numbers: of an element that is evaluated at every step.
constexpr int weight_of_element = 1 << (most_levels - 1);

/// Nodes on which something other than elements and contact's springs acts, or whose place it must know: by node.
std::vector<char> bound_nodes(const Model& model) {
  std::vector<char> bound(model.nodes.count, 0);
  const auto mark = [&](const auto& nodes) {
    for (int n : nodes) bound[n] = 1;
  };
  for (const LoadedRow& loaded : to_vector(model.external.loaded)) bound[loaded.node] = 1;
  for (const ContactPair& pair : model.contacts) {
    if (pair.has_springs()) continue;
    mark(pair.slave_nodes);
    mark(pair.master_nodes);
  }
  mark(nodes_of_moving_sets(model));
  for (const PrescribedSet& set : model.prescribed) mark(to_vector(set.nodes));
  for (const TiedPlace& tied : model.ties.places) {
    bound[tied.slave] = 1;
    for (int n : tied.face) bound[n] = 1;
  }
  mark(model.ends.nodes);
  if (model.beams) mark(to_vector(model.beams->arrays.node));
  return bound;
}

/// Blocks of all groups under one number, and how many nodes each has in common with others.
struct BlockGraph {
  std::vector<int> first;      ///< of each group
  std::vector<double> weight;  ///< element evaluations a step
  std::vector<long> elements;
  std::vector<char> bound;                              ///< to rank 0
  std::vector<int> in_contact;                          ///< nodes that rank 0 moves, too, for contact's springs
  std::vector<std::vector<std::pair<int, int>>> edges;  ///< other block, nodes in common
};

/// Calls act(block, node) for each node of each block.
template <class Act>
void each_node(const Model& model, const Act& act) {
  int block = 0;
  for (const ElementGroup& group : model.elements) {
    const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
    for (int p = 0; p < group.blocks.count; ++p, ++block)
      for (int l = 0; l < count(p); ++l) act(block, node(p * group.blocks.node_stride + l) & ~advance_bit);
  }
}

/// The blocks around each node: those of node n from first[n] on.
struct BlocksOfNodes {
  std::vector<int> first, block;

  explicit BlocksOfNodes(const Model& model) : first(model.nodes.count + 1, 0) {
    each_node(model, [&](int /*b*/, int n) { ++first[n + 1]; });
    for (int n = 0; n < model.nodes.count; ++n) first[n + 1] += first[n];
    block.resize(first.back());
    each_node(model, [&](int b, int n) { block[first[n]++] = b; });
    for (int n = model.nodes.count; n > 0; --n) first[n] = first[n - 1];
    first[0] = 0;
  }
};

BlockGraph graph_of(const Model& model) {
  BlockGraph graph;
  for (const ElementGroup& group : model.elements) {
    graph.first.push_back(static_cast<int>(graph.elements.size()));
    for (int count : group.element_count) {
      graph.elements.push_back(count);
      graph.weight.push_back(count / static_cast<double>(1L << group.level));
    }
  }
  const std::size_t blocks = graph.elements.size();
  graph.bound.assign(blocks, 0);
  graph.in_contact.assign(blocks, 0);
  graph.edges.resize(blocks);
  std::vector<char> in_contact(model.nodes.count, 0);
  for (int n : nodes_of_contact_springs(model)) in_contact[n] = 1;
  const std::vector<char> bound = bound_nodes(model);
  const BlocksOfNodes around(model);
  std::vector<int> common(blocks, 0), others;  // with the present block
  int present = 0;
  const auto finish = [&] {
    std::sort(others.begin(), others.end());
    for (int other : others) {
      graph.edges[present].emplace_back(other, common[other]);
      common[other] = 0;
    }
    others.clear();
  };
  each_node(model, [&](int b, int n) {
    if (b != present) finish();
    present = b;
    if (bound[n] != 0) graph.bound[b] = 1;
    graph.in_contact[b] += in_contact[n];
    for (int k = around.first[n]; k < around.first[n + 1]; ++k) {
      const int other = around.block[k];
      if (other != b && common[other]++ == 0) others.push_back(other);
    }
  });
  finish();
  return graph;
}

/// Launches of a step that rank 0 alone has, and of which each waits for others.
int small_launches(const Model& model) {
  const auto if_any = [](bool any, int launches) { return any ? launches : 0; };
  return static_cast<int>(model.contacts.size()) + if_any(model.sets.moving > 0, 1) +
         if_any(model.set_teams.others.extent(0) > 0, 1) + if_any(model.beams != nullptr, 2) +
         if_any(model.ties.arrays.active(), 3) + if_any(model.ends.arrays.count > 0, 1);
}

/// What rank 0 has to do besides its blocks, in elements.
double further_work(const Model& model) {
  double work = elements_of_small_launch * small_launches(model);
  for (const ContactPair& pair : model.contacts)
    work += elements_of_slave_node * static_cast<double>(pair.slave_nodes.size());
  return work;
}

#ifdef RAILWAVE_MPI
/// A graph as METIS takes it: the neighbours of vertex v from first[v] on.
struct MetisGraph {
  std::vector<idx_t> first{0}, other, common, weight;

  void add_vertex(double work, const std::vector<std::pair<idx_t, int>>& neighbours) {
    weight.push_back(std::max<idx_t>(1, static_cast<idx_t>(work * weight_of_element)));
    for (const auto& [to, nodes] : neighbours) {
      other.push_back(to);
      common.push_back(nodes);
    }
    first.push_back(static_cast<idx_t>(other.size()));
  }
};

/// A vertex for each of the blocks that rank 0 need not have. @param whole one more, the last, for all that it has, if
/// that is work; nodes of contact's springs count as in common with it
MetisGraph metis_graph(const BlockGraph& graph, const std::vector<int>& free_blocks, double whole) {
  const auto rank_0 = static_cast<idx_t>(free_blocks.size());
  std::vector<idx_t> vertex(graph.weight.size(), rank_0);
  for (std::size_t v = 0; v < free_blocks.size(); ++v) vertex[free_blocks[v]] = static_cast<idx_t>(v);
  MetisGraph result;
  std::vector<std::pair<idx_t, int>> of_rank_0;
  for (int b : free_blocks) {
    int with_rank_0 = graph.in_contact[b];
    std::vector<std::pair<idx_t, int>> neighbours;
    for (const auto& [to, nodes] : graph.edges[b])
      if (vertex[to] == rank_0)
        with_rank_0 += nodes;
      else
        neighbours.emplace_back(vertex[to], nodes);
    if (whole > 0 && with_rank_0 > 0) {
      of_rank_0.emplace_back(vertex[b], with_rank_0);
      neighbours.emplace_back(rank_0, with_rank_0);
    }
    result.add_vertex(graph.weight[b], neighbours);
  }
  if (whole > 0) result.add_vertex(whole, of_rank_0);
  return result;
}

/// Parts of alike weight, by vertex.
std::vector<idx_t> parts_of(MetisGraph graph, idx_t parts) {
  idx_t count = static_cast<idx_t>(graph.weight.size()), constraints = 1, cut = 0;
  std::vector<idx_t> part(graph.weight.size(), 0);
  if (parts == 1) return part;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NCUTS] = 10;     // one alone may leave a part with a heavy vertex 1.8 times the mean
  constexpr idx_t most_by_halving = 8;  // what METIS's manual advises
  const auto divide = parts <= most_by_halving ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  if (divide(&count, &constraints, graph.first.data(), graph.other.data(), graph.weight.data(), nullptr,
             graph.common.data(), &parts, nullptr, nullptr, options, &cut, part.data()) != METIS_OK)
    throw std::runtime_error(fmt::format("METIS could not deal {} blocks out to {} ranks", count, parts));
  return part;
}
#endif

/// Rank of each block. What rank 0 must have counts as part of its share.
std::vector<int> deal_out(const BlockGraph& graph, double further, int ranks) {
  std::vector<int> rank(graph.weight.size(), 0), free_blocks;
  double bound = further, all = further;
  for (std::size_t b = 0; b < rank.size(); ++b) {
    all += graph.weight[b];
    if (graph.bound[b] != 0)
      bound += graph.weight[b];
    else
      free_blocks.push_back(static_cast<int>(b));
  }
  if (ranks == 1 || free_blocks.empty()) return rank;
  if (static_cast<int>(free_blocks.size()) < ranks) {
    for (std::size_t v = 0; v < free_blocks.size(); ++v) rank[free_blocks[v]] = 1 + static_cast<int>(v) % (ranks - 1);
    return rank;
  }
#ifdef RAILWAVE_MPI
  // Below this share of a rank's work a part of its own for rank 0 is not worth another border.
  constexpr double least_share = 0.05;
  const double mean = all / ranks;
  const bool takes_part = mean - bound > least_share * mean;
  const std::vector<idx_t> part =
      parts_of(metis_graph(graph, free_blocks, takes_part ? bound : 0), takes_part ? ranks : ranks - 1);
  std::vector<int> rank_of_part(ranks);
  std::iota(rank_of_part.begin(), rank_of_part.end(), takes_part ? 0 : 1);
  if (takes_part && bound > 0) std::swap(rank_of_part[0], rank_of_part[part.back()]);
  for (std::size_t v = 0; v < free_blocks.size(); ++v) rank[free_blocks[v]] = rank_of_part[part[v]];
#endif
  return rank;
}

/// Of many ranks those beside rank 0 together.
std::string memory_of_ranks(const std::vector<RankMemory>& memory) {
  constexpr std::size_t most_by_rank = 8;
  std::vector<std::string> texts;
  double least = 1e300, most = 0;
  for (const RankMemory& one : memory) texts.push_back(bytes_text(one.peak()));
  if (memory.size() <= most_by_rank) return fmt::format("by rank: {}", fmt::join(texts, ", "));
  for (std::size_t r = 1; r < memory.size(); ++r) {
    least = std::min(least, memory[r].peak());
    most = std::max(most, memory[r].peak());
  }
  return fmt::format("rank 0: {}, others: {} to {}", texts[0], bytes_text(least), bytes_text(most));
}

void need_mpi() {
#ifndef RAILWAVE_MPI
  throw InputError(
      "this program was built without MPI and METIS: it runs on one rank only; scripts/setup --mpi installs both, then "
      "build it anew");
#endif
}

}  // namespace

double BlockPartition::imbalance() const {
  const double all = std::accumulate(work.begin(), work.end(), 0.0);
  return all > 0 ? *std::max_element(work.begin(), work.end()) * ranks / all : 1;
}

BlockPartition partition_blocks(const Model& model, int ranks) {
  need_mpi();
  const BlockGraph graph = graph_of(model);
  const double further = further_work(model);
  const std::vector<int> rank = deal_out(graph, further, ranks);
  BlockPartition partition;
  partition.ranks = ranks;
  partition.work.assign(ranks, 0);
  partition.elements.assign(ranks, 0);
  partition.work[0] = further;
  for (std::size_t b = 0; b < rank.size(); ++b) {
    partition.work[rank[b]] += graph.weight[b];
    partition.elements[rank[b]] += graph.elements[b];
    if (graph.bound[b] != 0) partition.bound_elements += graph.elements[b];
  }
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    const auto begin = rank.begin() + graph.first[g];
    partition.owner.emplace_back(begin, begin + model.elements[g].blocks.count);
  }
  return partition;
}

std::vector<int> ranks_of_elements(const Model& model, const BlockPartition& partition) {
  std::vector<int> ranks(model.element_count(), 0);
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    const ElementGroup& group = model.elements[g];
    for (int p = 0; p < group.blocks.count; ++p)
      std::fill_n(ranks.begin() + group.first_element[p], group.element_count[p], partition.owner[g][p]);
  }
  return ranks;
}

void deal_out_blocks(Model& model, Transport& transport) {
  BlockPartition partition;
  if (transport.rank() == 0) partition = partition_blocks(model, transport.ranks());
  meet(transport);
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    std::vector<int>& owner = model.elements[g].owner;
    owner.resize(model.elements[g].blocks.count);
    if (transport.rank() == 0) owner = partition.owner[g];
    transport.broadcast(owner.data(), sizeof(int) * owner.size());
  }
}

std::vector<int> nodes_of_contact_springs(const Model& model) {
  std::vector<int> nodes;
  for (const ContactPair& pair : model.contacts) {
    if (!pair.has_springs()) continue;
    for (const auto* surface : {&pair.slave_nodes, &pair.master_nodes})
      nodes.insert(nodes.end(), surface->begin(), surface->end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

BlockPartition partition_of(const Model& model, int ranks) {
  BlockPartition partition;
  partition.ranks = ranks;
  for (const ElementGroup& group : model.elements) partition.owner.push_back(group.owner);
  return partition;
}

std::vector<std::string> describe_ranks(const Model& model, const BlockPartition& partition) {
  std::vector<std::string> lines;
  const RankLayout layout = lay_out_ranks(model, partition);
  const double row = model.in_single ? sizeof(PartialForce<float>) : sizeof(PartialForce<double>);
  for (int r = 0; r < partition.ranks; ++r) {
    long rows = 0, of_contact = 0;
    int neighbours = 0;
    for (int other = 0; other < partition.ranks; ++other) {
      rows += static_cast<long>(layout.sent[r][other].size());
      const std::size_t pushed = r == 0 ? layout.touched[other].size() : 0;
      of_contact += static_cast<long>(pushed);
      neighbours += layout.sent[r][other].empty() && pushed == 0 ? 0 : 1;
    }
    const double bytes = row * static_cast<double>(rows) + sizeof(FixedForce) * static_cast<double>(of_contact);
    lines.push_back(fmt::format("rank {}: {} elements, {} rows of forces ({:.4g} kB) a step to {} other{}", r,
                                partition.elements[r], rows + of_contact, 1e-3 * bytes, neighbours,
                                neighbours == 1 ? "" : "s"));
  }
  lines.push_back(fmt::format(
      "rank 0 has all {} elements beside ties, loads, ends and contact by multipliers; the largest share of work is "
      "{:.2f} times the mean, so {} ranks are at most {:.2f} times as fast as one",
      partition.bound_elements, partition.imbalance(), partition.ranks, partition.ranks / partition.imbalance()));
  BlockPartition alone;
  alone.elements = {model.element_count()};
  lines.push_back(fmt::format("memory at most, about, {}; one process alone: {}",
                              memory_of_ranks(forecast_memory(model, partition)),
                              bytes_text(forecast_memory(model, alone).front().peak())));
  if (rank_0_needs_all(model.scene))
    lines.emplace_back(
        "rank 0 has the arrays of the whole scene: it settles it or sets it in motion, finds contact or the frames of "
        "single precision, or searches the whole scene's step");
  return lines;
}

}  // namespace railwave
