#pragma once

#include "solve/stages.hpp"

namespace railwave {

/// Contact forces of a pair by Lagrange multipliers (kernels/contact_multiplier.hpp). Comes after the elements' stages and all
/// other forces: it foresees where these take the nodes.
Stage multiplier_stage(Model& model, ContactPair& pair);

}  // namespace railwave
