#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

/// One of a block's nodes.
struct BlockNode {
  int corners;      ///< of the block's elements, that meet there
  int mesh_number;  ///< in the mesh's own order, which lies well in a host's memory
  int number;       ///< in the model's order, in which a device's memory has it
};

/// The order in which a host's block has its nodes: by how many corners meet there, so that sums over corners run
/// equally long side by side.
void order_for_packs(std::vector<BlockNode>& nodes);

/// Threads of a device that go side by side.
inline constexpr int warp_lanes = 32;

/// The order in which a device's block has its nodes: by how many rounds their sums over corners take (see CornerSums),
/// and by number among those, so that threads side by side ask memory for neighbours. Within each warp's nodes, they
/// are moved so that threads that ask for their elements' corners side by side find them in different banks of scratch
/// memory: values whose places differ by a multiple of `banks` come one after the other.
/// @param elements the block's, each with its corners' places in `nodes`
/// @param banks of a value's size, and threads that ask at once: 16 in double precision, 32 in single
void order_for_warps(const std::vector<CornerNodes>& elements, int banks, std::vector<BlockNode>& nodes);

/// How long the corners of a block's elements are asked for, in turns of the banks: for each corner and each group of
/// threads that ask at once, the most values of one bank.
/// @param place of each node, by its place in `nodes` when `elements` were numbered
int bank_turns(const std::vector<CornerNodes>& elements, int banks, const std::vector<int>& place);

}  // namespace railwave
