#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/assembled_scene.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/ties.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/elements/element_model.hpp"
#include "model/loads/load_model.hpp"
#include "model/nodal_state.hpp"
#include "model/time_step/step_sizes.hpp"

namespace railwave {

struct BeamModel;
class Transport;

/// A scene ready to be computed: its modules, each with its arrays on the device and the host data that describe them.
/// What works with one module takes that alone; its header says what a module is.
struct Model : AssembledScene, NodalState, StepSizes, ElementModel, LoadModel {
  std::shared_ptr<BeamModel> beams;  ///< null in a scene without beams
  NonReflectingEnds ends;
  AbsorbingLayers absorbing;
  Ties ties;
  std::vector<ContactPair> contacts;  ///< of the scene's contacts in order, then the reversed ones
  std::vector<std::string> left_out;  ///< what the scene does not need and the run will not compute
  bool whole_mesh = true;             ///< false: a rank has let go of nodes and elements, see mesh_share.hpp
  std::vector<int> shown_nodes;       ///< on ranks: of the sets whose fields are written, ascending
};

/// Builds the device arrays of a scene. Throws InputError for what only the mesh can show: unknown sets, inverted
/// elements, contact surfaces that share nodes, a part without mass.
/// A Model refers to itself; it is not to be copied or moved.
void build_model(const scene::Scene& scene, Model& model);

/// The same from an assembly made elsewhere, one part of it for each of the scene's.
/// @param transport of ranks that make the model together, each with the arrays of its own blocks; null: this process
/// is alone. Throws std::runtime_error too where another rank could not make it
void build_model(const scene::Scene& scene, Assembly assembly, Model& model, Transport* transport = nullptr);

/// From now on all blocks and nodes have the constant arrays that one process has, where a rank's model had those of
/// its own alone.
void fill_rest(Model& model);

/// Bytes of all device arrays.
std::size_t device_bytes(const Model& model);

/// Puts nodes and history variables back to the undeformed start, at rest.
void reset_to_start(Model& model);

}  // namespace railwave
