#pragma once

#include "kernels/bilinear.hpp"
#include "kernels/polar_rotation.hpp"

namespace railwave {

/// Bilinear with a back stress: of the hardening modulus H the share beta widens the yield surface and 1 - beta moves
/// it (Prager; Simo & Hughes, Computational Inelasticity, 3.3.1). With xi = s - b and q = sqrt(3/2 xi : xi),
///   q <= sigma_y + beta H e_p,   de_p = (q_trial - limit) / (3 mu + H),   db = 2/3 (1 - beta) H (3/2 de_p xi / q).
/// The back stress b (Kirchhoff's, a deviator) turns with the material: what is kept is a = R^T b R in the axes of the
/// reference, R the rotation of F = R U (Green and Naghdi's rate), which no rotation of the body touches and which does
/// not swing to and fro in large shear. beta = 1 is Bilinear, which knows nothing of all this.
struct KinematicBilinear {
  static constexpr int back_values = 6;

  Bilinear bilinear;
  Array<const double*> isotropic_share;  ///< beta, by row
  Array<double*> back_stress;            ///< a, tiled, xx, yy, zz, xy, yz, zx; Pa. In double precision like the history

  template <class S>
  struct OfPatch {
    Bilinear::OfPatch<S> bilinear;
    double isotropic_share;
  };

  template <class S, class Turn>
  KOKKOS_FORCEINLINE_FUNCTION OfPatch<S> of_patch(const PatchArrays& patches, int p, const Turn& turn) const {
    return {bilinear.template of_patch<S>(patches, p, turn), isotropic_share(patches.material(p))};
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION static ElasticConstants elastic(const OfPatch<S>& patch) {
    return Bilinear::elastic(patch.bilinear);
  }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void leave_elastic_part(const OfPatch<S>& patch, int batch, const T (&K)[3][3],
                                                      T (&e)[6]) const {
    bilinear.template leave_elastic_part<S>(patch.bilinear, batch, K, e);
  }

  /// Kirchhoff stress at the present instant, with the flow that leads to it, Pa.
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void stress(const OfPatch<S>& patch, int batch, const T (&K)[3][3], T (&e)[6],
                                          T (&tau)[6]) const {
    const BilinearConstants& constants = patch.bilinear.constants;
    T h[6], xi[6], turned[3][3];
    bilinear.template leave_elastic_part<S>(patch.bilinear, batch, K, e);
    hencky_strain(e, h);
    kirchhoff_stress<S>(constants.elastic, h, tau);
    deviator<S>(tau, xi);
    const T equivalent = load_history<S>(bilinear.template value<S>(batch, 6));
    // As long as nothing has flowed there is no back stress either.
    const bool has_flowed = any_lane(equivalent > S(0));
    if (has_flowed) {
      T kept[6], back[6];
      turn_back<S>(patch, K, turned);
      for (int c = 0; c < 6; ++c) kept[c] = load_history<S>(back_value<S>(batch, c));
      carry(kept, turned, back);
      for (int c = 0; c < 6; ++c) xi[c] -= back[c];
    }
    const T mises_square = S(1.5) * (xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]) +
                           S(3) * (xi[3] * xi[3] + xi[4] * xi[4] + xi[5] * xi[5]);
    const T limit = S(constants.yield_stress) + S(patch.isotropic_share * constants.hardening) * equivalent;
    const auto yields = mises_square > limit * limit;
    if (!any_lane(yields)) return;
    T lost[6];
    bilinear.template flow<S, false>(patch.bilinear, batch, K, e, yields, xi, mises_square, limit, tau, lost);
    if (!has_flowed) turn_back<S>(patch, K, turned);
    move_surface<S>(patch, batch, turned, lost);
  }

 private:
  /// R^T: the inverse deformation gradient is U^-1 R^T.
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void turn_back(const OfPatch<S>& patch, const T (&K)[3][3], T (&turned)[3][3]) {
    T G[3][3];
    Bilinear::inverse_gradient<S>(patch.bilinear, K, G);
    polar_rotation<S>(G, turned);
  }

  /// @param lost flow of the Hencky strain; zero in lanes that do not yield
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void move_surface(const OfPatch<S>& patch, int batch, const T (&turned)[3][3],
                                                const T (&lost)[6]) const {
    T rotation[3][3], back[6], kept[6];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rotation[i][j] = turned[j][i];
    const S modulus = S(2.0 / 3 * (1 - patch.isotropic_share) * patch.bilinear.constants.hardening);
    for (int c = 0; c < 6; ++c) back[c] = modulus * lost[c];
    carry(back, rotation, kept);
    for (int c = 0; c < 6; ++c) add_to_history<S>(back_value<S>(batch, c), kept[c]);
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION double* back_value(int batch, int number) const {
    return back_stress.data() + tiled<S>(batch, back_values, number);
  }
};

/// Work of the flow when part of the hardening moves the yield surface, J for each m3 of the reference: what isotropic
/// hardening makes of it, and 3 a : a / (4 (1 - beta) H) in the moved surface, which comes back when the flow is
/// reversed.
/// @param back a as it is kept, Pa
KOKKOS_INLINE_FUNCTION double plastic_work(const BilinearConstants& constants, double isotropic_share,
                                           double equivalent, const double (&back)[6]) {
  const double isotropic =
      (constants.yield_stress + 0.5 * isotropic_share * constants.hardening * equivalent) * equivalent;
  const double kinematic = (1 - isotropic_share) * constants.hardening;
  if (!(kinematic > 0)) return isotropic;
  double square = 0;
  for (int c = 0; c < 6; ++c) square += (c < 3 ? 1 : 2) * back[c] * back[c];
  return isotropic + 0.75 * square / kinematic;
}

}  // namespace railwave
