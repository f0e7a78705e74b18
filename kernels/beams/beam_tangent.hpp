#pragma once

#include "kernels/beams/beam.hpp"

namespace railwave {

/// Beams as springs about their present places, which is what their forces answer small motions with but for terms of
/// the order of moments over stiffness: one for each strain of the element's middle, stretched by what the ends'
/// displacements and spins do to L Gamma or L kappa; and where it is pulled, N / L across it, as of a string.
struct BeamTangent {
  static constexpr int springs = 8;  ///< of an element: three of force, three of moment, two of the string
  static constexpr int ends = 4;     ///< rows of a spring: first and second node, first and second rotation

  BeamArrays beams;
  Array<const double* [3]> position;
  bool held;  ///< the scene settles, see beam_middle
  Array<double* [springs][ends][3]> share;
  Array<double* [springs]> stiffness;  ///< N/m, N m; 0: no such spring

  KOKKOS_INLINE_FUNCTION void operator()(const int e) const {
    const BeamMiddle m = beam_middle(beams, position, e, held);
    const double inverse = 1 / beams.length(e);
    const Vector3 none{{0, 0, 0}};
    for (int i = 0; i < 3; ++i) {
      Vector3 unit = none;
      unit[i] = 1;
      const BeamEnds of_force = beam_ends(beams, e, m, unit, none), of_moment = beam_ends(beams, e, m, none, unit);
      store(e, i, of_force.force, of_force.moment[0], of_force.moment[1]);
      store(e, 3 + i, none, of_moment.moment[0], of_moment.moment[1]);
      const bool constant = i == 0 && held && beams.tightened(e) == BeamArrays::holding;
      stiffness(e, i) = constant ? 0.0 : inverse * beams.stiffness(e, i);
      stiffness(e, 3 + i) = inverse * beams.bending(e, i);
      if (i == 0) continue;
      store(e, 5 + i, of_force.force, none, none);
      stiffness(e, 5 + i) = inverse * std::fmax(m.force[0], 0.0);
    }
  }

  KOKKOS_INLINE_FUNCTION void store(int e, int s, const Vector3& force, const Vector3& first,
                                    const Vector3& second) const {
    for (int k = 0; k < 3; ++k) {
      share(e, s, 0, k) = force[k];
      share(e, s, 1, k) = -force[k];
      share(e, s, 2, k) = first[k];
      share(e, s, 3, k) = second[k];
    }
  }
};

}  // namespace railwave
