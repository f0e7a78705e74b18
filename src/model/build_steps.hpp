#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/prescribed_nodes.hpp"
#include "model/boundaries/ties.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/elements/element_model.hpp"
#include "model/loads/load_model.hpp"
#include "model/nodal_state.hpp"
#include "model/ranks/transport.hpp"

/// The steps of build_model, each in a file of its own.
namespace railwave {

struct BeamModel;
struct Model;

/// contradictions.cpp: InputError for [solver] settings that the time loop does not support
void refuse_unknown_methods(const scene::Scene& scene);
/// model_memory.cpp: InputError when the arrays of a model of these parts can't fit where the steps are computed, on
/// the host or a GPU
void expect_model_memory(const Assembly& assembly);
/// element_groups.cpp: InputError for an element that is inverted or flat
void check_elements(const AssembledScene& assembled);
/// element_groups.cpp: lengths of elements, masses of nodes
void weigh_elements(AssembledScene& assembled);
/// element_groups.cpp: groups of blocks with their nodes and constants of materials
void build_blocks(const AssembledScene& assembled, const AbsorbingLayers& absorbing, ElementModel& elements);
/// fill_blocks.cpp: what elements of blocks are computed with beside their nodes
/// @param rank whose blocks are filled, where ElementGroup::owner says whose they are; -1: all
void fill_blocks(const AssembledScene& assembled, const AbsorbingLayers& absorbing, int rank, ElementModel& elements);
/// fill_blocks.cpp: what steps change of blocks, and what they leave for the nodes
void build_block_state(ElementModel& elements, PartialForces& partial);
/// node_arrays.cpp: masses, constraints
void build_node_masses(const AssembledScene& assembled, const Ties& ties, NodalState& nodal);
/// node_arrays.cpp: which rows of partial forces a node adds, and which nodes blocks advance
void build_gather(std::vector<ElementGroup>& groups, NodalState& nodal);
/// node_arrays.cpp: places, reference and present, and velocities
/// @param wanted by node, those whose places are set; empty: all
void build_node_places(const Assembly& assembly, const std::vector<char>& wanted, NodeArrays& nodes);
/// node_arrays.cpp: the reference of these nodes; of others it stays
void set_reference(const Assembly& assembly, const std::vector<char>& wanted, const NodeArrays& nodes);
/// node_arrays.cpp: positions as in the reference
void put_at_reference(const NodeArrays& nodes);
/// relative_coordinates.cpp: nodes in single precision
/// @param rank whose blocks are filled; -1: all
void build_relative_nodes(const AssembledScene& assembled, int rank, std::vector<ElementGroup>& groups, Ties& ties,
                          NodalState& nodal);
/// model.cpp: masses, beams, contacts with their algorithms, ties
void build_bodies(Model& model);
/// beams.cpp: sections, masses, rotations
void build_beams(AssembledScene& assembled, std::shared_ptr<BeamModel>& beams);
/// loads.cpp: loads, connectors, moments on beams, node sets
Contributions build_loads(const AssembledScene& assembled, const std::shared_ptr<BeamModel>& beams, LoadModel& loads);
/// motion_histories.cpp: nodes whose motion is written
void build_motion_histories(const Ties& ties, const std::vector<PrescribedSet>& prescribed, LoadModel& loads);
/// external_forces.cpp: rows of the nodes on which other forces than elements' act, and the contributions to each
void build_external_forces(const Assembly& assembly, const Contributions& contributions,
                           std::vector<ContactPair>& contacts, Ties& ties, NonReflectingEnds& ends, NodalState& nodal);
/// set_teams.cpp: which team sums which sets, and gathers which rows, after the external forces
void build_set_teams(const std::shared_ptr<BeamModel>& beams, const ExternalForces& external, LoadModel& loads);
/// prescribed_nodes.cpp: sets of nodes that move as rigid motions say, after the external forces
void build_prescribed_motions(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                              const Ties& ties, const NodalState& nodal, std::vector<PrescribedSet>& prescribed);
/// ties.cpp: places of slave nodes on their masters' faces
void build_ties(const AssembledScene& assembled, const std::vector<ContactPair>& contacts, Ties& ties);
/// non_reflecting_ends.cpp: dashpots of the ends
void build_non_reflecting(const AssembledScene& assembled, const std::vector<ContactPair>& contacts,
                          NonReflectingEnds& ends);
/// element_histories.cpp: elements whose stress or strain is written
void build_element_histories(const AssembledScene& assembled, ElementModel& elements);
/// sum_parts.cpp: parts of the lists over which accounts and histories sum
void build_sum_parts(int node_count, ElementModel& elements, LoadModel& loads);
/// contact_pairs.cpp: surfaces, stiffnesses, and what is beyond their sides. An automatic algorithm has springs until
/// choose_algorithms()
void build_contacts(const AssembledScene& assembled, std::vector<ContactPair>& contacts);
/// contact_pairs.cpp: arrays of multipliers, law of the springs, as the pair's contact has its algorithm
void set_algorithm(ContactPair& pair);
/// choose_algorithm.cpp: of contacts whose algorithm is automatic
void choose_algorithms(AssembledScene& assembled, std::vector<ContactPair>& contacts);
/// contradictions.cpp: InputError for entries that contradict each other
void refuse_contradictions(const AssembledScene& assembled, const std::vector<ContactPair>& contacts);
/// rolling.cpp: angular velocities of initial motions that roll
void resolve_rolling(AssembledScene& assembled);
/// stable_step.cpp: the stable step by each estimate, which may need the frequency of the whole model. plan_steps then
/// sets the size and number of steps
/// @param transport of the ranks that make the model together; null: this process is alone
void build_stable_step(Model& model, Transport* transport = nullptr);
/// stable_step.cpp: what other ranks do while rank 0 builds the stable step
void help_with_stable_step(Model& model, Transport& transport);
/// subcycling.cpp: levels of nodes
void build_subcycling(const std::vector<ElementGroup>& groups, const NonReflectingEnds& ends, NodalState& nodal);
/// node_order.cpp: of shared nodes those that nothing but elements concern come first, and last those of multipliers,
/// prescribed motions, ties and non-reflecting ends, beside which a device moves the others
/// @param in_parts whether elements may be computed in parts
void order_shared_nodes(const std::vector<ElementGroup>& groups, const std::vector<ContactPair>& contacts,
                        const std::vector<PrescribedSet>& prescribed, const Ties& ties, const NonReflectingEnds& ends,
                        bool in_parts, NodalState& nodal);
/// left_out.cpp: what the scene does not need and the run will not compute
std::vector<std::string> what_is_left_out(const scene::Scene& scene);

}  // namespace railwave
