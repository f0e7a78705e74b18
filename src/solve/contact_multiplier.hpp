#pragma once

#include "solve/stages.hpp"

namespace railwave {

/// Contact forces by Lagrange multipliers (kernels/contact_multiplier.hpp), of all pairs that have them at once: they
/// may meet in a node. Comes after the elements' stages and all other forces: it foresees where these take the nodes.
Stage multiplier_stage(Model& model);

}  // namespace railwave
