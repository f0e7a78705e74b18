#pragma once

#include "kernels/elements/element_modes.hpp"

/// Orthogonal hourglass control of Flanagan and Belytschko 1981 (thesis 2.5, eqs. 2.22; 2.22b prints velocities where
/// the coordinates x belong). The hourglass shape vectors gamma_M^N = Gamma_M^N - (1/V) B_j^N (sum_K x_j^K Gamma_M^K)
/// are taken in the present configuration, so the forces have no resultant, no moment, and do nothing under linear
/// velocity fields. A nodal field's hourglass content along gamma_M is its hourglass mode less what its mean gradient
/// makes of the coordinates': u_M - L_j x_jM.
namespace railwave {

template <class T>
KOKKOS_FORCEINLINE_FUNCTION T hourglass_content(const T (&u)[7], const T (&gradient)[3], const T (&x)[3][7], int M) {
  return u[3 + M] - (gradient[0] * x[0][3 + M] + gradient[1] * x[1][3 + M] + gradient[2] * x[2][3 + M]);
}

/// Viscous control: force along gamma_M of q = c times the velocity's content,
/// c = Q_hg/4 rho C_d V^(2/3) (kg/s, given for each element). Dissipates.
struct ViscousHourglass {
  static constexpr bool needs_velocity = true;
  static constexpr bool stores = false;
};

/// Stiffness control without history: q = k (I - H)^T w, w the content of the displacement u = x - (R X + t) and H its
/// gradient; it is the content of the reference coordinates seen from the present configuration, turned back, and the
/// same whatever R. k = kappa (lambda + 2 mu) V^(1/3) / 16 (N/m, given for each element). Stores |w|^2 k/2.
struct StiffnessHourglass {
  static constexpr bool needs_velocity = false;
  static constexpr bool stores = true;
};

}  // namespace railwave
