#include "model/beams/beam_section.hpp"

#include <algorithm>
#include <cmath>

namespace railwave {

BeamSectionValues section_values(const scene::Beam& beam, const scene::Material& material) {
  const double nu = material.poissons_ratio;
  BeamSectionValues values;
  if (beam.section == scene::BeamSection::circle) {
    const double squared = beam.radius * beam.radius;
    values.area = M_PI * squared;
    values.second = values.third = M_PI / 4 * squared * squared;
    values.torsion = M_PI / 2 * squared * squared;
    values.shear = 6 * (1 + nu) / (7 + 6 * nu);
    return values;
  }
  const double b = beam.width, h = beam.height;
  values.area = b * h;
  values.second = b * h * h * h / 12;
  values.third = h * b * b * b / 12;
  values.shear = 10 * (1 + nu) / (12 + 11 * nu);
  // Roark's formula of the rectangle: within 4 parts in a thousand of Saint-Venant's series.
  const double longer = std::max(b, h), ratio = std::min(b, h) / longer;
  values.torsion =
      std::pow(longer, 4) * ratio * ratio * ratio * (1.0 / 3 - 0.21 * ratio * (1 - std::pow(ratio, 4) / 12));
  return values;
}

BeamElementValues element_values(const BeamSectionValues& section, const scene::Material& material, double length) {
  const double E = material.youngs_modulus, G = material.shear_modulus(), L = length;
  BeamElementValues values;
  const auto shear = [&](double I) { return 1 / (1 / (section.shear * G * section.area) + L * L / (12 * E * I)); };
  values.stiffness = {E * section.area, shear(section.third), shear(section.second)};
  values.bending = {G * section.torsion, E * section.second, E * section.third};
  const double mass = values.end_mass = 0.5 * material.density * section.area * L;
  const double natural = 0.5 * material.density * (section.second + section.third) * L;

  // Squared frequencies of the free element: 2 E A / (L m) along it, 2 B / (L J) of twist and bending, and of shear
  // S (2 / (L m) + L / (2 J)). J is such that the first is the highest.
  const double axial = 2 * values.stiffness[0] / (L * mass);
  double inertia = natural;
  for (double B : values.bending) inertia = std::max(inertia, 2 * B / (L * axial));
  for (int k : {1, 2}) {
    const double S = values.stiffness[k];
    const double left = std::max(axial - 2 * S / (L * mass), 0.1 * axial);
    inertia = std::max(inertia, 0.5 * S * L / left);
  }
  values.end_inertia = inertia;
  values.inertia_scale = inertia / natural;
  double highest = axial;
  for (int k : {1, 2}) highest = std::max(highest, values.stiffness[k] * (2 / (L * mass) + L / (2 * inertia)));
  values.step = 2 / std::sqrt(highest);
  return values;
}

}  // namespace railwave
