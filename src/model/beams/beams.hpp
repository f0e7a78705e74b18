#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernels/beams/beam.hpp"
#include "kernels/nodes/nodes.hpp"
#include "model/assembled_scene.hpp"
#include "model/loads/load_model.hpp"

namespace railwave {

/// The beams of a scene on the device, and what the host must know of them.
struct BeamModel {
  BeamArrays arrays;
  Array<double*> relaxation_inertia;  ///< kg m2 by beam node, see BeamRelaxation
  Array<double*> arm;                 ///< m by beam node: the mean length of elements there
  std::vector<double>
      relaxation_mass;             ///< kg by node of the model, of the beams alone; a unit of pseudo-time is stable
  std::vector<int> number;         ///< beam node by node of the model, -1: no beam ends there
  std::vector<int> first_of_beam;  ///< by scene.beams and one more: first element
  std::vector<const LoadArrays*> moments;  ///< from outside, in the arrays' order
  double step = 0;                         ///< s, the smallest element's own
  double inertia_scale = 1;                ///< largest factor on a section's rotary inertia
  int scaled = 0;                          ///< elements with such a factor above 1.001

  int elements_of(int beam) const { return first_of_beam[beam + 1] - first_of_beam[beam]; }
};

/// Puts the chains of the scene's beams into the assembly, with nodes of their own inside. Throws InputError for ends
/// that coincide, an orientation along the beam, more beams than a set has nodes.
void lay_beams(const scene::Scene& scene, Assembly& assembly);

/// Unit vectors along a beam, across, and along its section's height.
std::array<Vec3, 3> beam_axes(const scene::Scene& scene, const scene::Beam& beam, const Vec3& from, const Vec3& to);

/// Number among the beam nodes of the single node of a set; -1: the set has several, or no beam ends there.
/// @param beams null in a scene without beams, here and below
int beam_node_of(const std::shared_ptr<BeamModel>& beams, const std::vector<int>& nodes);

/// Builds the arrays of torques on beam nodes, in the order of the loads. LoadArrays::beam_node must be set.
void add_moments(const scene::Scene& scene, const std::vector<LoadArrays>& loads, BeamModel& built);

/// Sets rotations and stretches to their values at the start. All other state of beams starts at zero.
void reset_beams(const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes);

/// Sets the stretch without axial force such that the elements have their pretension where they lie now.
/// @param all false: only of the elements that held them while the scene settled
void tighten_beams(const std::shared_ptr<BeamModel>& beams, const NodeArrays& nodes, bool all);

/// A line on the beams' rotary inertia, where it had to be scaled; none otherwise.
std::string describe_beam_inertia(const std::shared_ptr<BeamModel>& beams);

}  // namespace railwave
