#pragma once

#include "kernels/materials/material.hpp"
#include "kernels/materials/plastic_flow.hpp"
#include "kernels/materials/polar_rotation.hpp"

namespace railwave {

/// What the elements of a block have in common where the material flows.
template <class Constants_, class S>
struct FlowingBlock {
  Constants_ constants;
  S turn[3][3];  ///< R, which single precision leaves out of displacements
};

/// What every material that flows keeps of an element: plastic Green strain (xx, yy, zz, xy, yz, zx) in the reference
/// configuration, equivalent plastic strain, and from value 7 on what is the material's own
/// (kernels/materials/plastic_flow.hpp). A batch in which no element has ever yielded pays for one value.
/// @tparam Constants_ of the material: has `elastic`
template <class Constants_, int Values>
struct FlowHistory {
  using Constants = Constants_;
  static constexpr int history_values = Values, plastic_strain = 6;

  double* history;             ///< see MaterialArrays
  const Constants* constants;  ///< by row

  template <class S>
  using OfBlock = FlowingBlock<Constants, S>;

  /// @param turn see StagedNodes::turn
  template <class S, class Turn>
  KOKKOS_FORCEINLINE_FUNCTION OfBlock<S> of_block(int row, const Turn& turn) const {
    OfBlock<S> result;
    result.constants = constants[row];
    if constexpr (sizeof(S) < sizeof(double))
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result.turn[i][j] = static_cast<S>(turn(i, j));
    return result;
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION static ElasticConstants elastic(const FlowingBlock<Constants, S>& block) {
    return block.constants.elastic;
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION double* value(int batch, int number) const {
    return history + tiled<S>(batch, history_values, number);
  }

  template <class S>
  KOKKOS_FORCEINLINE_FUNCTION Pack<S> equivalent(int batch) const {
    return load_history<S>(value<S>(batch, plastic_strain));
  }

  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void load_plastic(int batch, T (&plastic)[6]) const {
    for (int c = 0; c < 6; ++c) plastic[c] = load_history<S>(value<S>(batch, c));
  }

  /// Takes the plastic part from the Almansi strain e, with the history as it stands.
  template <class S, class Block, class T>
  KOKKOS_FORCEINLINE_FUNCTION void leave_elastic_part(const Block& block, int batch, const T (&K)[3][3],
                                                      T (&e)[6]) const {
    if (!any_lane(equivalent<S>(batch) > S(0))) return;
    T G[3][3], plastic[6], share[6];
    inverse_gradient<S>(block, K, G);
    load_plastic<S>(batch, plastic);
    carry(plastic, G, share);
    for (int c = 0; c < 6; ++c) e[c] -= share[c];
  }

  /// Books the flow of lanes that yield.
  /// @param e Almansi strain, elastic part, before the flow
  /// @param lost what the Hencky strain lost
  /// @param increment of the equivalent plastic strain; zero in lanes that do not yield
  /// @tparam Coaxial `lost` has the principal axes of e
  template <class S, bool Coaxial, class Block, class T, class Mask>
  KOKKOS_FORCEINLINE_FUNCTION void book_flow(const Block& block, int batch, const T (&K)[3][3], const T (&e)[6],
                                             const Mask& yields, const T (&lost)[6], const T& increment) const {
    T G[3][3], plastic[6], added[6];
    inverse_gradient<S>(block, K, G);
    load_plastic<S>(batch, plastic);
    plastic_increment<S, Coaxial>(G, e, lost, plastic, added);
    for (int c = 0; c < 6; ++c) add_to_history<S>(value<S>(batch, c), choose(yields, added[c], T(S(0))));
    add_to_history<S>(value<S>(batch, plastic_strain), increment);
  }

  template <class S, class Block, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void inverse_gradient(const Block& block, const T (&K)[3][3], T (&G)[3][3]) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if constexpr (sizeof(S) < sizeof(double))
          G[i][j] = block.turn[0][i] * K[0][j] + block.turn[1][i] * K[1][j] + block.turn[2][i] * K[2][j];
        else
          G[i][j] = K[i][j];
      }
  }
};

/// The same with a back stress b, Kirchhoff's, a deviator, which turns with the material: what is kept is a = R^T b R
/// in the axes of the reference, R the rotation of F = R U (Green and Naghdi's rate), which no rotation of the body
/// touches and which does not swing to and fro in large shear.
template <class Constants, int Values>
struct BackStressHistory : FlowHistory<Constants, Values> {
  static constexpr int back_stress = 7;  ///< first of the history's values of a: xx, yy, zz, xy, yz, zx; Pa

  /// R^T: the inverse deformation gradient is U^-1 R^T.
  template <class S, class Block, class T>
  KOKKOS_FORCEINLINE_FUNCTION static void turn_back(const Block& block, const T (&K)[3][3], T (&turned)[3][3]) {
    T G[3][3];
    FlowHistory<Constants, Values>::template inverse_gradient<S>(block, K, G);
    polar_rotation<S>(G, turned);
  }

  /// b from a.
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void load_back(int batch, const T (&turned)[3][3], T (&back)[6]) const {
    T kept[6];
    for (int c = 0; c < 6; ++c) kept[c] = load_history<S>(this->template value<S>(batch, back_stress + c));
    carry(kept, turned, back);
  }

  /// @param added to b
  template <class S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void add_back(int batch, const T (&turned)[3][3], const T (&added)[6]) const {
    T rotation[3][3], kept[6];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rotation[i][j] = turned[j][i];
    carry(added, rotation, kept);
    for (int c = 0; c < 6; ++c) add_to_history<S>(this->template value<S>(batch, back_stress + c), kept[c]);
  }
};

}  // namespace railwave
