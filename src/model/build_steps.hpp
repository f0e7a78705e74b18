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

/// The steps of build_model, each in a file of its own.
namespace railwave {

struct BeamModel;
struct Model;

/// solver_support.cpp: InputError for [solver] settings that the time loop does not support
void refuse_unknown_methods(const scene::Scene& scene);
/// model_memory.cpp: InputError when the arrays of a model of these parts can't fit where the steps are computed, on
/// the host or a GPU
void expect_model_memory(const Assembly& assembly);
/// element_groups.cpp: InputError for an element that is inverted or flat
void check_elements(const AssembledScene& assembled);
/// element_groups.cpp: blocks, hourglass scales, lengths, masses
void build_elements(AssembledScene& assembled, const AbsorbingLayers& absorbing, ElementModel& elements,
                    PartialForces& partial);
/// node_arrays.cpp: state, gather lists, constraints
void build_node_arrays(const AssembledScene& assembled, const std::vector<ElementGroup>& groups, const Ties& ties,
                       NodalState& nodal);
/// relative_coordinates.cpp: nodes in single precision
void build_relative_nodes(const AssembledScene& assembled, std::vector<ElementGroup>& groups, Ties& ties,
                          NodalState& nodal);
/// beams.cpp: sections, masses, rotations
void build_beams(AssembledScene& assembled, std::shared_ptr<BeamModel>& beams);
/// loads.cpp: loads, connectors, moments on beams, node sets
Contributions build_loads(const AssembledScene& assembled, const std::shared_ptr<BeamModel>& beams, LoadModel& loads);
/// motion_histories.cpp: nodes whose motion is written
void build_motion_histories(const Ties& ties, const std::vector<PrescribedSet>& prescribed, LoadModel& loads);
/// external_forces.cpp: rows of the nodes on which other forces than elements' act, and the contributions to each
void build_external_forces(const Assembly& assembly, const Contributions& contributions,
                           std::vector<ContactPair>& contacts, Ties& ties, NonReflectingEnds& ends, NodalState& nodal);
/// prescribed_nodes.cpp: sets of nodes that move as rigid motions say
void build_prescribed_motions(const AssembledScene& assembled, std::vector<PrescribedSet>& prescribed);
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
void build_stable_step(Model& model);
/// subcycling.cpp: levels of nodes
void build_subcycling(const std::vector<ElementGroup>& groups, const NonReflectingEnds& ends, NodalState& nodal);
/// node_arrays.cpp: of shared nodes those that nothing but elements concern come first, and last those of multipliers
/// and prescribed motions, beside which a device moves the others
void order_shared_nodes(const std::vector<ContactPair>& contacts, const std::vector<PrescribedSet>& prescribed,
                        NodalState& nodal);
/// left_out.cpp: what the scene does not need and the run will not compute
std::vector<std::string> what_is_left_out(const scene::Scene& scene);

}  // namespace railwave
