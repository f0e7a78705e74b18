#pragma once

#include <unordered_map>
#include <vector>

#include "kernels/ties/tie.hpp"

namespace railwave {

/// All ties together. Each joins the nodes of one surface, its slaves, to faces of another, its master, where they lie
/// undeformed; the two meshes need not match. The slaves' mesh is the finer one, and no master node is itself a slave.
/// Nodes of a contact by multipliers, of a prescribed motion or of a non-reflecting end cannot be slaves.
struct Ties {
  TieArrays arrays;                             ///< their rows of the external forces are known later than the rest
  std::vector<TiedPlace> places;                ///< host copy
  std::unordered_map<int, int> place_of_slave;  ///< by model node number: position in `places`
  std::vector<int> masters;                     ///< ascending
  bool at_ends = false;                         ///< whether a master is a non-reflecting end's node too
  bool unloaded = false;                        ///< neither loads nor non-reflecting ends act on masters and slaves
  Array<int*> frame;                            ///< by slave, where nodes are in single precision

  /// Where a node is tied to; null: nowhere.
  const TiedPlace* place_of(int node) const {
    const auto found = place_of_slave.find(node);
    return found == place_of_slave.end() ? nullptr : &places[found->second];
  }
};

/// Masses by node, in kg of a run or of a relaxation, as the scheme uses them: those of slaves go to their masters by
/// the weights of forces. In motions that ties allow, these masses have no less kinetic energy than the true ones have
/// where they are (Jensen's inequality), so that ties never raise the highest frequency. Slaves keep a trace, as no
/// mass may be zero.
/// @param mass by node, without ties
std::vector<double> masses_with_ties(const Ties& ties, std::vector<double> mass);

}  // namespace railwave
