#pragma once

#include "solve/stages.hpp"

namespace railwave {

/// Damping forces of a damped group's elements at an instant, to their rows of `model.partial`.
void element_damping(const Model& model, const ElementGroup& group, const Instant& instant);

}  // namespace railwave
