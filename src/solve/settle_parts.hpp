#pragma once

#include "solve/settle.hpp"
#include "solve/stages.hpp"

/// What the ways to a static equilibrium share.
namespace railwave {

/// m/s2 by node: - omega x (omega x (X - c)) on the bodies that will rotate.
std::vector<Vec3> centrifugal_field(const Model& model);

/// The stages of an instant without those of ties, ends and multipliers.
std::vector<Stage> force_stages_without_multipliers(Model& model);

/// Forces on the slaves' nodes go to their masters: after all others on them.
Stage tie_stage(Model& model);

}  // namespace railwave
