#include <catch2/catch_test_macros.hpp>
#include <set>

#include "case/error.hpp"
#include "model/host_copy.hpp"
#include "model/ranks/rank_share.hpp"
#include "tests/verify/two_blocks.hpp"

using namespace railwave;
using namespace railwave::verify;

namespace {

Model touching_blocks(scene::ContactAlgorithm algorithm) {
  TwoBlocks blocks;
  blocks.lower_divisions = {16, 16, 12};
  blocks.algorithm = algorithm;
  scene::Scene scene = blocks.scene(1e-4);
  hold(scene, "lower.z_min", {true, true, true});
  Model model;
  build_model(scene, model);
  return model;
}

std::vector<int> nodes_in(const ElementGroup& group, int p) {
  const auto node = to_host(group.blocks.node), count = to_host(group.blocks.node_count);
  std::vector<int> nodes;
  for (int l = 0; l < count(p); ++l) nodes.push_back(node(p * group.blocks.node_stride + l) & ~advance_bit);
  return nodes;
}

bool any_in(const std::vector<int>& nodes, const std::set<int>& of) {
  return std::any_of(nodes.begin(), nodes.end(), [&](int n) { return of.count(n) > 0; });
}

std::set<int> surface_nodes(const Model& model) {
  std::set<int> nodes;
  for (const ContactPair& pair : model.contacts) {
    nodes.insert(pair.slave_nodes.begin(), pair.slave_nodes.end());
    nodes.insert(pair.master_nodes.begin(), pair.master_nodes.end());
  }
  return nodes;
}

/// Rank 1 has all blocks that `nodes` are not of, and the first of those that they are of where it `takes_one`.
BlockPartition without(const Model& model, const std::set<int>& nodes, bool takes_one = false) {
  BlockPartition partition;
  partition.ranks = 2;
  for (const ElementGroup& group : model.elements) {
    auto& owner = partition.owner.emplace_back();
    for (int p = 0; p < group.blocks.count; ++p) {
      const bool any = any_in(nodes_in(group, p), nodes);
      owner.push_back(any && !takes_one ? 0 : 1);
      if (any) takes_one = false;
    }
  }
  return partition;
}

/// By which the nodes of both surfaces are late.
Model blocks_by_multipliers() { return touching_blocks(scene::ContactAlgorithm::multiplier); }

/// The list that has a block: 0 late, 1 outer, 2 inner; -1: none.
int list_of(const RankShare& share, std::size_t group, int block) {
  int found = -1, k = 0;
  for (const auto* lists : {&share.late, &share.outer, &share.inner}) {
    for (int p : to_vector((*lists)[group]))
      if (p == block) {
        CHECK(found == -1);
        found = k;
      }
    ++k;
  }
  return found;
}

/// Nodes [begin, end) of the shared ones.
std::vector<int> shared_range(const Model& model, int begin, int end) {
  const auto shared = to_host(model.shared.nodes);
  std::vector<int> nodes;
  for (int i = begin; i < end; ++i) nodes.push_back(shared(i).node & ~special_bit);
  return nodes;
}

}  // namespace

TEST_CASE("a rank's blocks and nodes are divided by what they wait for") {
  for (const int rank : {0, 1}) {
    Model model = blocks_by_multipliers();
    const std::set<int> late = surface_nodes(model);
    const BlockPartition partition = without(model, late);
    const RankLayout layout = lay_out_ranks(model, partition);
    std::set<int> wanted;
    for (int n : shared_range(model, 0, static_cast<int>(model.shared.nodes.extent(0))))
      if (layout.ranks.has(n, rank)) wanted.insert(n);
    const RankShare share = take_share(model, partition, layout, rank);
    CHECK(share.has_late_blocks() == (rank == 0));
    int of_lists[3] = {0, 0, 0};
    for (std::size_t g = 0; g < model.elements.size(); ++g)
      for (int p = 0; p < model.elements[g].blocks.count; ++p) {
        const int list = list_of(share, g, p);
        if (partition.owner[g][p] != rank) {
          CHECK(list == -1);
          continue;
        }
        const std::vector<int> nodes = nodes_in(model.elements[g], p);
        const bool between = std::any_of(nodes.begin(), nodes.end(), [&](int n) { return layout.ranks.several(n); });
        CHECK(list == (any_in(nodes, late) ? 0 : between ? 1 : 2));
        ++of_lists[list];
      }
    CHECK(of_lists[rank == 0 ? 0 : 1] > 0);

    const int count = static_cast<int>(model.shared.nodes.extent(0));
    const auto [begin, end] = model.between_ranks;
    CHECK(begin < end);
    const std::vector<int> kept = shared_range(model, 0, count);
    CHECK(std::set<int>(kept.begin(), kept.end()) == wanted);
    CHECK(kept.size() == wanted.size());
    for (int i = 0; i < count; ++i) {
      CHECK(layout.ranks.several(kept[i]) == (i >= begin && i < end));
      CHECK((late.count(kept[i]) > 0) == (i >= model.first_late));
    }
    // What special nodes are asked for has moved with them.
    const auto shared = to_host(model.shared.nodes);
    const auto special = to_host(model.shared.special);
    const auto row = to_vector(model.nodes.external_row), constraint = to_vector(model.nodes.constraint);
    REQUIRE(static_cast<int>(special.extent(0)) == count - model.shared.first_special);
    for (int i = 0; i < count; ++i) {
      CHECK((shared(i).node < 0) == (i >= model.shared.first_special));
      if (i < model.shared.first_special) continue;
      CHECK(special(i - model.shared.first_special).row == row[kept[i]]);
      CHECK(special(i - model.shared.first_special).constraint == constraint[kept[i]]);
    }
  }
}

TEST_CASE("where a late node has blocks of another rank, too, none are computed first") {
  Model model = blocks_by_multipliers();
  const BlockPartition partition = without(model, surface_nodes(model), true);
  const RankShare share = take_share(model, partition, lay_out_ranks(model, partition), 0);
  CHECK(!share.has_late_blocks());
  CHECK(model.first_late < static_cast<int>(model.shared.nodes.extent(0)));
}

TEST_CASE("rank 0 moves what its contact by springs pushes, whoever has the blocks") {
  std::vector<int> pushed_by_0;
  for (const int rank : {0, 1, 2}) {
    Model model = touching_blocks(scene::ContactAlgorithm::penalty);
    const std::set<int> master(model.contacts[0].master_nodes.begin(), model.contacts[0].master_nodes.end());
    const std::set<int> slaves(model.contacts[0].slave_nodes.begin(), model.contacts[0].slave_nodes.end());
    BlockPartition partition = without(model, master);  // rank 0 has the blocks of one surface
    partition.ranks = 3;
    for (std::size_t g = 0; g < model.elements.size(); ++g)
      for (int p = 0; p < model.elements[g].blocks.count; ++p)
        if (any_in(nodes_in(model.elements[g], p), slaves)) partition.owner[g][p] = 2;
    const RankLayout layout = lay_out_ranks(model, partition);
    CHECK(layout.touched[0].empty());
    CHECK(layout.touched[1].empty());
    std::set<int> rows;
    const auto row = to_vector(model.nodes.external_row);
    for (int n : slaves) {
      CHECK(layout.ranks.has(n, 0));
      CHECK(layout.ranks.has(n, 2));
      rows.insert(row[n]);
    }
    CHECK(std::set<int>(layout.touched[2].begin(), layout.touched[2].end()) == rows);
    CHECK(layout.touched[2].size() == rows.size());

    const RankShare share = take_share(model, partition, layout, rank);
    const std::vector<int> touched = to_vector(share.touched);
    if (rank == 0) pushed_by_0 = touched;
    CHECK(touched == (rank == 1 ? std::vector<int>{} : pushed_by_0));
    for (const RankShare::Neighbour& one : share.neighbours)
      CHECK(one.touched_count == (rank != 1 && one.rank == 2 - rank ? static_cast<int>(rows.size()) : 0));
    const auto [begin, end] = model.between_ranks;
    const std::vector<int> between = shared_range(model, begin, end);
    for (int n : slaves) CHECK((std::count(between.begin(), between.end(), n) == 1) == (rank != 1));
  }
}

TEST_CASE("ranks have alike work, and rank 0 all that is bound to it") {
  long bound_by_springs = 0;
  for (const auto algorithm : both_algorithms) {
    TwoBlocks blocks;
    blocks.lower_divisions = {32, 32, 24};
    blocks.algorithm = algorithm;
    Model model;
    build_model(blocks.scene(1e-4), model);
    for (const int ranks : {2, 3, 4}) {
      BlockPartition partition;
      try {
        partition = partition_blocks(model, ranks);
      } catch (const InputError&) {
        SKIP("the program is built without MPI and METIS");
      }
      INFO(name_of(algorithm) << ", " << ranks << " ranks");
      CHECK(partition.imbalance() < 1.05);
      if (algorithm == scene::ContactAlgorithm::penalty)
        bound_by_springs = partition.bound_elements;
      else
        CHECK(partition.bound_elements > bound_by_springs);
      CHECK(partition.elements[0] >= partition.bound_elements);
    }
  }
}
