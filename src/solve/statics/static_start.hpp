#pragma once

#include "solve/statics/settle.hpp"
#include "solve/statics/static_state.hpp"

namespace railwave {

/// Settles a scene, or takes its settled state from where an earlier run has kept it; goes on from one that was
/// interrupted. The state is kept in any case.
/// @param states null: nothing is kept
SettleReport come_to_rest(Model& model, SettledStates* states, const std::function<bool(const SettleReport&)>& go_on);

}  // namespace railwave
