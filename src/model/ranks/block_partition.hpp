#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave {

/// Which rank of a run over several processes computes each block of elements. Blocks are the same whatever the number
/// of ranks, and so are the rows of partial forces that they leave, which is why results do not depend on it.
///
/// Rank 0 has every block with a node on which anything but elements and contact's springs acts: contact by
/// multipliers, ties, connectors, torques, beams, loads with rows of their own, prescribed motions, non-reflecting
/// ends. The others are dealt out by METIS so that ranks have alike work and few nodes in common. Springs are rank 0's,
/// too: it moves the nodes of both surfaces with the ranks whose blocks have them, and sends these the forces.
struct BlockPartition {
  int ranks = 1;
  std::vector<std::vector<int>> owner;  ///< by group and block
  std::vector<double> work;             ///< by rank: element evaluations a step, and what contact and, on GPUs, small
                                        ///< launches are worth in these
  std::vector<long> elements;           ///< by rank
  long bound_elements = 0;              ///< of the blocks that rank 0 must have

  /// Largest work of a rank over the mean.
  double imbalance() const;
};

/// Throws InputError where the program was built without MPI and METIS.
BlockPartition partition_blocks(const Model& model, int ranks);

/// The rank that computes each element, in the model's order of elements.
std::vector<int> ranks_of_elements(const Model& model, const BlockPartition& partition);

/// Gives each block its owner on all ranks, as rank 0 has dealt them out: whatever the others' processors make of
/// METIS. Throws what partition_blocks() throws, on other ranks std::runtime_error.
void deal_out_blocks(Model& model, Transport& transport);

/// The partition that deal_out_blocks() has left in a model: owners alone.
BlockPartition partition_of(const Model& model, int ranks);

/// Nodes of the surfaces that meet by springs, ascending.
std::vector<int> nodes_of_contact_springs(const Model& model);

/// Whether rank 0 needs all arrays before it deals a scene out: to settle it, to set it in motion, to find contact, the
/// frames of nodes in single precision, and to search the frequencies of more than its elements. On a GPU memory is
/// taken when arrays are made, not when they are touched.
bool rank_0_needs_all(const scene::Scene& scene);

/// What a process is expected to take at most, bytes: while the model is made; in steps, before a checkpoint or a field
/// that is made of whole blocks brings everything to rank 0.
struct RankMemory {
  double making = 0, steps = 0;
  double peak() const { return making > steps ? making : steps; }
};

/// By rank; of one process where the partition is for one.
/// @param model whole, as one process has it
std::vector<RankMemory> forecast_memory(const Model& model, const BlockPartition& partition);

/// What a run over several ranks would be like, a line each.
std::vector<std::string> describe_ranks(const Model& model, const BlockPartition& partition);

}  // namespace railwave
