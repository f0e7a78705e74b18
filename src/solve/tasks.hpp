#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kernels/statics/relaxation.hpp"
#include "model/assembled_scene.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/boundaries/ties.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/elements/element_model.hpp"
#include "model/loads/load_model.hpp"
#include "model/nodal_state.hpp"
#include "solve/ranks/rank_lanes.hpp"

/// The tasks of which plans are made, by physics. A task holds references to the modules that it works on, which must
/// outlive it. Lists are empty where a scene has none of it.
namespace railwave {

struct BeamModel;

/// What tasks must know of time.
struct Instant {
  double time = 0;     ///< s
  double step = 0;     ///< s to the next instant
  double elapsed = 0;  ///< s since the instant before; 0 at the first, and in the pseudo-time of settling
  /// While the step is recorded, where the device finds what follows from its time: by load, load_value(); by
  /// prescribed set, its place at the next instant. See solve/step_recording.hpp.
  const double* load_values = nullptr;
  const RigidPlace* places = nullptr;
  /// In whose order tasks launch; null: the default one's, as while they are recorded.
  const ExecutionSpace* own_space = nullptr;

  ExecutionSpace space() const { return own_space == nullptr ? ExecutionSpace() : *own_space; }

  StepValue<double> value_of(const LoadArrays& load) const {
    return {load_value(load, time), load_values == nullptr ? nullptr : load_values + load.number};
  }
};

/// What a step is for decides what it computes, and how.
enum class StepKind {
  advancing,  ///< nothing is read at its instant: blocks may move the nodes that are theirs alone at once
  sampled,    ///< all forces of the instant are there for outputs and the monitor before any node moves
  settling    ///< on the way to static equilibrium, in pseudo-time
};

/// The stages of a step. A task waits for all tasks of earlier stages.
enum class Stage {
  begin,         ///< frames
  own_forces,    ///< loads, contact by springs, elements: from where the nodes are and how they move
  passed_on,     ///< forces of tied nodes to their masters; at non-reflecting ends that know no ties
  last_forces,   ///< at non-reflecting ends whose nodes are masters of ties
  sums,          ///< of energies, in sampled steps
  motion,        ///< multipliers, prescribed motions, rotations; apart from them, nodes that nothing but loads concerns
  other_motion,  ///< of all other nodes
  tied_motion
};

/// What a task waits for, where tasks run side by side. In the list it comes after all that it waits for in any case.
enum class Begins {
  in_order,          ///< the stages before its own; of elements in parts the first part alone
  beside_loads,      ///< of its step, elements as above, contact, and its own lane; neither loads nor what is passed on
  after_own_forces,  ///< Stage::own_forces, with all parts of the elements. No other task of its step waits for it
  after_elements     ///< elements alone, all of them. Of the next step only elements wait for it
};

/// One piece of physics of a step, or several that one launch computes together.
struct Task {
  std::string name;                         ///< also of the profiler's region around it
  std::string step;                         ///< of the thesis's table 2.1: (a) loads ... (j) geometry
  std::function<void(const Instant&)> run;  ///< launches its kernels
  long every = 1;                           ///< steps from one launch to the next, with subcycling and for frames
  long at = 0;                              ///< in which of them it is launched
  Stage stage = Stage::begin;
  /// Tasks of a stage in different lanes touch nothing in common and may run side by side; those of one go in order.
  int lane = 0;
  /// A lane before its own in number, all of whose tasks it waits for, too; -1: none.
  int joins = -1;
  /// More than a device has room for at a time: where tasks run side by side, others get room first.
  bool bulk = false;
  Begins begins = Begins::in_order;
  int part = 0;                          ///< of elements that are computed in parts, see ElementParts
  RankLane rank_lane = RankLane::inner;  ///< between ranks' GPUs: in whose order it launches
  std::vector<LaneWait> waits = {};      ///< there: before it
  /// Whether all that it does is to launch the same kernels at each step that it is due. If not, it reads nothing that
  /// its step's other tasks write, and may run before them all.
  bool recordable = true;

  bool due(long step_number) const { return step_number % every == at; }

  /// Whether no other task of its step waits for it.
  bool apart() const { return begins == Begins::after_own_forces || begins == Begins::after_elements; }
};

/// Lanes of Stage::own_forces. On a device that the first launches fill, what comes later waits for room: small ones
/// that others wait for come first.
struct OwnForceLanes {
  /// And one more for each further group of elements, then one for the second part of the largest.
  static constexpr int beams = 0, loads = 1, contact = 2, elements = 3;
};

/// Lanes of Stage::motion.
struct MotionLanes {
  /// And one more for each prescribed motion whose nodes no multipliers push. Those with common nodes share one. Of the
  /// early nodes plain ones and others have a lane each.
  static constexpr int contact = 0, early_nodes = 1, rotations = 3, prescribed = 4;
};

/// Puts tasks into a lane of a stage.
std::vector<Task> placed(std::vector<Task> tasks, Stage stage, int lane);

/// Tasks of one list after those of another.
void append(std::vector<Task>& tasks, std::vector<Task> more);

/// What steps of a kind compute in one launch with the first group's elements: see solve/tasks/contributions.hpp.
struct GoingAlong {
  bool contact = false;  ///< the springs of the only contact pair
  bool sets = false;     ///< and sets of nodes that move as one, connectors and torques
};

/// Which blocks of a model's groups are computed: a rank's share comes in two such lists.
struct ListedBlocks {
  const std::vector<Array<int*>>* of_group = nullptr;  ///< null: all
  bool first = true;                                   ///< what is done once for all blocks is done with these
};

/// Before all else: nodes in single precision, and the double ones where these are read.
Task corotating_frames_task(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, NodalState& nodal,
                            StepKind kind);

/// Before elements in single precision: the frames from which their displacements are measured.
std::vector<Task> frame_tasks(const NodalState& nodal, const ElementModel& elements, StepKind kind);

/// (a) Loads, connectors, torques, beams, and their gather at the nodes. In advancing steps the beams' rotations, too
/// (f to j): they follow from the beams' own moments.
std::vector<Task> load_tasks(const NodalState& nodal, const LoadModel& loads, const std::shared_ptr<BeamModel>& beams,
                             StepKind kind, GoingAlong along);

/// (d) Search, and forces by penalty springs.
std::vector<Task> contact_tasks(const scene::Scene& scene, const NodalState& nodal, std::vector<ContactPair>& contacts,
                                StepKind kind, GoingAlong along);

/// (b, c) Element forces with hourglass control, and damping. In an advancing step they move the nodes that belong to
/// one block alone, so they come after all that must still find these nodes where they were.
/// @param contacts, loads of which the elements take along what `along` says
std::vector<Task> element_tasks(const NodalState& nodal, const ElementModel& elements,
                                const std::vector<ContactPair>& contacts, const LoadModel& loads, StepKind kind,
                                GoingAlong along, const ListedBlocks& listed = {});

/// (d) Lagrange multipliers, of all pairs that have them at once: they may meet in a node.
struct MultiplierTasks {
  std::vector<Task> locate;  ///< search, and the last step's forces: from where the nodes are
  std::vector<Task> find;    ///< predicts where all other forces take the nodes, so it comes after these
};

/// @param relaxation how the nodes move while a scene settles; null: by the central difference
MultiplierTasks multiplier_tasks(const scene::Scene& scene, const NodalState& nodal, std::vector<ContactPair>& contacts,
                                 StepKind kind, const RelaxationUpdate* relaxation = nullptr);

/// (a) Forces on tied nodes go to their masters: after all others on them.
std::vector<Task> tie_tasks(const NodalState& nodal, const Ties& ties);

/// (a) Dashpots, after all other forces on their nodes. None while a scene settles.
std::vector<Task> non_reflecting_tasks(const NodalState& nodal, const NonReflectingEnds& ends, StepKind kind);

/// (a) Beams, and torques on points.
Task beam_task(const NodalState& nodal, const BeamModel& built, StepKind kind);

/// (g) Nodes that a motion is prescribed for, before the others; placed.
std::vector<Task> prescribed_tasks(const NodalState& nodal, const std::vector<PrescribedSet>& prescribed);

/// (f) to (j) Rotations of beams.
Task rotation_task(const NodalState& nodal, const BeamModel& built);

/// How the nodes move that wait for nothing but elements and loads, NodalState::early_shared.
enum class EarlyNodes {
  with_others,    ///< in one launch: where tasks come one after the other
  beside_motion,  ///< beside multipliers and prescribed motions
  apart           ///< beside all that comes after the elements: with ties that is a chain of small launches. Where the
                  ///< elements come in parts, nodes that nothing but elements concerns beside all but elements
};

/// (f) to (j) Accelerations, constraints, velocities and positions of all nodes that no block has moved.
std::vector<Task> node_tasks(const NodalState& nodal, const std::vector<ElementGroup>& groups, const LoadModel& loads,
                             StepKind kind, GoingAlong along, EarlyNodes early);

/// (f to j) The same of a rank, in an advancing step without subcycling, where they need not wait for each other.
struct RankNodeTasks {
  std::vector<Task> own_plain;      ///< that wait for elements of this rank alone
  std::vector<Task> own;            ///< that wait for contact and loads, too
  std::vector<Task> between_ranks;  ///< for rows of other ranks, too, and for no inner blocks
  std::vector<Task> late;           ///< see NodalState::first_late
};
RankNodeTasks rank_node_tasks(const NodalState& nodal, const LoadModel& loads);

/// Tied nodes after their masters.
Task tied_nodes_task(const NodalState& nodal, const Ties& ties, StepKind kind);

/// Whether a pair has friction in steps of a kind: a scene may settle without.
bool has_friction(const scene::Scene& scene, const ContactPair& pair, StepKind kind);

/// Keeps a pair's window true, at two distances. The window lists the slave nodes that could touch the master in the
/// next hundreds or thousands of steps; it is laid out on the host, anew when the surfaces have moved far enough. Out
/// of it the nodes that can touch in the next few dozen steps are picked on the device, nothing returning to the host.
/// All others are surely apart, so the result does not depend on how often either is done.
void keep_window(const scene::Scene& scene, const NodalState& nodal, ContactPair& pair, const Instant& instant,
                 StepKind kind);

/// A line for each pair of which that was not true: bodies so fast out of nothing that nodes began to touch unforeseen;
/// and for each of which nodes are in the other body without having come in through its surface.
std::vector<std::string> late_contacts(const std::vector<ContactPair>& contacts);

}  // namespace railwave
