#pragma once

#include <vector>

#include "kernels/ties/tie.hpp"
#include "model/assembled_scene.hpp"

namespace railwave {

struct Model;

/// All ties together.
struct Ties {
  TieArrays arrays;
  std::vector<TiedPlace> places;  ///< host copy
  std::vector<int> masters;       ///< ascending
  Array<int*> carrier;            ///< by slave, where nodes are in single precision
};

/// Masses by node, in kg of a run or of a relaxation, as the scheme uses them: those of slaves go to their masters by
/// the weights of forces. In motions that ties allow, these masses have no less kinetic energy than the true ones have
/// where they are (Jensen's inequality), so that ties never raise the highest frequency. Slaves keep a trace, as no
/// mass may be zero.
std::vector<double> masses_with_ties(const Model& model, std::vector<double> mass);

}  // namespace railwave
