#pragma once

#include "kernels/boundaries/prescribed_motion.hpp"
#include "model/model.hpp"

namespace railwave {

/// Where a prescribed motion has its set at a time: moved by the velocity's, turned by the angular velocity's integral
/// over time, both times its curve; moved by its displacement besides.
RigidPlace place_at(const PrescribedSet& set, double time);

/// The kernel that moves a set from the present instant by a step; and, with a step of 0, what its account needs.
PrescribedMotion prescribed_motion(const Model& model, const PrescribedSet& set, double step);

}  // namespace railwave
