#pragma once

#include "kernels/support/lanes.hpp"
#include "kernels/support/spaces.hpp"

/// A material of elements is a struct with these members, in a file of its own here, listed in
/// kernels/materials/all.hpp. What it is to the host stands in src/model/elements/materials.hpp.
///
/// | member | what |
/// |---|---|
/// | `Constants` | what elements of one material have in common: doubles alone |
/// | `history_values` | doubles that each element keeps from step to step, zero at the start; 0: none |
/// | `plastic_strain` | which of these is the equivalent plastic strain |
/// | `OfBlock<S>`, `of_block<S>(row, turn)` | what the elements of a block have in common |
/// | `elastic(of_block)` | its elastic constants |
/// | `leave_elastic_part<S>(of_block, batch, K, e)` | takes the plastic part from the Almansi strain e |
/// | `stress<S>(of_block, batch, K, e, tau)` | Kirchhoff stress from the Almansi strain, and the flow that leads there
/// | | `work(constants, history)` | J dissipated by flow for each m3 of the reference |
///
/// K = I - H is the inverse deformation gradient but for the turn that single precision leaves out, G = R^T K.
namespace railwave {

/// A group of elements as its material sees it.
struct MaterialArrays {
  int number = 0;            ///< of the material among `Materials`
  int history_values = 0;    ///< of each element
  Array<double*> constants;  ///< `Constants` by the blocks' material row
  Array<double*> history;    ///< in tiles of `history_values`; in double precision whatever the elements' own
  Array<double*> volume;     ///< m3, of the reference, by slot, zero in slots that only fill up; empty without history
  bool flows() const { return history_values > 0; }
};

/// The kernels' material of a group's elements.
template <class Material>
Material material_of(const MaterialArrays& arrays) {
  using Constants = typename Material::Constants;
  static_assert(sizeof(Constants) % sizeof(double) == 0 && alignof(Constants) == alignof(double));
  const auto* constants = reinterpret_cast<const Constants*>(arrays.constants.data());
  Material material;
  material.constants = constants;
  if constexpr (Material::history_values > 0) material.history = arrays.history.data();
  return material;
}

}  // namespace railwave
