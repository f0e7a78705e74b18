#pragma once

#include <cmath>

#include "case/scene.hpp"

namespace railwave {

/// What a part's hourglass coefficient and material make of the control's scale, all but the element's volume V:
/// viscous c = factor V^(2/3), kg/s, factor = Q_hg/4 rho C_d; stiffness k = factor V^(1/3), N/m, factor = kappa (lambda
/// + 2 mu)/16.
inline double hourglass_factor(scene::HourglassType type, double coefficient, const scene::Material& material) {
  return type == scene::HourglassType::viscous ? 0.25 * coefficient * material.density * material.dilatational_speed()
                                               : coefficient * material.dilatational_modulus() / 16;
}

/// Coefficient of the stiffness hourglass control that a part has while it settles; of one whose own control is
/// viscous, the default's:
inline constexpr double settling_coefficient = 0.05;
inline double settling_hourglass_coefficient(const scene::Part& part) {
  return part.hourglass == scene::HourglassType::viscous ? settling_coefficient : part.hourglass_coefficient;
}

inline double hourglass_scale(scene::HourglassType type, double coefficient, const scene::Material& material,
                              double volume) {
  const double root = std::cbrt(volume);
  return hourglass_factor(type, coefficient, material) * (type == scene::HourglassType::viscous ? root * root : root);
}

}  // namespace railwave
