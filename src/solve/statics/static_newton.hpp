#pragma once

#include "solve/statics/settle.hpp"

namespace railwave {

/// Static equilibrium under the loads of t = 0 by Newton's method without a matrix: residuals are the forces that the
/// run computes (with the hourglass control of settling), steps come from conjugate gradients on the stiffness of the
/// present place, preconditioned by nodal blocks and rigid motions of aggregates, and are shortened until the forces
/// along them have come down: then contact may close on the way. Multipliers of contact are found by augmented
/// Lagrange. Throws InputError for a point mass that nothing holds against the force on it.
SettleReport settle_by_newton(Model& model, const std::function<bool(const SettleReport&)>& go_on);

}  // namespace railwave
