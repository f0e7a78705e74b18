#pragma once

#include "kernels/elements/element_modes.hpp"
#include "kernels/elements/hourglass.hpp"
#include "kernels/nodes/nodes.hpp"
#include "kernels/support/batches.hpp"

/// The scene as a linear operator on small motions about its present state, for estimates of its highest frequency:
/// K + C/tau with K the stiffness of elements, hourglass control and springs, C their dashpots, and tau a time. Always
/// in double, whatever precision the step has. Motions are in mass-weighted coordinates q = M^(1/2) u.
namespace railwave {

using NodeVector = Array<double* [3]>;

struct InnerProduct {
  static constexpr int values = 1;
  NodeVector a, b;
  KOKKOS_INLINE_FUNCTION void operator()(int n, double* sum) const { sum[0] += dot(row(a, n), row(b, n)); }
};

/// q -> u = M^(-1/2) q
struct ToDisplacement {
  NodeVector q, u;
  Array<const double*> mass;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const double scale = 1 / std::sqrt(mass(n));
    for (int i = 0; i < 3; ++i) u(n, i) = scale * q(n, i);
  }
};

/// Stiffness of an element (Lame's constants with the share of damping in proportion to stiffness; not that in
/// proportion to mass): linear elastic about the present configuration, stresses' own (geometric) stiffness left out:
/// it is of the order of stress over modulus.
struct ElementStiffness {
  double lambda, mu;  ///< Pa
  double hourglass;   ///< factor of the control's scale: N/m over m (stiffness), kg/s over m2 over tau (viscous)
  bool viscous;       ///< scale goes with V^(2/3), else V^(1/3)
  double bulk;        ///< Pa/m: of bulk viscosity over tau, goes with V^(1/3)

  bool operator==(const ElementStiffness& other) const {
    return lambda == other.lambda && mu == other.mu && hourglass == other.hourglass && viscous == other.viscous &&
           bulk == other.bulk;
  }

  /// @tparam T a number, or a pack of numbers
  /// @param x modes of the coordinates, m
  /// @param u modes of the displacements, m
  /// @param force by direction and corner, N
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T (&x)[3][7], const T (&u)[3][7], T (&force)[3][8]) const {
    T B[3][6], L[3][3];
    mean_gradient<double>(x, B);
    const T volume = along(x[0], B[0]), inverse = 1 / volume, root = cube_root(volume);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) L[i][j] = inverse * along(u[i], B[j]);
    const T scale = hourglass * (viscous ? root * root : root);
    const T trace = (lambda + bulk * root) * (L[0][0] + L[1][1] + L[2][2]);
    for (int i = 0; i < 3; ++i) {
      T q[4], t[3], modes[7];
      for (int M = 0; M < 4; ++M) q[M] = scale * hourglass_content(u[i], L[i], x, M);
      for (int j = 0; j < 3; ++j) {
        t[j] = mu * (L[i][j] + L[j][i]);
        if (i == j) t[j] += trace;
        for (int M = 0; M < 4; ++M) t[j] -= inverse * q[M] * x[j][3 + M];
      }
      for (int k = 0; k < 7; ++k) {
        modes[k] = k < 3 ? T(0) : q[k - 3];
        if (k < 6) modes[k] += t[0] * B[0][k] + t[1] * B[1][k] + t[2] * B[2][k];
      }
      corners_of(modes, force[i]);
    }
  }

 private:
  static KOKKOS_INLINE_FUNCTION double cube_root(double volume) { return std::cbrt(volume); }
#ifdef RAILWAVE_SIMD_LANES
  static Pack<double> cube_root(const Pack<double>& volume) {
    return Pack<double>([&](auto lane) { return std::cbrt(static_cast<double>(volume[lane])); });
  }
#endif
};

/// Forces K u + C u / tau of the elements of one part on their corners, element by element: a pack of them at once.
struct ElementTangent {
  using T = Pack<double>;
  static constexpr int lanes = lane_count<double>;
  int first, count;  ///< elements
  ElementStiffness stiffness;
  Array<const int* [8]> corners;
  Array<const double* [3]> position;
  NodeVector displacement;
  Array<double* [24]> force;

  static int batches(int elements) { return (elements + lanes - 1) / lanes; }

  KOKKOS_INLINE_FUNCTION void operator()(const int batch) const {
    const int begin = batch * lanes, left = count - begin;
    const int filled = left < lanes ? left : lanes;
    T x[3][7], u[3][7], at_corner[3][8];
    bring(first + begin, filled, x, u);
    stiffness(x, u, at_corner);
    leave(first + begin, filled, at_corner);
  }

#ifdef RAILWAVE_SIMD_LANES
  /// A node's values lie together, those of a pack's elements do not: they are put side by side one by one.
  /// @param filled lanes; the others compute the last one's element again
  KOKKOS_FORCEINLINE_FUNCTION void bring(int e, int filled, T (&x)[3][7], T (&u)[3][7]) const {
    double place[3][8][lanes], moved[3][8][lanes];
    for (int l = 0; l < lanes; ++l)
      for (int N = 0; N < 8; ++N) {
        const int n = corners(e + (l < filled ? l : filled - 1), N);
        for (int i = 0; i < 3; ++i) {
          place[i][N][l] = position(n, i);
          moved[i][N][l] = displacement(n, i);
        }
      }
    for (int i = 0; i < 3; ++i) {
      modes_of_lanes(place[i], x[i]);
      modes_of_lanes(moved[i], u[i]);
    }
  }

  static void modes_of_lanes(const double (&values)[8][lanes], T (&modes)[7]) {
    T of_corner[8];
    for (int N = 0; N < 8; ++N) of_corner[N] = load<double>(values[N]);
    modes_of(of_corner, modes);
  }

  KOKKOS_FORCEINLINE_FUNCTION void leave(int e, int filled, const T (&at_corner)[3][8]) const {
    double values[24][lanes];
    for (int N = 0; N < 8; ++N)
      for (int i = 0; i < 3; ++i) store<double>(values[3 * N + i], at_corner[i][N]);
    for (int l = 0; l < filled; ++l)
      for (int k = 0; k < 24; ++k) force(e + l, k) = values[k][l];
  }
#else
  KOKKOS_FORCEINLINE_FUNCTION void bring(int e, int /*filled*/, T (&x)[3][7], T (&u)[3][7]) const {
    for (int i = 0; i < 3; ++i) {
      double place[8], moved[8];
      for (int N = 0; N < 8; ++N) {
        place[N] = position(corners(e, N), i);
        moved[N] = displacement(corners(e, N), i);
      }
      modes_of(place, x[i]);
      modes_of(moved, u[i]);
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void leave(int e, int /*filled*/, const T (&at_corner)[3][8]) const {
    for (int i = 0; i < 3; ++i)
      for (int N = 0; N < 8; ++N) force(e, 3 * N + i) = at_corner[i][N];
  }
#endif
};

/// Springs and dashpots: stretch = sum_k s_k . u_k, of nodes or of any other rows of u.
struct TangentSprings {
  int count = 0;
  Array<int*> first;  ///< count + 1
  Array<int*> node;
  Array<double* [3]> share;   ///< s: between means of nodes along one direction, weight times that
  Array<double*> stiffness;   ///< N/m
  Array<double*> damping;     ///< N s/m
  Array<double*> force;       ///< N
  int node_count = 0;         ///< nodes with springs
  Array<int*> with_springs;   ///< those nodes
  Array<int*> first_of_node;  ///< node_count + 1
  Array<int*> spring_of_node;
  Array<double* [3]> share_of_node;
};

struct SpringForce {
  TangentSprings springs;
  NodeVector displacement;
  double inverse_time;  ///< 1/tau, 1/s
  /// One team: a spring between sets has many nodes.
  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int s = team.league_rank();
    double stretch = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, springs.first(s), springs.first(s + 1)),
        [&](int k, double& sum) { sum += dot(row(springs.share, k), row(displacement, springs.node(k))); }, stretch);
    if (team.team_rank() == 0) springs.force(s) = (springs.stiffness(s) + inverse_time * springs.damping(s)) * stretch;
  }
};

/// Sum of the corner forces on each node; corner c is of element c / 8, corner c % 8.
struct GatherTangent {
  Array<const int*> first_corner, corner;
  Array<const double* [24]> force;
  NodeVector sum;

#ifdef RAILWAVE_SIMD_LANES
  /// Asks for a node's corner forces.
  KOKKOS_FORCEINLINE_FUNCTION void prefetch_forces(int n) const {
    for (int k = first_corner(n); k < first_corner(n + 1); ++k) prefetch(&force(corner(k) / 8, 3 * (corner(k) % 8)));
  }
#endif

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
#ifdef RAILWAVE_SIMD_LANES
    if (n + prefetch_ahead < static_cast<int>(sum.extent(0))) prefetch_forces(n + prefetch_ahead);
#endif
    double f[3] = {0, 0, 0};
    for (int k = first_corner(n); k < first_corner(n + 1); ++k) {
      const int e = corner(k) / 8, N = corner(k) % 8;
      for (int i = 0; i < 3; ++i) f[i] += force(e, 3 * N + i);
    }
    for (int i = 0; i < 3; ++i) sum(n, i) = f[i];
  }
};

struct AddSprings {
  TangentSprings springs;
  NodeVector sum;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int n = springs.with_springs(i);
    const Vector3 f = add_in_batches<batch_of_few_threads>(
        row(sum, n), springs.first_of_node(i), springs.first_of_node(i + 1), [&](int k) {
          return WeightedVector{springs.force(springs.spring_of_node(k)), row(springs.share_of_node, k)};
        });
    for (int c = 0; c < 3; ++c) sum(n, c) = f[c];
  }
};

/// f -> M^(-1/2) f, constrained directions taken out.
struct ToWeighted {
  NodeVector f;
  Array<const double*> mass;
  Array<const int*> constraint;             ///< row of the table, -1: free
  Array<const double* [3][3]> constraints;  ///< projections
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const double scale = 1 / std::sqrt(mass(n));
    const Vector3 a = projected(constraints, constraint(n), scale * row(f, n));
    for (int i = 0; i < 3; ++i) f(n, i) = a[i];
  }
};

}  // namespace railwave
