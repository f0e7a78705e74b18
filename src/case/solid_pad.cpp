#include "case/solid_pad.hpp"

#include <algorithm>
#include <cmath>

namespace railwave::case_file {
namespace {

/// Moduli of a material of Young's modulus 1.
scene::Material unit_material(double poissons_ratio) {
  scene::Material material;
  material.youngs_modulus = 1;
  material.poissons_ratio = poissons_ratio;
  return material;
}

}  // namespace

double BondedLayer::vertical_stiffness(double poissons_ratio) const {
  const scene::Material material = unit_material(poissons_ratio);
  const double whole = material.dilatational_modulus(), shear = material.shear_modulus(), sideways = whole - 2 * shear;
  const double s = std::sqrt(12 * shear / whole) / thickness;
  const auto held = [&](double side) { return 1 - std::tanh(0.5 * s * side) / (0.5 * s * side); };
  return length * width / thickness * (whole - sideways * sideways / whole * (1 - held(length) * held(width)));
}

double BondedLayer::shear_stiffness(double poissons_ratio) const {
  return length * width / thickness * unit_material(poissons_ratio).shear_modulus();
}

SolidPad solid_pad(const scene::Sleeper& kind, const std::string& section) {
  const BondedLayer layer{*kind.pad_length, foot_width(section), *kind.pad_thickness};
  const scene::Vec3 &stiffness = *kind.fastening_stiffness, &dashpots = *kind.fastening_damping;
  if (kind.pad_modulus) return {*kind.pad_modulus, *kind.pad_damping, stiffness, dashpots};
  SolidPad pad{stiffness[2] / layer.vertical_stiffness(kind.pad_poissons_ratio),
               kind.pad_damping.value_or(dashpots[2] / stiffness[2]),
               {},
               {}};
  const double shear = pad.modulus * layer.shear_stiffness(kind.pad_poissons_ratio);
  const scene::Vec3 own{shear, shear, stiffness[2]};
  for (int i = 0; i < 3; ++i) {
    pad.stiffness[i] = std::max(0.0, stiffness[i] - own[i]);
    // Rounding must not leave a connector that does nothing.
    const double left = dashpots[i] - pad.damping * own[i];
    pad.dashpots[i] = left > 1e-9 * dashpots[i] ? left : 0;
  }
  return pad;
}

double foot_width(const std::string& section) { return section == "60E1" ? 0.1488 : 0.1388; }

}  // namespace railwave::case_file
