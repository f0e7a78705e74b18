#pragma once

#include "kernels/beams/beam_rotation.hpp"
#include "kernels/statics/tangent.hpp"
#include "kernels/ties/tie.hpp"

/// What finding a static equilibrium does with vectors of three components a node, and of as many a rotation of a beam
/// node behind them.
namespace railwave {

/// A symmetric tensor of a node: xx, yy, zz, xy, yz, zx.
using NodeBlocks = Array<double* [6]>;

KOKKOS_INLINE_FUNCTION Vector3 block_product(const NodeBlocks& blocks, int n, const Vector3& v) {
  return {{blocks(n, 0) * v[0] + blocks(n, 3) * v[1] + blocks(n, 5) * v[2],
           blocks(n, 3) * v[0] + blocks(n, 1) * v[1] + blocks(n, 4) * v[2],
           blocks(n, 5) * v[0] + blocks(n, 4) * v[1] + blocks(n, 2) * v[2]}};
}

/// Directions along which rows are held.
struct HeldRows {
  Array<int*> row;                    ///< of the projections, -1: free
  Array<double* [3][3]> projections;  ///< I - sum d d^T

  KOKKOS_INLINE_FUNCTION Vector3 free(int n, const Vector3& a) const { return projected(projections, row(n), a); }
};

/// Unbalanced force of each node, N, held directions taken out.
struct StaticResidual {
  NodalAcceleration acceleration;              ///< its gravity is used
  Array<const double* [3]> body_acceleration;  ///< m/s2, see RelaxationUpdate
  HeldRows held;
  NodeVector residual;

  KOKKOS_INLINE_FUNCTION Vector3 body_force(int n) const {
    return acceleration.force.nodes.mass(n) * (acceleration.gravity + row(body_acceleration, n));
  }
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const Vector3 force = held.free(n, acceleration.force(n) + body_force(n));
    for (int i = 0; i < 3; ++i) residual(n, i) = force[i];
  }
};

/// What the constraints let through on each node, N: the forces that hold_ends takes over.
struct StaticReaction {
  StaticResidual residual;
  NodeVector reaction;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const NodalAcceleration& acceleration = residual.acceleration;
    const Vector3 force = acceleration.constrain(n, acceleration.force(n) + residual.body_force(n));
    for (int i = 0; i < 3; ++i) reaction(n, i) = force[i];
  }
};

/// Unbalanced moment of each rotation, N m.
struct StaticMoment {
  BeamNodeMoment node;
  int first;  ///< row of the first rotation
  NodeVector residual;
  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    const Vector3 moment = node.moment(b);
    for (int i = 0; i < 3; ++i) residual(first + b, i) = moment[i];
  }
};

/// Sums of |unbalanced force|, and of |applied and contact force| with those of beams and ties.
struct StaticUnbalance {
  static constexpr int values = 2;
  StaticResidual residual;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const {
    sum[0] += norm(row(residual.residual, n));
    sum[1] += norm(residual.body_force(n)) + norm(residual.acceleration.force.external_force(n));
  }
};

/// Sum of the lengths of the nodes' vectors.
struct SumOfLengths {
  static constexpr int values = 1;
  NodeVector vectors;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const { sum[0] += norm(row(vectors, n)); }
};

/// x = origin + share * way
struct GoAlong {
  NodeVector x, origin, way;
  double share;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    for (int i = 0; i < 3; ++i) x(n, i) = origin(n, i) + share * way(n, i);
  }
};

/// Slaves where their masters' faces are.
struct PlaceSlaves {
  TieArrays ties;
  NodeVector position;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    const TiedPlace tied = ties.places(s);
    const Vector3 x = tied.place(position);
    for (int k = 0; k < 3; ++k) position(tied.slave, k) = x[k];
  }
};

/// The same for rotations: from where they were, by a share of the way's.
struct TurnAlong {
  BeamNodeMoment node;
  int first;  ///< row of the first rotation
  Array<const double* [4]> origin;
  NodeVector way;
  double share;
  KOKKOS_INLINE_FUNCTION void operator()(const int b) const {
    for (int k = 0; k < 4; ++k) node.beams.rotation(b, k) = origin(b, k);
    node.turn(b, share * row(way, first + b));
  }
};

/// The diagonal blocks of the elements' stiffness, node by node.
struct StiffnessBlocks {
  Array<const int*> first_corner, corner;  ///< see GatherTangent
  Array<const int* [8]> corners;
  Array<const double* [3]> position;
  Array<const ElementStiffness*> stiffness;
  Array<const int*> stiffness_of_element;
  NodeBlocks blocks;

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    double sum[6] = {0, 0, 0, 0, 0, 0};
    for (int k = first_corner(n); k < first_corner(n + 1); ++k) add(corner(k) / 8, corner(k) % 8, sum);
    for (int c = 0; c < 6; ++c) blocks(n, c) = sum[c];
  }

  KOKKOS_INLINE_FUNCTION void add(int e, int own, double (&sum)[6]) const {
    double x[3][7];
    for (int i = 0; i < 3; ++i) {
      double place[8];
      for (int N = 0; N < 8; ++N) place[N] = position(corners(e, N), i);
      modes_of(place, x[i]);
    }
    const ElementStiffness of_element = stiffness(stiffness_of_element(e));
    constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int j = 0; j < 3; ++j) {
      double u[3][7] = {}, force[3][8];
      for (int mode = 0; mode < 7; ++mode) u[j][mode] = mode_sign(mode, own);
      of_element(x, u, force);
      for (int i = 0; i <= j; ++i) sum[voigt[i][j]] += force[i][own];
    }
  }
};

/// Adds a shift of the diagonal; takes held directions out.
struct ShiftAndHold {
  NodeVector u, f;
  Array<const double*> diagonal;
  double shift;
  HeldRows held;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const double s = shift * diagonal(n);
    const Vector3 a = held.free(n, row(f, n) + s * row(u, n));
    for (int i = 0; i < 3; ++i) f(n, i) = a[i];
  }
};

/// Coarse coordinates: for each aggregate of rows as many as a rigid body has, u = sum_m mode_m y_m at its nodes.
struct CoarseModes {
  static constexpr int of_aggregate = 6;
  Array<int*> first;  ///< by aggregate, and one more: its nodes
  Array<int*> node;
  Array<int*> aggregate;     ///< by node
  Array<double* [18]> mode;  ///< by node: mode_m along i is entry 3 m + i; zero along held directions
};

/// y = Z^T r
struct CoarseRestrict {
  CoarseModes modes;
  NodeVector r;
  Array<double*> y;
  /// Entries of y that a team finds: a processor asks for each node once.
  static constexpr int entries_of_team = on_device ? 1 : CoarseModes::of_aggregate;

  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    if constexpr (on_device)
      find_entry(team);
    else
      find_entries(team.league_rank());
  }

  KOKKOS_INLINE_FUNCTION void find_entries(int a) const {
    double sum[CoarseModes::of_aggregate] = {};
    for (int p = modes.first(a); p < modes.first(a + 1); ++p) {
      const int n = modes.node(p);
      for (int m = 0; m < CoarseModes::of_aggregate; ++m)
        for (int i = 0; i < 3; ++i) sum[m] += modes.mode(n, 3 * m + i) * r(n, i);
    }
    for (int m = 0; m < CoarseModes::of_aggregate; ++m) y(a * CoarseModes::of_aggregate + m) = sum[m];
  }

  template <class Member>
  KOKKOS_INLINE_FUNCTION void find_entry(const Member& team) const {
    const int k = team.league_rank(), a = k / CoarseModes::of_aggregate, m = k % CoarseModes::of_aggregate;
    double sum = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, modes.first(a), modes.first(a + 1)),
        [&](int p, double& part) {
          const int n = modes.node(p);
          for (int i = 0; i < 3; ++i) part += modes.mode(n, 3 * m + i) * r(n, i);
        },
        sum);
    if (team.team_rank() == 0) y(k) = sum;
  }
};

/// z = B^-1 r + Z y, with B^-1 given node by node.
struct CoarseAndFine {
  CoarseModes modes;
  Array<const double*> y;
  NodeBlocks inverse;
  NodeVector r, z;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    Vector3 sum = block_product(inverse, n, row(r, n));
    const int first = modes.aggregate(n) * CoarseModes::of_aggregate;
    for (int m = 0; m < CoarseModes::of_aggregate; ++m)
      for (int i = 0; i < 3; ++i) sum[i] += modes.mode(n, 3 * m + i) * y(first + m);
    for (int i = 0; i < 3; ++i) z(n, i) = sum[i];
  }
};

/// d += alpha p, r -= alpha q
struct ConjugateStep {
  NodeVector d, r, p, q;
  double alpha;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    for (int i = 0; i < 3; ++i) {
      d(n, i) += alpha * p(n, i);
      r(n, i) -= alpha * q(n, i);
    }
  }
};

/// p = z + beta p
struct ConjugateTurn {
  NodeVector p, z;
  double beta;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    for (int i = 0; i < 3; ++i) p(n, i) = z(n, i) + beta * p(n, i);
  }
};

}  // namespace railwave
