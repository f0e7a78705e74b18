#pragma once

#include "kernels/statics/tangent.hpp"
#include "model/elements/hourglass_scale.hpp"

namespace railwave {

/// Of a part's elements while nothing moves: linear elastic, with the stiffness hourglass control that they have while
/// settling.
inline ElementStiffness settling_stiffness(const scene::Part& part, const scene::Material& material) {
  const double mu = material.shear_modulus();
  const double factor =
      hourglass_factor(scene::HourglassType::stiffness, settling_hourglass_coefficient(part), material);
  return {material.dilatational_modulus() - 2 * mu, mu, factor, false, 0};
}

}  // namespace railwave
