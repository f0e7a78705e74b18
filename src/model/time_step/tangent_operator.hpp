#pragma once

#include "kernels/statics/tangent.hpp"
#include "model/assembly.hpp"
#include "model/elements/hourglass_scale.hpp"
#include "model/time_step/tangent_springs.hpp"

namespace railwave {

template <class Visitor>
struct Named;  // model/visit_arrays.hpp

/// Forces of small motions u about the present places: of elements, by corners that are stored and gathered, and of
/// springs.
class TangentOperator {
 public:
  /// @param more_rows of the vectors, behind the nodes', for springs alone
  explicit TangentOperator(const Assembly& assembly, int more_rows = 0);

  void set_springs(const SpringCollector& springs) { springs.bring_to(springs_); }

  /// f = K u, replacing what f held.
  /// @param stiffness of each part, in order
  /// @param inverse_time 1/s, what the springs' dashpots count with
  void apply(const Assembly& assembly, const std::vector<ElementStiffness>& stiffness,
             const Array<const double* [3]>& position, const NodeVector& u, double inverse_time,
             const NodeVector& f) const;

  /// The springs' part of it, added to f.
  void add_springs(const NodeVector& u, double inverse_time, const NodeVector& f) const;

  const Array<int*>& first_corner() const { return first_corner_; }
  const Array<int*>& corner() const { return corner_; }
  const Array<int* [8]>& corners() const { return corners_; }

  template <class Visitor>
  friend void visit_arrays(const Named<Visitor>& visit, TangentOperator& tangent);

 private:
  Array<int* [8]> corners_;
  Array<int*> first_corner_, corner_;  ///< see GatherTangent
  Array<double* [24]> corner_force_;
  TangentSprings springs_;
};

/// Of a part's elements while nothing moves: linear elastic, with the stiffness hourglass control that they have while
/// settling.
inline ElementStiffness settling_stiffness(const scene::Part& part, const scene::Material& material) {
  const double mu = material.shear_modulus();
  const double factor =
      hourglass_factor(scene::HourglassType::stiffness, settling_hourglass_coefficient(part), material);
  return {material.dilatational_modulus() - 2 * mu, mu, factor, false, 0};
}

}  // namespace railwave
