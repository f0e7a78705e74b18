#pragma once

#include <string>
#include <vector>

#include "kernels/boundaries/non_reflecting.hpp"
#include "model/assembled_scene.hpp"

namespace railwave {

/// All non-reflecting ends together: dashpots on the nodes of surfaces through which plane waves leave.
struct NonReflectingEnds {
  NonReflectingArrays arrays;
  std::vector<int> nodes;   ///< ascending
  std::vector<char> alone;  ///< by node of the model: feels no other external forces; may have a level of its own
};

/// Begins the run: forces on the ends' nodes take the place of what held them.
/// @param position   m, of the model's nodes
/// @param unbalanced N by node; empty where the scene has not settled
void hold_ends(const NonReflectingEnds& ends, const Array<double* [3]>& position, const Array<double* [3]>& unbalanced);

/// Zones at the ends of parts whose mass-proportional damping grows towards the end: see absorbing_layers.
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

/// Where a scene's absorbing layers lie, and the rate alpha (1/s) by which they damp each node, a force - alpha m v:
///   alpha(d) = alpha_end (1 - d/L)^3,  d the distance from the end's plane, up to the layer's length L.
/// Mass-proportional damping takes from waves of all kinds alpha/2 of their amplitude in a second, wherever they go at
/// their group velocity c. There and back a layer leaves exp(-alpha_end L / (4 c)), so that alpha_end = 4 C_d
/// ln(1/reflection) / L leaves `reflection` of the fastest waves, and less of slower ones. What the growth of alpha
/// itself sends back depends on the layer's length over the wavelength (docs/verification.md). Throws InputError for an
/// end that is no plane, a layer that holds no nodes but the end's own, and a part that layers fill.
AbsorbingLayers absorbing_layers(const scene::Scene& scene, const Assembly& assembly);

/// A line for each layer: nodes, damping at the end, and the waves that it takes.
std::vector<std::string> describe_absorbing_layers(const AssembledScene& assembled, const AbsorbingLayers& absorbing);

/// A line for each non-reflecting end of a slender part without an absorbing layer: such an end absorbs plane waves of
/// the continuum, but reflects part of a bar's waves.
std::vector<std::string> describe_slender_ends(const AssembledScene& assembled, const AbsorbingLayers& absorbing);

/// Warnings about layers that are few elements deep, and about layers in parts with an initial motion.
std::vector<std::string> absorbing_doubts(const AssembledScene& assembled, const AbsorbingLayers& absorbing);

}  // namespace railwave
