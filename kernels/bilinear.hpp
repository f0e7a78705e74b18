#pragma once

#include "kernels/patches.hpp"
#include "kernels/plastic_flow.hpp"

namespace railwave {

/// Elastic up to a yield stress, then linear isotropic hardening (kernels/plastic_flow.hpp). A batch in which no
/// element has ever yielded pays for one value and a yield test; one in which none yields now, for no update.
struct Bilinear {
  static constexpr int history_values = 7;

  Array<const BilinearConstants*> constants;  ///< by row
  /// Tiled, 7 values: plastic Green strain (xx, yy, zz, xy, yz, zx) in the reference configuration, equivalent plastic
  /// strain. In double precision whatever the elements' own.
  Array<double*> history;

  /// What the elements of a patch share.
  template <class S>
  struct OfPatch {
    BilinearConstants constants;
    S turn[3][3];  ///< R, which single precision leaves out of displacements
  };

  /// @param turn see StagedNodes::turn
  template <class S, class Turn>
  KOKKOS_FORCEINLINE_FUNCTION OfPatch<S> of_patch(const PatchArrays& patches, int p, const Turn& turn) const {
    OfPatch<S> result;
    result.constants = constants(patches.material(p));
    if constexpr (sizeof(S) < sizeof(double))
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result.turn[i][j] = static_cast<S>(turn(i, j));
    return result;
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION static ElasticConstants elastic(const OfPatch<S>& patch) {
    return patch.constants.elastic;
  }

  /// Takes the plastic part from the Almansi strain e, with the history as it stands.
  /// @param K I - H: the inverse deformation gradient but for the turn left out, G = R^T K
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void leave_elastic_part(const OfPatch<S>& patch, int batch, const T (&K)[3][3],
                                                      T (&e)[6]) const {
    if (!any_lane(load_history<S>(value<S>(batch, 6)) > S(0))) return;
    T G[3][3], plastic[6], share[6];
    inverse_gradient<S>(patch, K, G);
    load_plastic<S>(batch, plastic);
    carry(plastic, G, share);
    for (int c = 0; c < 6; ++c) e[c] -= share[c];
  }

  /// Kirchhoff stress at the present instant, with the flow that leads to it, Pa.
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void stress(const OfPatch<S>& patch, int batch, const T (&K)[3][3], T (&e)[6],
                                          T (&tau)[6]) const {
    T h[6], s[6];
    leave_elastic_part<S>(patch, batch, K, e);
    hencky_strain(e, h);
    kirchhoff_stress<S>(patch.constants.elastic, h, tau);
    const T mises_square = deviator<S>(tau, s);
    const T limit = flow_stress<S>(patch.constants, T(load_history<S>(value<S>(batch, 6))));
    const auto yields = mises_square > limit * limit;
    T lost[6];
    if (any_lane(yields)) flow<S, true>(patch, batch, K, e, yields, s, mises_square, limit, tau, lost);
  }

  /// Brings the stress of lanes that yield back to the yield surface and books the flow.
  /// @param s relative to the yield surface's centre; @param lost result: what the Hencky strain lost
  /// @tparam Coaxial s has the principal axes of e
  template <class S, bool Coaxial, class T, class Mask>
  KOKKOS_FORCEINLINE_FUNCTION void flow(const OfPatch<S>& patch, int batch, const T (&K)[3][3], const T (&e)[6],
                                        const Mask& yields, const T (&s)[6], const T& mises_square, const T& limit,
                                        T (&tau)[6], T (&lost)[6]) const {
    T G[3][3], plastic[6], increment[6];
    const T equivalent = radial_return<S>(patch.constants, yields, s, mises_square, limit, tau, lost);
    inverse_gradient<S>(patch, K, G);
    load_plastic<S>(batch, plastic);
    plastic_increment<S, Coaxial>(G, e, lost, plastic, increment);
    for (int c = 0; c < 6; ++c) add_to_history<S>(value<S>(batch, c), choose(yields, increment[c], T(S(0))));
    add_to_history<S>(value<S>(batch, 6), equivalent);
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION double* value(int batch, int number) const {
    return history.data() + tiled<S>(batch, history_values, number);
  }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void load_plastic(int batch, T (&plastic)[6]) const {
    for (int c = 0; c < 6; ++c) plastic[c] = load_history<S>(value<S>(batch, c));
  }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void inverse_gradient(const OfPatch<S>& patch, const T (&K)[3][3], T (&G)[3][3]) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if constexpr (sizeof(S) < sizeof(double))
          G[i][j] = patch.turn[0][i] * K[0][j] + patch.turn[1][i] * K[1][j] + patch.turn[2][i] * K[2][j];
        else
          G[i][j] = K[i][j];
      }
  }
};

}  // namespace railwave
