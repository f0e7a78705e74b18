#include <algorithm>
#include <map>

#include "model/boundaries/prescribed_nodes.hpp"
#include "model/boundaries/ties.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"
#include "model/loads/load_model.hpp"

namespace railwave {

namespace {

/// Rows of the nodes that prescribed motions move; -1: none does.
void find_driven(const std::vector<int>& nodes, const std::vector<PrescribedSet>& prescribed,
                 MotionHistories& histories) {
  std::map<int, int> row;
  std::vector<int> rows, driven;
  for (const PrescribedSet& set : prescribed)
    for (int n : to_vector(set.nodes)) {
      const auto [entry, is_new] = row.emplace(n, static_cast<int>(row.size()));
      rows.push_back(is_new ? entry->second : ~entry->second);
    }
  for (int n : nodes) driven.push_back(row.count(n) != 0 ? row[n] : -1);
  if (std::all_of(driven.begin(), driven.end(), [](int r) { return r < 0; })) return;
  histories.driven = to_device("driven nodes of motion histories", driven);
  histories.driven_rows = to_device("rows of driven nodes", rows);
  histories.driven_change = Array<double* [6]>("motion of driven nodes", row.size());
}

}  // namespace

void build_motion_histories(const Ties& ties, const std::vector<PrescribedSet>& prescribed, LoadModel& loads) {
  const std::vector<int> nodes = to_vector(loads.sets.nodes);
  const std::vector<double> weights = to_vector(loads.sets.weight);
  std::vector<int> node;
  std::vector<std::array<double, 2>> weight;
  MotionHistories& histories = loads.motion_histories;
  histories.first = {0};
  for (const int set : loads.history_sets) {
    for (int k = loads.first_of_set[set]; k < loads.first_of_set[set + 1]; ++k) {
      const TiedPlace* tied = ties.place_of(nodes[k]);
      node.push_back(nodes[k]);
      weight.push_back({weights[k], tied ? 0 : weights[k]});
      if (!tied) continue;
      for (int corner = 0; corner < 4; ++corner) {
        node.push_back(tied->face[corner]);
        weight.push_back({0, weights[k] * tied->weight[corner]});
      }
    }
    histories.first.push_back(static_cast<int>(node.size()));
  }
  histories.node = to_device("nodes of motion histories", node);
  histories.weight = to_device("weights of motion histories", weight);
  find_driven(node, prescribed, histories);
}

}  // namespace railwave
