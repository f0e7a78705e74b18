#pragma once

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "model/model.hpp"
#include "model/ranks/block_partition.hpp"

namespace railwave {

/// The ranks that move a node: those whose blocks have it, and rank 0 where its contact needs it. Most nodes are one
/// rank's.
class RanksOfNodes {
 public:
  explicit RanksOfNodes(int nodes) : only_(nodes, nobody) {}

  void add(int node, int rank);
  bool has(int node, int rank) const;
  bool any(int node) const { return only_[node] != nobody; }
  bool several(int node) const { return only_[node] == several_ranks; }
  /// Ascending. @param node has several
  const std::vector<int>& of(int node) const { return several_.at(node); }

 private:
  static constexpr int nobody = -1, several_ranks = -2;
  std::vector<int> only_;  ///< by node
  std::unordered_map<int, std::vector<int>> several_;
};

/// What ranks have in common, on the host: model numbers.
struct RankLayout {
  std::vector<std::vector<std::vector<int>>> sent;  ///< by rank and other rank: rows of partial forces that it needs
  std::vector<std::vector<int>> touched;            ///< by rank: rows of external forces by which rank 0's contact
                                                    ///< pushes nodes of that rank's blocks
  RanksOfNodes ranks{0};
};

RankLayout lay_out_ranks(const Model& model, const BlockPartition& partition);

/// Places in the arrays of a model that a rank's blocks change, for their way to and from rank 0.
struct ShareItems {
  int rank = 0;
  std::vector<int> nodes;                ///< of its blocks
  std::vector<std::vector<int>> blocks;  ///< by group
  std::vector<int> shown;                ///< of the nodes those of sets whose fields are written
};

/// Nodes of the sets that output.field_sets names, ascending.
std::vector<int> nodes_of_fields(const scene::Scene& scene, const Assembly& assembly);

/// Whether a rank has a node, by node: those of its blocks; on rank 0 also those of no block, of sets, and those that
/// are written.
std::vector<char> nodes_of_rank(const Model& model, int rank);
std::vector<int> nodes_of_no_block(const Model& model);

/// Elements of a rank's blocks, ascending.
std::vector<int> elements_of_rank(const Model& model, int rank);

/// Parts of lists that a rank sums.
std::vector<int> parts_of_rank(const PartedLists& lists, const std::vector<ElementGroup>& groups,
                               const ShareItems& items);

/// Elements and nodes that a rank measures, ascending: those of its blocks; rank 0 also nodes of no block.
struct OwnItems {
  std::vector<int> elements, nodes;
};

OwnItems own_items(const Model& model, const ShareItems& items);

ShareItems items_of(const Model& model, const BlockPartition& partition, const RankLayout& layout, int rank);

/// What a rank computes of a model in steps of a run, in lists on the device. Arrays have the whole model's numbers on
/// every rank; a rank fills and touches what belongs to its own blocks and their nodes, and on a host the rest takes no
/// memory. On rank 0 all are true at outputs.
struct RankShare {
  struct Neighbour {
    int rank;
    int first_sent, sent_count;          ///< in `sent`
    int first_received, received_count;  ///< in `received`
    int first_touched, touched_count;    ///< in `touched`
  };

  int rank = 0, ranks = 1;
  std::vector<Array<int*>> late;   ///< by group: blocks with nodes from NodalState::first_late on, computed first of
                                   ///< all; empty where such a node has blocks of other ranks
  std::vector<Array<int*>> outer;  ///< by group: of the others those with nodes of other ranks too, computed next, so
                                   ///< that their rows are under way while the rest is computed
  std::vector<Array<int*>> inner;  ///< by group: the rest
  std::vector<Neighbour> neighbours;
  Array<int*> sent, received;  ///< rows of the partial forces, neighbour by neighbour
  Array<int*> touched;         ///< rows of the contact forces that rank 0 sends, neighbour by neighbour

  bool has_late_blocks() const {
    return std::any_of(late.begin(), late.end(), [](const Array<int*>& blocks) { return blocks.extent(0) > 0; });
  }
};

/// A rank's share. From then on the model's shared nodes are those of its blocks, on rank 0 also those of no block, and
/// what is summed for accounts and histories is the rank's parts.
RankShare take_share(Model& model, const BlockPartition& partition, const RankLayout& layout, int rank);

}  // namespace railwave
