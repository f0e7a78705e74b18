#pragma once

#include "model/assembly.hpp"

namespace railwave {

/// Throws InputError when the arrays of a model of these parts can't fit where the steps are computed, on the host or a
/// GPU.
void expect_model_room(const Assembly& assembly);

}  // namespace railwave
