#pragma once

#include "model/model.hpp"

/// The steps of build_model, each in a file of its own.
namespace railwave {

void refuse_unknown_methods(
    const scene::Scene& scene);           ///< solver_support.cpp: InputError for [solver] wishes that no code honours
void check_elements(const Model& model);  ///< element_groups.cpp: InputError for an element that is inverted or flat
void build_elements(Model& model);        ///< element_groups.cpp: blocks, hourglass scales, lengths, masses
void build_node_arrays(Model& model);     ///< node_arrays.cpp: state, gather lists, constraints
void build_carried_nodes(Model& model);   ///< carriers.cpp: nodes in single precision
void build_beams(Model& model);           ///< beams.cpp: sections, masses, rotations
void build_loads(Model& model);           ///< loads.cpp: loads, connectors, node sets, extra forces
void build_prescribed_motions(Model& model);     ///< prescribed_motion.cpp
void build_ties(Model& model);                   ///< ties.cpp: places of slave nodes on their masters' faces
void build_non_reflecting(Model& model);         ///< non_reflecting.cpp: dashpots of the ends
void build_element_histories(Model& model);      ///< element_histories.cpp: elements whose stress or strain is written
void build_contacts(Model& model);               ///< contact_pairs.cpp
void refuse_contradictions(const Model& model);  ///< contradictions.cpp: InputError for entries that cannot all hold
void resolve_rolling(Model& model);              ///< rolling.cpp: angular velocities of initial motions that roll
void build_stable_step(Model& model);            ///< stable_step.cpp
void build_subcycling(Model& model);             ///< subcycling.cpp: paces of nodes; whole rounds of steps
std::vector<std::string> what_is_left_out(const scene::Scene& scene);  ///< left_out.cpp

}  // namespace railwave
