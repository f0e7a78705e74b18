#pragma once

#include "solve/plan.hpp"

namespace railwave {

/// Damping forces of a damped group's elements at an instant, to their rows of `model.partial`.
void element_damping(const Model& model, const ElementGroup& group, const Instant& instant);

/// Of a group that is not evaluated at every step, one step after its evaluation: see BookDamping.
void book_damping(const Model& model, const ElementGroup& group, double elapsed);

}  // namespace railwave
