#pragma once

#include "kernels/support/quaternion.hpp"
#include "kernels/support/spaces.hpp"

namespace railwave {

/// Straight elastic beams that shear, bend and twist, each of two nodes with a rotation of their own (the Hughes-Liu
/// beam of thesis 3.3.3, its section integrated beforehand). One integration point, in the middle: of the nodes'
/// rotations Q_a, Q_b and places x_a, x_b, with Q the rotation half-way between,
///   stretch and shears  Gamma = Q^T (x_b - x_a) / L - e_1,   twist and curvatures  kappa = log(Q_a^T Q_b) / L,
/// and the energy L/2 (Gamma . C_N Gamma + kappa . C_M kappa), whose derivatives are the forces and moments: without
/// history, free of stress in any rigid motion, energy and both momenta kept. See Simo and Vu-Quoc 1986, Crisfield and
/// Jelenic 1999. The shear stiffnesses hold the bending inside an element (MacNeal 1978), so that one element bends as
/// exactly as many.
struct BeamArrays {
  static constexpr int most_moments = 16;  ///< moments on beam nodes in a scene

  int count = 0;         ///< elements
  int node_count = 0;    ///< nodes at which they end
  int moment_count = 0;  ///< moments from outside
  int first = 0;         ///< contribution of the first element's first end; the others follow

  // By element.
  Array<int* [2]> end;           ///< beam nodes
  Array<double* [3][3]> axes;    ///< rows: along it, across, and along the section's height, before the run
  Array<double*> length;         ///< m
  Array<double* [3]> stiffness;  ///< N: axial, shear along the second and third axis
  Array<double* [3]> bending;    ///< N m2: torsion, bending about the second and third axis
  Array<double*> stretch;        ///< at which it has no axial force
  Array<double*> pretension;     ///< N
  Array<int*> tightened;  ///< 0: it has no pretension; of a bolt's elements the `holding` one has it while the scene
                          ///< settles whatever its stretch, the others begin with it
  static constexpr int holding = 1, beginning = 2;

  // By beam node.
  Array<int*> node;                   ///< of the model
  Array<double* [4]> rotation;        ///< since the start, at t_n
  Array<double* [3]> spin;            ///< rad/s, at t_n - step/2
  Array<double*> inertia;             ///< kg m2, about any axis
  Array<int*> constraint;             ///< row of the projections, -1: free
  Array<double* [3][3]> projections;  ///< I - sum d d^T over directions d about which a node is held
  Array<int*> first_moment;           ///< node_count + 1
  Array<int*> moment_of_node;         ///< rows of `moment`

  Array<double* [3]> moment;       ///< N m, on each end of each element (2 e, 2 e + 1), then those from outside
  Array<int*> loaded;              ///< beam node of each of these
  Array<double* [3]> moment_axis;  ///< unit
  Array<double*> work;             ///< J, done so far by each
};

/// What a beam's element has in its middle.
struct BeamMiddle {
  Quaternion turn;         ///< rotation of the middle since the start
  Vector3 arm;             ///< m, x_b - x_a turned back
  Vector3 half;            ///< tan(angle/4) times the axis, of the rotation from end to end
  Vector3 axis;            ///< sin(angle/2) times the axis
  double spread;           ///< (angle/2) / sin(angle/2)
  Vector3 stretch, curve;  ///< along the element's axes: strains; rad/m
  Vector3 force, moment;   ///< along its axes, N and N m
};

/// @param held the axial force of holding ones is their pretension, whatever their stretch
KOKKOS_INLINE_FUNCTION BeamMiddle beam_middle(const BeamArrays& beams, const Array<const double* [3]>& position, int e,
                                              bool held) {
  const int a = beams.end(e, 0), b = beams.end(e, 1);
  const Quaternion from = quaternion(beams.rotation, a);
  Quaternion relative = reversed(from) * quaternion(beams.rotation, b);
  if (relative.w < 0) relative = {-relative.w, -1.0 * relative.v};
  BeamMiddle m;
  const double root = 1 / std::sqrt(2 * (1 + relative.w));
  m.turn = from * Quaternion{(1 + relative.w) * root, root * relative.v};
  m.axis = relative.v;
  m.half = (1 / (1 + relative.w)) * relative.v;
  const double sine = norm(relative.v);
  m.spread = sine > 1e-8 ? std::atan2(sine, relative.w) / sine : 1 / relative.w;
  m.arm = turned(reversed(m.turn), row(position, beams.node(b)) - row(position, beams.node(a)));
  const double inverse = 1 / beams.length(e);
  for (int i = 0; i < 3; ++i) {
    const Vector3 along{{beams.axes(e, i, 0), beams.axes(e, i, 1), beams.axes(e, i, 2)}};
    m.stretch[i] = inverse * dot(along, m.arm) - (i == 0 ? 1.0 : 0.0);
    m.curve[i] = (2 * m.spread * inverse) * dot(along, relative.v);
    m.moment[i] = beams.bending(e, i) * m.curve[i];
  }
  for (int i = 0; i < 3; ++i) m.force[i] = beams.stiffness(e, i) * (m.stretch[i] - (i == 0 ? beams.stretch(e) : 0.0));
  if (held && beams.tightened(e) == BeamArrays::holding) m.force[0] = beams.pretension(e);
  return m;
}

/// What an element does to its ends.
struct BeamEnds {
  Vector3 force;      ///< N, on the first end; the opposite on the second
  Vector3 moment[2];  ///< N m
};

/// A sum of the element's axes.
KOKKOS_INLINE_FUNCTION Vector3 along_axes(const BeamArrays& beams, int e, const Vector3& x) {
  Vector3 sum{{0, 0, 0}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) sum[k] += x[i] * beams.axes(e, i, k);
  return sum;
}

/// With c = N x D, D the arm turned back, p = tan(angle/4) n and H = s I + (1 - s) n n^T, the derivatives by the ends'
/// spins are (c -+ c x p) / 2 +- H M, all turned with the middle: linear in the section's force N and moment M.
KOKKOS_INLINE_FUNCTION BeamEnds beam_ends(const BeamArrays& beams, int e, const BeamMiddle& m, const Vector3& force,
                                          const Vector3& moment) {
  const Vector3 N = along_axes(beams, e, force), M = along_axes(beams, e, moment);
  const double squared = dot(m.axis, m.axis);
  const double share = squared > 1e-8 ? (1 - m.spread) / squared : -1.0 / 6;
  const Vector3 bent = m.spread * M + (share * dot(m.axis, M)) * m.axis;
  const Vector3 lever = cross(N, m.arm), across = cross(lever, m.half);
  return {turned(m.turn, N),
          {turned(m.turn, bent - 0.5 * (lever + across)), turned(m.turn, -1.0 * bent - 0.5 * (lever - across))}};
}

/// Forces on the ends' nodes (contributions) and moments on their rotations; behind the elements come the moments from
/// outside, whose work since the last step is booked by the trapezoidal rule.
struct BeamForce {
  BeamArrays beams;
  Array<const double* [3]> position;
  Array<double* [3]> contribution;
  bool held;                                               ///< the scene settles
  double elapsed;                                          ///< s since the last step
  StepValue<double> given[BeamArrays::most_moments] = {};  ///< N m, now

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (i < beams.count)
      element(i);
    else
      moment_from_outside(i - beams.count);
  }

  KOKKOS_INLINE_FUNCTION void element(int e) const {
    const BeamMiddle m = beam_middle(beams, position, e, held);
    const BeamEnds ends = beam_ends(beams, e, m, m.force, m.moment);
    for (int k = 0; k < 3; ++k) {
      contribution(beams.first + 2 * e, k) = ends.force[k];
      contribution(beams.first + 2 * e + 1, k) = -ends.force[k];
      beams.moment(2 * e, k) = ends.moment[0][k];
      beams.moment(2 * e + 1, k) = ends.moment[1][k];
    }
  }

  KOKKOS_INLINE_FUNCTION void moment_from_outside(int l) const {
    const int r = 2 * beams.count + l;
    const Vector3 before = row(beams.moment, r), now = given[l]() * row(beams.moment_axis, l);
    beams.work(l) += 0.5 * elapsed * dot(before + now, row(beams.spin, beams.loaded(l)));
    for (int k = 0; k < 3; ++k) beams.moment(r, k) = now[k];
  }
};

/// Elastic energy of an element, J.
struct BeamEnergy {
  static constexpr int values = 1;
  BeamArrays beams;
  Array<const double* [3]> position;
  KOKKOS_INLINE_FUNCTION void operator()(int e, double* sum) const {
    const BeamMiddle m = beam_middle(beams, position, e, false);
    double twice = dot(m.moment, m.curve) + dot(m.force, m.stretch) - m.force[0] * beams.stretch(e);
    sum[0] += 0.5 * beams.length(e) * twice;
  }
};

/// Section forces (N) and moments (N m) of an element, for the outside.
struct BeamSectionForces {
  static constexpr int values = 6;
  BeamArrays beams;
  Array<const double* [3]> position;
  KOKKOS_INLINE_FUNCTION void operator()(int e, double* sum) const {
    const BeamMiddle m = beam_middle(beams, position, e, false);
    for (int i = 0; i < 3; ++i) {
      sum[i] += m.force[i];
      sum[3 + i] += m.moment[i];
    }
  }
};

/// Sets the stretch without axial force of the tightened ones so that it is their pretension as they lie.
struct TightenBeams {
  BeamArrays beams;
  Array<const double* [3]> position;
  bool all;  ///< false: only of those that held it while the scene settled
  KOKKOS_INLINE_FUNCTION void operator()(const int e) const {
    if (beams.tightened(e) == 0 || (!all && beams.tightened(e) != BeamArrays::holding)) return;
    beams.stretch(e) = beam_middle(beams, position, e, true).stretch[0] - beams.pretension(e) / beams.stiffness(e, 0);
  }
};

}  // namespace railwave
