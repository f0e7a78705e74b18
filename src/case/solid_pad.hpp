#pragma once

#include <string>

#include "case/scene.hpp"

namespace railwave::case_file {

/// An elastic layer between two rigid faces that it sticks to, m.
struct BondedLayer {
  double length, width, thickness;

  /// N/m across the layer for a Young's modulus of 1 Pa. Where the faces keep it from widening the layer has the
  /// modulus M = lambda + 2 G; towards its free sides it widens, by a displacement u parabolic through the thickness t.
  /// Balance along x,
  ///   M u'' = 12 G / t^2 u, with M u' = lambda e at a free side (e: the compression),
  /// makes of a strip of width 2 a the modulus M - lambda^2 / M tanh(s a) / (s a), s = sqrt(12 G / M) / t. Two pairs of
  /// free sides count as 1 - (1 - tanh(s a) / (s a)) (1 - tanh(s b) / (s b)).
  double vertical_stiffness(double poissons_ratio) const;
  /// N/m along the layer for a Young's modulus of 1 Pa: G times area over thickness.
  double shear_stiffness(double poissons_ratio) const;
};

/// What a fastening with a solid pad is made of: the pad, and springs and dashpots beside it.
struct SolidPad {
  double modulus, damping;          ///< Pa; s, stiffness damping
  scene::Vec3 stiffness, dashpots;  ///< N/m, N s/m
  bool springs() const { return stiffness != scene::Vec3{0, 0, 0} || dashpots != scene::Vec3{0, 0, 0}; }
};

/// The pad of a kind of sleeper, with everything said, under a rail of that section. Without a modulus of its own it is
/// as stiff vertically as the fastening, and what its shear, and its damping, lack of the fastening's stays with the
/// springs and dashpots; with one, these are just as the kind has them.
SolidPad solid_pad(const scene::Sleeper& kind, const std::string& section);

/// m, across the underside of a rail's foot, between the middles of its edges' roundings.
double foot_width(const std::string& section);

}  // namespace railwave::case_file
