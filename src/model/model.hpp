#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/scene.hpp"
#include "kernels/boundaries/non_reflecting.hpp"
#include "kernels/contact/contact_normals.hpp"
#include "kernels/contact/law_at_nodes.hpp"
#include "kernels/contact/multiplier_arrays.hpp"
#include "kernels/elements/damping_arrays.hpp"
#include "kernels/elements/element_force.hpp"
#include "kernels/loads/set_loads.hpp"
#include "kernels/materials/material.hpp"
#include "kernels/nodes/carried_nodes.hpp"
#include "kernels/nodes/nodes.hpp"
#include "kernels/support/reduction_space.hpp"
#include "kernels/ties/tie.hpp"
#include "model/assembly.hpp"
#include "model/elements/block_order.hpp"
#include "model/loads/connector_cells.hpp"
#include "model/output_times.hpp"
#include "model/subcycling.hpp"

namespace railwave {

/// What blocks have besides where nodes are in single precision; see CarriedArrays. Empty otherwise.
struct CarriedBlocks {
  Array<float*> local;
  Array<CarriedArm*> arm;
};

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

/// The elements that one kernel works on: those of all parts with the same kind of material and hourglass control,
/// damped or not.
struct ElementGroup {
  std::string parts;  ///< their names, for the summary
  scene::HourglassType hourglass = scene::HourglassType::viscous;
  int level = 0;  ///< evaluated every 2^level steps; groups ascend by it
  ElementBlocks blocks;
  MaterialArrays material;
  DampingArrays damping;
  CarriedBlocks carried;
  int first_partial = 0;            ///< row of the first block's first node in the partial forces
  std::vector<int> first_element;   ///< of each block, in the assembly's numbering
  std::vector<int> element_count;   ///< of each block
  Array<double* [2]> block_energy;  ///< J, elastic and hourglass, of each block: where the account works
  PinnedArray<double* [2]> block_energy_fetched;

  /// Rows of the partial forces up to the group's last.
  int rows_end() const {
    return (damping.active() ? damping.first_partial : first_partial) + blocks.count * blocks.node_stride;
  }
};

/// A load of fixed direction, a pressure or a torque: its contributions, and the curve it follows.
struct LoadArrays {
  const scene::Load* load = nullptr;
  const scene::Curve* curve = nullptr;  ///< null: constant 1
  int first = 0;                        ///< its first contribution
  int count = 0;                        ///< contributions (dead loads), facets (pressure)
  Array<double* [3]> amplitude;         ///< dead loads, N
  Array<int* [4]> facets;               ///< pressure
  int set = -1;                         ///< torque
  int torque = -1;                      ///< its number among the torques
  int beam_node = -1;                   ///< of a torque on a node where beams end: its number among those
};

/// Connectors of a scene, with the contributions by which their ends feel them.
struct ConnectorModel {
  std::vector<ConnectorCell> cells;  ///< one for each of the arrays' entries
  ConnectorArrays arrays;
  int first = 0;              ///< contribution
  std::vector<int> cell;      ///< of each contribution
  std::vector<double> share;  ///< weight, negative at `from`
};

struct ContactPair {
  const scene::Contact* contact = nullptr;
  ContactArrays arrays;
  ContactLawArrays law;
  ContactWindow window;
  MultiplierArrays multipliers;  ///< of the second algorithm, see kernels/contact/contact_multiplier.hpp
  Array<double*[3]> slaves_at_layout, masters_at_layout;  ///< m, where the surfaces were when the window was laid out
  long next_look = -1;                                    ///< step at which the window is looked at again
  long next_near_look = -1;  ///< step at which the nodes that can touch are picked out of it again
  bool boxed = false;        ///< the master's boxes hold until then
  long layouts = 0;          ///< how often it was laid out
  long looks = 0;            ///< how often it was looked at, the host waiting
  bool loaded = false;       ///< loads or connectors act on its nodes
  bool has_springs() const { return !multipliers.active(); }
  bool own_master = true;     ///< no other forces than the pair's on slaves reach the master's nodes
  bool reversed = false;      ///< the second half of a symmetric contact: surfaces exchanged, told with the first
  int partner = -1;           ///< the other half of a symmetric contact, -1: none
  std::vector<char> on_both;  ///< by slave: a node of the master too, at a seam's end, where it can't meet itself
  Array<int*> missed;         ///< one: see ContactLook
  std::vector<int> slave_nodes, master_nodes;       ///< host copies, model node numbers
  std::vector<std::array<int, 4>> slave_facets;     ///< positions in slave_nodes
  std::vector<std::array<int, 4>> master_segments;  ///< positions in master_nodes
  std::vector<double> segment_stiffness;            ///< N/m, at no penetration
  double growth = 1;                                ///< largest factor on that, at any penetration
  double segment_size = 0;                          ///< m, the largest segment's diagonal
};

/// A node set that moves as a rigid motion says, in the directions that are prescribed.
struct PrescribedSet {
  const scene::PrescribedMotion* motion = nullptr;
  const scene::Curve* curve = nullptr;  ///< of the velocities; null: constant 1
  const scene::Curve* displacement_curve = nullptr;
  double held[3][3] = {};  ///< sum of d d^T over the prescribed directions d
  Vec3 centre{};           ///< m, of the rotation, undeformed
  Array<int*> nodes;
  Array<double*> work;  ///< J, by node of the set
};

/// All non-reflecting ends together.
struct NonReflectingEnds {
  NonReflectingArrays arrays;
  std::vector<int> nodes;   ///< ascending
  std::vector<char> alone;  ///< by node of the model: feels no other extra forces; may have a pace of its own
};

/// Zones at the ends of parts whose mass-proportional damping grows towards the end: see
/// model/boundaries/absorbing_layer.hpp.
struct AbsorbingLayers {
  struct Zone {
    int layer = 0;           ///< position in scene.absorbing_layers
    int part = 0;            ///< position in assembly.parts
    Vec3 end{}, outwards{};  ///< m, a point of the end's plane; its normal, of length 1
    double rate = 0;         ///< 1/s, at the end
    double element = 0;      ///< m, the longest element along the normal at the end
    int nodes = 0;           ///< of the part that it damps
  };
  std::vector<Zone> zones;   ///< in the order of the scene's layers
  std::vector<double> rate;  ///< 1/s by node; empty: there are none
};

/// All ties together.
struct Ties {
  TieArrays arrays;
  std::vector<TiedPlace> places;  ///< host copy
  std::vector<int> masters;       ///< ascending
  Array<int*> carrier;            ///< by slave, where nodes are in single precision
};

/// The stable step, s, by each estimate, and what sets it.
struct StableStep {
  double elements = 0;     ///< min V / (A_max C_d), thesis eq. 2.14
  int element = -1;        ///< the element that sets it
  double contact = 0;      ///< of the contact springs with the elements under them; 0: no contact
  double connector = 0;    ///< of springs and dashpots on the masses of their ends; 0: none
  double beam = 0;         ///< of the beams with the mass that is theirs; 0: none
  double by_elements = 0;  ///< these together

  double eigenvalue = 0;  ///< of the element with the highest eigenvalue, hourglass control included
  int eigenvalue_element = -1;
  double eigenvalue_contact = 0;  ///< of the contact springs with such elements under them; 0: no contact
  double by_eigenvalues = 0;      ///< these and the connectors together

  double global = 0;                    ///< of the whole scene at its last renewal; 0: not asked for
  long springs = 0;                     ///< contact springs counted in it
  std::vector<std::vector<char>> seen;  ///< by contact pair and slave node: whether its spring was

  double limit = 0;  ///< by the estimate that the case chose
};

class GlobalEstimate;
struct BeamModel;
struct ElementHistories;

/// Everything on the device, and the host data that describe it.
struct Model {
  scene::Scene scene;
  Assembly assembly;
  std::vector<double> mass;            ///< kg by node, host copy
  std::vector<double> element_length;  ///< m, V / A_max by element
  StableStep stable_step;
  std::shared_ptr<GlobalEstimate> global_estimate;  ///< null unless the case asks for it
  double step_size = 0;  ///< s, of the present step: the scale factor's share of the stable one, in whole steps
  long step_count = 0;   ///< steps from 0 to the end, if the step stays
  OutputTimes output_times;

  NodeArrays nodes;
  CarriedNodes carried;
  Array<double* [3][3]> constraints;
  BlockOrder order;
  std::vector<ElementGroup> elements;
  Subcycling subcycling;
  PartialForces partial;
  Array<SharedNode*> shared_nodes;  ///< those that no block advances by itself
  ExtraForces extra;
  NodeSets sets;
  std::vector<int> first_of_set;  ///< host copy of sets.first
  std::shared_ptr<ReductionSpace> reduction_space =
      std::make_shared<ReductionSpace>();  ///< of the account, the watch, the static start
  std::vector<int> history_sets;  ///< set numbers of those of scene.output.history_sets whose motion is written
  std::shared_ptr<ElementHistories> element_histories;  ///< null where no history of stress or strain is written
  std::vector<LoadArrays> loads;
  ConnectorModel connectors;
  TorqueArrays torques;
  std::shared_ptr<BeamModel> beams;  ///< null in a scene without beams
  std::vector<PrescribedSet> prescribed;
  NonReflectingEnds ends;
  AbsorbingLayers absorbing;
  Ties ties;
  std::vector<ContactPair> contacts;  ///< of the scene's contacts in order, then the reversed ones
  std::vector<std::string> left_out;  ///< what the scene does not need and the run will not compute

  /// The present instant: forces and positions at `time`; velocities `velocity_lag` seconds before it.
  double time = 0;
  long step = 0;
  double velocity_lag = 0;

  int node_count() const { return nodes.count; }
  long element_count() const { return static_cast<long>(assembly.elements.size()); }

  /// Force and acceleration of a node from what the last force phase left in the arrays.
  NodalAcceleration acceleration() const {
    return {{nodes, partial, extra.sum}, {{scene.gravity[0], scene.gravity[1], scene.gravity[2]}}, constraints};
  }

  /// The same as the scheme uses it at an instant when all levels are in phase: v(t) = v(stored) + pace lag
  /// acceleration.
  PacedAcceleration paced_acceleration() const { return {acceleration(), subcycling.paces}; }
};

/// Builds the device arrays of a scene. Throws InputError for what only the mesh can show: unknown sets, inverted
/// elements, contact surfaces that share nodes, a part without mass.
/// A Model refers to itself; it is not to be copied or moved.
void build_model(const scene::Scene& scene, Model& model);

/// The same from an assembly made elsewhere, one part of it for each of the scene's.
void build_model(const scene::Scene& scene, const Assembly& assembly, Model& model);

/// Bytes of all device arrays.
std::size_t device_bytes(const Model& model);

/// Lays the frames from which single precision measures a group's displacements where its blocks are now.
void renew_frames(const Model& model, const ElementGroup& group);

/// Puts nodes and history variables back to the undeformed start, at rest.
void reset_to_start(Model& model);

/// The scene's curve of that name; null for an empty name.
const scene::Curve* curve_of(const scene::Scene& scene, const std::string& name);

/// Value of a curve at a time; 1 without a curve.
double curve_value(const scene::Curve* curve, double time);

/// Its integral from 0 to a time of 0 or later, s.
double curve_integral(const scene::Curve* curve, double time);

}  // namespace railwave
