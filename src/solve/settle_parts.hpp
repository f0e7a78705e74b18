#pragma once

#include "solve/settle.hpp"
#include "solve/tasks.hpp"

/// What the ways to a static equilibrium share.
namespace railwave {

/// m/s2 by node: - omega x (omega x (X - c)) on the bodies that will rotate.
std::vector<Vec3> centrifugal_field(const Model& model);

/// Forces of an instant of Newton's method, in which pairs with multipliers press as `press` has them.
std::vector<Task> newton_tasks(Model& model, std::function<void()> press);

}  // namespace railwave
