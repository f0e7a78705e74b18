#pragma once

#include <vector>

#include "kernels/nodes/carried_nodes.hpp"

/// The host's side of nodes in single precision (kernels/nodes/carrier.hpp says how they are told).
namespace railwave {

struct AssembledScene;
struct ElementGroup;
struct NodalState;

/// Nodes in single precision and their carriers, one for each part and point mass: the rigid motion that suits its
/// velocities best when the run begins. From then on these nodes are the state, and the double ones follow: those that
/// extra forces or constraints concern at every step, the others when somebody looks. Empty unless the case asks for
/// precision = "float".
struct CarriedNodes {
  struct Range {
    int first, count;  ///< nodes of a carrier
  };

  Array<CarriedNode*> node;
  Array<CarriedArm*> shared_arm;  ///< of each shared node
  Array<CarrierMotion*> motion;   ///< by carrier
  Array<CarrierStep*> steps;      ///< of a block of steps, see LayCarrierSteps
  std::vector<Range> range;       ///< by carrier
  std::vector<CarrierMotion> host_motion;
  bool begun = false;     ///< the nodes have been taken over
  long block_step = 0;    ///< the block's first step
  double block_time = 0;  ///< s, its time since the nodes were taken over
  double block_size = 0;  ///< s, of its steps; 0: none is laid

  bool active() const { return !range.empty(); }
  double time_of(long step) const { return block_time + static_cast<double>(step - block_step) * block_size; }
};

/// What blocks have besides where nodes are in single precision; see CarriedArrays. Empty otherwise.
struct CarriedBlocks {
  Array<float*> local;
  Array<CarriedArm*> arm;
};

/// Takes the nodes over as they stand in double precision. Whoever writes to those later calls this again.
void take_nodes_over(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal);

/// Has the carriers' values at hand on the device for the step from the present instant to the next, of size `step`
/// (s).
void lay_carrier_steps(NodalState& nodal, double step);

/// Brings the nodes in double precision to the present instant.
void give_nodes_back(const NodalState& nodal);

/// What moves a group's nodes over a step of size `step` (s).
CarriedAdvance carried_advance(const NodalState& nodal, const CarriedBlocks& blocks, double step);

}  // namespace railwave
