#include <algorithm>
#include <cmath>

#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Unit of the whole numbers in which contact forces are summed, N: a power of two. The sum must hold the force of the
/// stiffest contact spring at a penetration of a tenth of its segment's diagonal (some 17 GPa on the segment, whatever
/// the penalty's scale). Multipliers push as hard as the stiffer body can: one that strikes a soft one is stopped by
/// what the other's mass takes, whatever its stiffness.
double contact_quantum(const std::vector<ContactPair>& contacts) {
  double largest = 1e-30;
  for (const ContactPair& pair : contacts)
    for (double stiffness : pair.segment_stiffness)
      largest = std::max(
          largest, 0.1 * pair.segment_size * pair.growth * stiffness / std::min(1.0, pair.contact->penalty_scale));
  for (const ContactPair& pair : contacts)
    if (!pair.has_springs()) largest = std::max(largest, pair.slave_strength);
  return std::exp2(std::ceil(std::log2(largest / ExternalForceSum::largest)));
}

}  // namespace

void build_external_forces(const Assembly& assembly, const Contributions& contributions,
                           std::vector<ContactPair>& contacts, Ties& ties, NonReflectingEnds& ends, NodalState& nodal) {
  std::vector<int> concerned = contributions.node;
  for (const ContactPair& pair : contacts) {
    concerned.insert(concerned.end(), pair.slave_nodes.begin(), pair.slave_nodes.end());
    concerned.insert(concerned.end(), pair.master_nodes.begin(), pair.master_nodes.end());
  }
  // Ties and non-reflecting ends add their forces to the load of a node: its row needs that sum, even if no load acts.
  std::vector<char> of_tie(assembly.nodes.size(), 0), of_end(assembly.nodes.size(), 0);
  for (int n : ties.masters) of_tie[n] = 1;
  for (int n : ends.nodes) of_end[n] = 1;
  for (const auto* nodes : {&ties.masters, &ends.nodes})
    concerned.insert(concerned.end(), nodes->begin(), nodes->end());
  std::sort(concerned.begin(), concerned.end());
  concerned.erase(std::unique(concerned.begin(), concerned.end()), concerned.end());
  const int rows = static_cast<int>(concerned.size());
  std::vector<int> row_of_node(assembly.nodes.size(), -1);
  for (int r = 0; r < rows; ++r) row_of_node[concerned[r]] = r;

  std::vector<int> first(rows + 1, 0);
  for (int n : contributions.node) ++first[row_of_node[n] + 1];
  for (int r = 0; r < rows; ++r) first[r + 1] += first[r];
  const auto bears_load = [&](int n) {
    const int r = row_of_node[n];
    return of_end[n] != 0 || (r >= 0 && first[r] < first[r + 1]);
  };
  for (ContactPair& pair : contacts)
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes) pair.loaded = pair.loaded || of_tie[n] != 0 || bears_load(n);
  ties.unloaded = std::none_of(ties.masters.begin(), ties.masters.end(), bears_load) &&
                  std::none_of(ties.places.begin(), ties.places.end(),
                               [&](const TiedPlace& tied) { return bears_load(tied.slave); });
  std::vector<int> filled(first.begin(), first.end() - 1);
  std::vector<RowShare> sorted(contributions.node.size());
  for (const RowShare& share : contributions.share)
    sorted[filled[row_of_node[contributions.node[share.contribution]]]++] = share;
  std::vector<LoadedRow> loaded;
  for (int r = 0; r < rows; ++r)
    if (bears_load(concerned[r]) || (of_tie[concerned[r]] != 0 && !ties.unloaded))
      loaded.push_back({r, concerned[r], first[r], first[r + 1]});

  ExternalForces& external = nodal.external;
  external.row_count = rows;
  external.contribution_count = static_cast<int>(contributions.node.size());
  external.sum.load = Array<double* [3]>("load on row", rows);
  external.sum.contact = Array<std::uint64_t* [3]>("contact force on row", rows);
  external.sum.quantum = contact_quantum(contacts);
  external.loaded_count = static_cast<int>(loaded.size());
  external.loaded = to_device("loaded rows", loaded);
  std::vector<int> loaded_of_row(rows, -1);
  for (std::size_t k = 0; k < loaded.size(); ++k) loaded_of_row[loaded[k].row] = static_cast<int>(k);
  external.loaded_of_row = to_device("loaded of row", loaded_of_row);
  external.shares = to_device("shares of rows", sorted);
  external.contribution = Array<double* [3]>("contribution", external.contribution_count);
  external.contribution_node = to_device("node of contribution", contributions.node);
  external.work = Array<double*>("work of contribution", external.contribution_count);
  nodal.nodes.external_row = to_device("external row", row_of_node);

  if (std::any_of(contacts.begin(), contacts.end(), [](const ContactPair& pair) { return !pair.has_springs(); }))
    nodal.free_nodes = {
        Array<SharedNode*>("nodes of rows", rows),   Array<FreeNode*>("free nodes", rows),
        Array<std::uint64_t*>("multiplicity", rows), Array<std::uint64_t* [2][3]>("change of multipliers", rows),
        Array<int*>("listed free nodes", rows),      Array<int*>("number of listed free nodes", 1)};

  std::vector<int> master_rows;
  for (int n : ties.masters) master_rows.push_back(row_of_node[n]);
  ties.arrays.master_rows = to_device("rows of ties", master_rows);
  if (ends.nodes.empty()) return;
  ends.alone.assign(assembly.nodes.size(), 0);
  for (int n : ends.nodes) {
    ends.alone[n] = first[row_of_node[n]] == first[row_of_node[n] + 1] ? 1 : 0;
    ties.at_ends = ties.at_ends || of_tie[n] != 0;
  }
  for (const ContactPair& pair : contacts)
    for (const auto* nodes : {&pair.slave_nodes, &pair.master_nodes})
      for (int n : *nodes) ends.alone[n] = 0;
  for (int n : ties.masters) ends.alone[n] = 0;
}

}  // namespace railwave
