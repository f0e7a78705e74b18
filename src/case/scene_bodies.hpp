#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "case/scene_meshes.hpp"

/// What moves: materials, parts made of a mesh and a material, point masses. Keys: keys_bodies.cpp.
namespace railwave::scene {

struct Material : Place {
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;
  double density = 0;                  ///< kg/m3
  std::optional<double> yield_stress;  ///< Pa, von Mises; absent: elastic
  double tangent_modulus = 0;          ///< Pa, slope of stress over strain beyond yield, uniaxial stress
  double hardening_beta = 1;           ///< share of the hardening that is isotropic; the rest moves the yield surface
  double isotropic_saturation = 0;     ///< Pa, by how much the flow stress grows in the end
  double isotropic_rate = 0;           ///< of that over plastic strain
  double back_stress_modulus = 0;      ///< Pa, by which the yield surface begins to move
  double back_stress_recall = 0;       ///< share of the back stress that fades over plastic strain

  /// lambda + 2 mu, Pa
  double dilatational_modulus() const {
    return youngs_modulus * (1 - poissons_ratio) / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
  /// C_d of thesis eq. 2.14b, m/s
  double dilatational_speed() const { return std::sqrt(dilatational_modulus() / density); }
  /// C_s, m/s
  double shear_speed() const { return std::sqrt(shear_modulus() / density); }
};

enum class HourglassType { viscous, stiffness };

struct Part : Place {
  std::string mesh;
  std::string material;
  std::string element_set;                             ///< empty: the whole mesh
  Vec3 position{0, 0, 0};                              ///< translation of the mesh, m
  bool mirror = false;                                 ///< y of the mesh is turned round
  double angle_of_attack = 0;                          ///< rad, about z through the mesh's origin, after mirroring
  HourglassType hourglass = HourglassType::stiffness;  ///< chosen by scripts/hourglass_table: docs/hourglass.md
  double hourglass_coefficient = 0.05;

  /// With the coefficient that goes with a type unless one is given.
  void take_hourglass(HourglassType type) {
    hourglass = type;
    hourglass_coefficient = type == HourglassType::stiffness ? 0.05 : 0.1;
  }
  double mass_damping = 0;           ///< 1/s: force on a node is that times its mass and velocity, against the velocity
  double stiffness_damping = 0;      ///< s: viscous stress is that times what elasticity makes of the strain's rate
  double linear_bulk_viscosity = 0;  ///< of volumes that shrink, over rho c l times the rate
  double quadratic_bulk_viscosity = 0;  ///< the same over rho l^2 times its square

  bool damped() const {
    return mass_damping > 0 || stiffness_damping > 0 || linear_bulk_viscosity > 0 || quadratic_bulk_viscosity > 0;
  }
};

struct PointMass : Place {
  double mass = 0;  ///< kg; 0 only where beams end, which give it mass
  Vec3 position{0, 0, 0};
};

}  // namespace railwave::scene
