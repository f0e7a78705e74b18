#pragma once

#include <memory>
#include <vector>

#include "model/assembly.hpp"
#include "model/beams/beams.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/elements/element_model.hpp"
#include "model/loads/load_model.hpp"
#include "model/nodal_state.hpp"
#include "model/sample_sums.hpp"
#include "solve/observer.hpp"

/// What each module gives to the account and the histories at the present instant: all of it is added when the sums are
/// fetched.
namespace railwave {

/// Sums elastic energy and plastic work of the process's blocks, what their hourglass control stores or dissipates, and
/// what their damping has dissipated.
/// @param order in which its launches come
void sum_block_energies(const ElementModel& model, const NodeArrays& nodes, const ExecutionSpace& order);

/// The same of all elements, from the sums of all blocks.
/// @param by_part whether share_out_energies() follows
void queue_element_energies(const ElementModel& model, EnergyAccount& energy, bool by_part, SampleSums& sums);

/// Shares out the groups' energies, fetched, among the parts of the assembly.
void share_out_energies(const Assembly& assembly, const std::vector<ElementGroup>& groups,
                        std::vector<PartEnergy>& by_part);  // element_energies.cpp

void queue_contact_energies(const std::vector<ContactPair>& contacts, EnergyAccount& energy, SampleSums& sums);

/// Forces of a pair and its nodes in contact; of a symmetric contact, those of one of its halves.
void queue_pair_totals(const NodalState& nodal, const ContactPair& pair, ContactTotals& totals, SampleSums& sums);

/// Adds the other half of a symmetric contact, which has the surfaces exchanged.
void add_other_half(ContactTotals& totals, const ContactTotals& other);  // contact_energies.cpp

/// What each of the scene's loads comes to at the present instant, into `totals` when the sums are fetched.
void queue_load_totals(const NodalState& nodal, const LoadModel& loads, const std::shared_ptr<BeamModel>& beams,
                       std::vector<LoadTotals>& totals, SampleSums& sums);  // load_totals.cpp

/// The same of prescribed motions.
void queue_reactions(const NodalState& nodal, std::vector<ReactionTotals>& totals,
                     SampleSums& sums);  // load_totals.cpp

}  // namespace railwave
