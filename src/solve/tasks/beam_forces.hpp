#pragma once

#include <functional>

#include "kernels/beams/beam_rotation.hpp"
#include "model/beams/beams.hpp"
#include "model/sample_sums.hpp"
#include "solve/observer.hpp"
#include "solve/tasks.hpp"

/// What a scene's beams add to a step, to settling and to the account.
namespace railwave {

/// Adds elastic and kinetic energy, and the work of moments, when the sums are fetched.
void queue_beam_energies(const NodalState& nodal, const BeamArrays& beams, double step, EnergyAccount& energy,
                         SampleSums& sums);

/// One entry for each of the scene's beams, when the sums are fetched; or at once.
void queue_beam_resultants(const BeamModel& built, const NodeArrays& nodes, std::vector<BeamResultants>& all,
                           Reductions& sums);
std::vector<BeamResultants> beam_resultants(const BeamModel& built, const NodeArrays& nodes);

/// Dynamic relaxation of the rotations, in step with that of the nodes.
void relax_rotations(const BeamModel& built, double damping);
void stop_rotations(const BeamModel& built);
struct BeamRelaxationState {
  double energy = 0;      ///< twice the kinetic one
  double unbalanced = 0;  ///< N, moments on the arm of an element
  double applied = 0;     ///< N
};
BeamRelaxationState relaxation_state(const BeamModel& built, ReductionSpace& space);

/// Gives the nodes inside beams what lies between their ends' values.
/// @param value value(n): that of a node of the model, to be read at ends and written inside
void interpolate_inside_beams(const Assembly& assembly, const std::function<Vec3&(int)>& value);

}  // namespace railwave
