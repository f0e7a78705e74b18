#pragma once

#include "kernels/nodes/nodes.hpp"
#include "model/assembled_scene.hpp"
#include "model/contact/contact_pair.hpp"

namespace railwave {

/// A slave node that presses, or may soon press, on a master's segment.
struct ContactSpring {
  int slave = 0;         ///< position among the pair's slave nodes
  int slave_node = 0;    ///< model node number
  double stiffness = 0;  ///< N/m, of the stiffest segment about the place, at the penetration where it is largest
  double damping = 0;    ///< N s/m along the normal, the most that the law takes of it
  Vec3 normal{};         ///< of the master's surface there
  std::array<int, 4> master_nodes{};  ///< corners of the segment, model node numbers
  std::array<double, 4> share{};      ///< shape functions at the place, thesis eq. 2.24b
};

/// Which slave nodes count as able to press.
struct ContactReach {
  double horizon = 0;  ///< s, within which they may come to touch at the bodies' present velocities
  double share = 0.1;  ///< of the local element size: nodes as near as that touch; penetrations and the sag of coarse
                       ///< surfaces are below it
  bool near = false;   ///< also what the last check of the contact found near enough to touch before the next one
};

/// The springs of every slave node that touches now or may soon. A pair far apart has none.
/// @param mass kg, by node
std::vector<ContactSpring> possible_contact_springs(const std::vector<double>& mass, const NodeArrays& nodes,
                                                    const ContactPair& pair, const ContactReach& within);

/// What contact may put on each node at worst, by model node number; zero where no surface is.
struct ContactOnNodes {
  std::vector<double> stiffness, damping;  ///< N/m, N s/m
};

/// The stiffest and most strongly damped springs that the pairs' laws allow, wherever the bodies may touch; where
/// slaves are finer than the master, several on each of its nodes; and those of all pairs that a node belongs to
/// together.
ContactOnNodes contact_on_nodes(const AssembledScene& assembled, const std::vector<ContactPair>& contacts);

}  // namespace railwave
