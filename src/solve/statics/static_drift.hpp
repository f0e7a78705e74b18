#pragma once

#include <string>

#include "kernels/statics/tangent.hpp"
#include "model/model.hpp"

/// What nothing holds while a scene settles by Newton's method.
namespace railwave {

/// A point mass has no shape to lean on: springs and constraints must hold it against its load.
/// @param unbalanced N by node
/// @param applied N, sum of applied and contact forces
/// Throws InputError naming the point, the force and its direction.
void refuse_drifting_points(const Model& model, const NodeVector& unbalanced, double applied);

/// The part or beam on which the largest force is left, if that is more than rounding leaves of deformation; else
/// empty.
std::string what_drifts(const Model& model, const NodeVector& unbalanced, double applied);

}  // namespace railwave
