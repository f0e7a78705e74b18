#pragma once

#include <vector>

#include "kernels/nodes/relative_nodes.hpp"

/// The host's side of nodes in single precision (kernels/nodes/corotating_frame.hpp has the formulas).
namespace railwave {

struct AssembledScene;
struct ElementGroup;
struct NodalState;

/// Steps for which the frames' motions are worked out at once.
constexpr int steps_of_block = 64;

/// Nodes in single precision and their co-rotating frames, one for each part and point mass: the rigid motion that
/// suits its velocities best when the run begins. From then on these nodes are the state, and the double ones follow:
/// those that external forces or constraints concern at every step, the others for samples and outputs. Empty unless
/// the case asks for precision = "float".
struct RelativeNodes {
  struct Range {
    int first, count;  ///< nodes of a frame
  };

  Array<RelativeNode*> node;
  Array<FrameArm*> shared_arm;  ///< of each shared node
  Array<FrameMotion*> motion;   ///< by frame
  Array<FrameStep*> steps;      ///< of a block of steps, see ComputeFrameSteps
  std::vector<Range> range;     ///< by frame
  std::vector<Range> own;  ///< by frame, in NodalState::own_nodes: of these alone a rank makes coordinates; empty: all
  std::vector<FrameMotion> host_motion;  ///< empty: not found yet
  bool begun = false;                    ///< the relative coordinates have been made
  long block_step = 0;                   ///< the block's first step
  double block_time = 0;                 ///< s, its time since then
  double block_size = 0;                 ///< s, of its steps; 0: none is computed yet

  bool active() const { return !range.empty(); }
  double time_of(long step) const { return block_time + static_cast<double>(step - block_step) * block_size; }
};

/// What blocks have besides where nodes are in single precision; see RelativeArrays. Empty otherwise.
struct RelativeBlocks {
  Array<float*> local;
  Array<FrameArm*> arm;
  std::vector<int> point;  ///< node that is each block's own point
};

/// The frames' motions from all nodes as they stand in double precision.
void find_frames(const AssembledScene& assembled, NodalState& nodal);

/// Makes the relative coordinates from the nodes as they stand in double precision, with frames that are found now
/// where they have not been.
void begin_relative_nodes(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal);

/// Has the frames on the device, and the arms of blocks and of shared nodes that follow from them.
void place_frames(const std::vector<ElementGroup>& groups, const NodalState& nodal);

/// A rank makes coordinates of the model's own nodes alone.
void keep_relative_nodes(NodalState& nodal);

/// Has the frames' values on the device for the step from the present instant to the next, of size `step`
/// (s).
void compute_frame_steps(const ExecutionSpace& space, NodalState& nodal, double step);

/// Brings the nodes in double precision to the present instant.
/// @param order in which the launches come
void update_absolute_nodes(const NodalState& nodal, const ExecutionSpace& order = ExecutionSpace());

/// What moves a group's nodes over a step of size `step` (s).
RelativeAdvance relative_advance(const NodalState& nodal, const RelativeBlocks& blocks, double step);

}  // namespace railwave
