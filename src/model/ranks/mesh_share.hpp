#pragma once

#include <vector>

#include "model/model.hpp"
#include "model/ranks/rank_share.hpp"

/// The mesh on several ranks: each makes it, keeps what its own blocks are made of, and has the others' nodes and
/// elements no more. Lists keep the whole mesh's numbers; the memory of what is let go of goes back to the system. Rank
/// 0 gets it back from the arrays of all ranks where it needs the whole mesh in a run: for checkpoints, fields that are
/// made of whole blocks, and warnings. On a GPU the mesh stays as it is on rank 0, see rank_0_needs_all().
namespace railwave {

/// Lets go of what is not of the rank's blocks; rank 0 keeps nodes of no block, of sets, and those that are written.
void keep_mesh_of_blocks(Model& model, int rank);

/// Lets go of all but nodes of no block.
void forget_mesh_of_blocks(Model& model);

/// The mesh of a rank's blocks.
struct MeshPiece {
  std::vector<CornerNodes> elements;  ///< block after block
  std::vector<Vec3> nodes;            ///< m, of the rank's nodes in order
};

/// A piece of the right size.
MeshPiece empty_piece(const Model& model, const ShareItems& items);
/// What arrays of blocks and nodes hold of it.
MeshPiece piece_of_arrays(const Model& model, const ShareItems& items);
/// Puts it back into the model's mesh.
void put_back(const MeshPiece& piece, const ShareItems& items, Model& model);

}  // namespace railwave
