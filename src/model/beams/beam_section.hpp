#pragma once

#include "case/scene.hpp"

namespace railwave {

/// What a section and a material make of a beam; axis 2 is across, axis 3 along the section's height.
struct BeamSectionValues {
  double area = 0;     ///< m2
  double second = 0;   ///< m4, second moment of area about axis 2
  double third = 0;    ///< m4, about axis 3
  double torsion = 0;  ///< m4, torsion constant
  double shear = 0;    ///< share of the area that shears (Cowper 1966)
};

BeamSectionValues section_values(const scene::Beam& beam, const scene::Material& material);

/// An element of a beam, and half of its mass and inertia at each end.
struct BeamElementValues {
  std::array<double, 3> stiffness{};  ///< N: E A; shear S_k with 1/S = 1/(shear G A) + L^2/(12 E I), MacNeal 1978
  std::array<double, 3> bending{};    ///< N m2: G times torsion constant, E I_2, E I_3
  double end_mass = 0;                ///< kg
  double end_inertia = 0;  ///< kg m2: the section's polar one, or more so that the element's highest frequency is axial
  double inertia_scale = 1;  ///< how much more
  double step = 0;           ///< s, stable step of the element alone: L / sqrt(E/rho) (thesis 3.3.3)
};

BeamElementValues element_values(const BeamSectionValues& section, const scene::Material& material, double length);

}  // namespace railwave
