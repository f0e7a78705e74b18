#pragma once

#include "model/model.hpp"

/// The host's side of nodes in single precision (kernels/nodes/carrier.hpp says how they are told).
namespace railwave {

/// Takes the nodes over as they stand in double precision. Whoever writes to those later calls this again.
void take_nodes_over(Model& model);

/// Has the carriers' values at hand on the device for the step from the present instant to the next, of size `step`
/// (s).
void lay_carrier_steps(Model& model, double step);

/// Brings the nodes in double precision to the present instant.
void give_nodes_back(const Model& model);

/// What moves a group's nodes over a step of size `step` (s).
CarriedAdvance carried_advance(const Model& model, const CarriedBlocks& blocks, double step);

}  // namespace railwave
