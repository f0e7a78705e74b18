#pragma once

#include "model/model.hpp"

namespace railwave {

/// A slave node that presses, or may soon press, on a master's segment.
struct ContactSpring {
  int slave = 0;          ///< position among the pair's slave nodes
  int slave_node = 0;     ///< model node number
  double stiffness = 0;   ///< N/m, of the stiffest segment about the place
  Vec3 normal{};          ///< of the master's surface there
  std::array<int, 4> master_nodes{};  ///< corners of the segment, model node numbers
  std::array<double, 4> share{};      ///< shape functions at the place, thesis eq. 2.24b
};

/// The springs of every slave node that touches now or may within `horizon` seconds at the bodies' present velocities.
/// A pair far apart has none.
std::vector<ContactSpring> possible_contact_springs(const Model& model, const ContactPair& pair, double horizon);

}  // namespace railwave
