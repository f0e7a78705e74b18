#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"
#include "mesh/hexahedron.hpp"
#include "model/assembled_scene.hpp"
#include "model/beams/beams.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/loads/connector_cells.hpp"
#include "model/time_step/step_sizes.hpp"

namespace railwave {

/// What sets the step, for messages: "the elements of part wheel, near (0, 0, 0) m", "connectors", "contact springs",
/// "beams".
std::string what_sets_step(const AssembledScene& assembled, const StableStep& stable);

/// The longest step that the case allows now, s: `time.step`, else `time.step_scale` of the stable step; never quite
/// that step itself.
double largest_step(const scene::Time& time, const StableStep& stable);

/// Each element's own stable step by the estimate that the case chose, s; not for the global one.
std::vector<double> own_steps(const AssembledScene& assembled, const AbsorbingLayers& absorbing);

/// The same by its highest eigenvalue: whatever its neighbours are, free surfaces too, it is stable with that.
std::vector<double> safe_steps(const AssembledScene& assembled, const AbsorbingLayers& absorbing);

/// With subcycling, the margin of the step of a level's elements to their stable one, over time.step_scale. Measured on
/// chains: without it, and without the buffers between levels, waves of a fine region that a coarse one's impulses meet
/// at every half period grow.
inline constexpr double margin_of_levels = 1.1;

/// Speed of the fastest initial motion, turning left out, m/s: what bodies that hit at the beginning hit with.
double largest_initial_speed(const scene::Scene& scene);

/// Whether bodies begin apart, not settled on one another, and neither their hourglass control nor their contact takes
/// what they vibrate with.
bool strikes_undamped(const scene::Scene& scene, const std::vector<ContactPair>& contacts);

/// Estimates the whole scene's stable step anew at the present instant. The case must have asked for the global
/// estimate.
/// @param time s, the present instant
void renew_global_step(const scene::Scene& scene, const std::vector<ContactPair>& contacts, double time,
                       StepSizes& sizes);

/// Lines that tell what each estimate allows, which one sets the step, and what that gains.
std::vector<std::string> describe_stable_step(const AssembledScene& assembled, const StableStep& stable,
                                              const std::shared_ptr<BeamModel>& beams);

/// 2/step of the connectors alone, 1/s: the stable step of springs and dashpots on their ends' masses.
/// @param mass kg, by node
double connector_frequency(const scene::Scene& scene, const std::vector<ConnectorCell>& cells,
                           const std::vector<double>& mass);

/// Stable steps of one free element.
struct ElementStep {
  double step = 0;     ///< s, of everything
  double control = 0;  ///< s, of the hourglass control alone; infinite where there is none
};
/// Largest stable step of one free element, and so of any mesh of such elements: the highest frequency of a mesh is at
/// most that of its elements alone (Flanagan and Belytschko 1981 on stability; Irons' theorem). The central difference
/// with velocities half a step behind is stable while
///   dt^2/4 K + dt/2 C <= M   (in the sense of quadratic forms),
/// K: mean-gradient stiffness and stiffness hourglass control, C: viscous hourglass control, M: row-summed masses,
/// which differ from corner to corner.
/// @param x corners, m
ElementStep element_eigenvalue_step(const HexahedronCorners& x, const scene::Material& material,
                                    scene::HourglassType hourglass, double hourglass_coefficient);

}  // namespace railwave
