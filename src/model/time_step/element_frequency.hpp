#pragma once

#include "case/scene.hpp"
#include "mesh/hexahedron.hpp"

namespace railwave {

/// Stable steps of one free element.
struct ElementStep {
  double step = 0;     ///< s, of everything
  double control = 0;  ///< s, of the hourglass control alone; infinite where there is none
};
/// Largest stable step of one free element, and so of any mesh of such elements: the highest frequency of a mesh is at
/// most that of its elements alone (Flanagan & Belytschko 1981 on stability; Irons' theorem). The central difference
/// with velocities half a step behind is stable while
///   dt^2/4 K + dt/2 C <= M   (in the sense of quadratic forms),
/// K: mean-gradient stiffness and stiffness hourglass control, C: viscous hourglass control, M: row-summed masses,
/// which differ from corner to corner.
/// @param x corners, m
ElementStep element_eigenvalue_step(const HexahedronCorners& x, const scene::Material& material,
                                    scene::HourglassType hourglass, double hourglass_coefficient);

}  // namespace railwave
