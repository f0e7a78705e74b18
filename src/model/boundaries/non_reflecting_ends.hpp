#pragma once

#include "kernels/boundaries/non_reflecting.hpp"
#include "model/nodal_state.hpp"

namespace railwave {

struct Model;

/// All non-reflecting ends together.
struct NonReflectingEnds {
  NonReflectingArrays arrays;
  std::vector<int> nodes;   ///< ascending
  std::vector<char> alone;  ///< by node of the model: feels no other extra forces; may have a pace of its own
};

/// Begins the run: forces on the ends' nodes take the place of what held them.
/// @param unbalanced N by node; empty where the scene has not settled
void hold_ends(Model& model, const Array<double* [3]>& unbalanced);

}  // namespace railwave
