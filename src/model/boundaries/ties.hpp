#pragma once

#include <vector>

#include "model/model.hpp"

namespace railwave {

/// Masses by node, in kg of a run or of a relaxation, as the scheme uses them: those of slaves go to their masters by
/// the weights of forces. In motions that ties allow, these masses have no less kinetic energy than the true ones have
/// where they are (Jensen's inequality), so that ties never raise the highest frequency. Slaves keep a trace, as no
/// mass may be zero.
std::vector<double> masses_with_ties(const Model& model, std::vector<double> mass);

}  // namespace railwave
