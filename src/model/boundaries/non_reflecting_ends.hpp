#pragma once

#include "model/model.hpp"

namespace railwave {

/// Begins the run: forces on the ends' nodes take the place of what held them.
/// @param unbalanced N by node; empty where the scene has not settled
void hold_ends(Model& model, const Array<double* [3]>& unbalanced);

}  // namespace railwave
