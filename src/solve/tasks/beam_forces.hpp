#pragma once

#include <functional>

#include "kernels/beams/beam_rotation.hpp"
#include "kernels/support/reductions.hpp"
#include "model/beams/beams.hpp"
#include "solve/observer.hpp"
#include "solve/tasks.hpp"

/// What a scene's beams add to a step, to settling and to the account. Only for models that have beams.
namespace railwave {

/// The rotations' step, at the same time as the nodes'.
void advance_rotations(const Model& model, double step);

/// Adds elastic and kinetic energy, and the work of moments, when the sums are fetched.
void queue_beam_energies(const Model& model, double step, EnergyAccount& energy, Reductions& sums);

/// One entry for each of the scene's beams.
std::vector<BeamResultants> beam_resultants(const Model& model);

/// Dynamic relaxation of the rotations, in step with that of the nodes.
void relax_rotations(const Model& model, double damping);
void stop_rotations(const Model& model);
struct BeamRelaxationState {
  double energy = 0;      ///< twice the kinetic one
  double unbalanced = 0;  ///< N, moments on the arm of an element
  double applied = 0;     ///< N
};
BeamRelaxationState relaxation_state(const Model& model);

/// Gives the nodes inside beams what lies between their ends' values.
/// @param value value(n): that of a node of the model, to be read at ends and written inside
void interpolate_inside_beams(const Model& model, const std::function<Vec3&(int)>& value);

}  // namespace railwave
