#pragma once

#include "kernels/nodes/relative_nodes.hpp"
#include "kernels/support/team.hpp"

/// Ties between meshes that need not match. A slave node keeps its place over a face of the master,
///   x_s = sum N_k x_k + d n,
/// N the shape functions where it was projected at the start, n the face's unit normal there, d its distance. That is
/// objective, so the forces that do the same work, f_k = (dx_s / dx_k)^T f_s, keep linear and angular momentum.
namespace railwave {

/// Where a slave node is tied.
struct alignas(16) TiedPlace {
  int slave, face[4];  ///< model node numbers
  int unused;
  double distance;                   ///< m, d
  double weight[4];                  ///< N
  double slope_xi[4], slope_eta[4];  ///< of N

  template <class Values>
  KOKKOS_INLINE_FUNCTION Vector3 sum(const double (&factor)[4], const Values& values) const {
    Vector3 result{{0, 0, 0}};
    for (int k = 0; k < 4; ++k) result = result + factor[k] * row(values, face[k]);
    return result;
  }

  template <class Values>
  KOKKOS_INLINE_FUNCTION Vector3 place(const Values& position) const {
    const Vector3 foot = sum(weight, position);
    if (distance == 0) return foot;
    const Vector3 n = cross(sum(slope_xi, position), sum(slope_eta, position));
    return foot + (distance / norm(n)) * n;
  }
};

/// What a master node has of a slave.
struct alignas(16) TieShare {
  int slave, unused;
  double weight, slope_xi, slope_eta;  ///< of the node in the slave's face
};

struct TieArrays {
  int slave_count = 0, master_count = 0;
  Array<TiedPlace*> places;  ///< by slave
  Array<int*> master_nodes;
  Array<int*> master_rows;  ///< of the external forces
  Array<int*> first_share;  ///< master_count + 1
  Array<TieShare*> shares;
  Array<double* [9]> passed_on;  ///< N by slave: its force; what turns the face's normal, for slopes along xi and eta
  Array<double* [3]> before;     ///< m, where the slave is at the present instant

  KOKKOS_INLINE_FUNCTION bool active() const { return slave_count > 0; }
};

/// What a force on a slave is for its face: F; d (I - n n^T) F / |A|, crossed with the slopes of the face.
KOKKOS_INLINE_FUNCTION void pass_on(const TieArrays& ties, const Array<const double* [3]>& position, int s,
                                    const Vector3& force) {
  const TiedPlace tied = ties.places(s);
  Vector3 at_xi{{0, 0, 0}}, at_eta{{0, 0, 0}};
  if (tied.distance != 0) {
    const Vector3 along = tied.sum(tied.slope_xi, position), across = tied.sum(tied.slope_eta, position),
                  area = cross(along, across);
    const double size = norm(area);
    const Vector3 n = (1 / size) * area, t = (tied.distance / size) * (force - dot(n, force) * n);
    at_xi = cross(across, t);
    at_eta = cross(t, along);
  }
  for (int k = 0; k < 3; ++k) {
    ties.passed_on(s, k) = force[k];
    ties.passed_on(s, 3 + k) = at_xi[k];
    ties.passed_on(s, 6 + k) = at_eta[k];
  }
}

/// Takes the forces from the slaves, once all else has acted on them.
struct TieForce {
  TieArrays ties;
  NodalForce force;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    const int n = ties.places(s).slave;
    pass_on(ties, force.nodes.position, s, force(n));
    for (int k = 0; k < 3; ++k) ties.before(s, k) = force.nodes.position(n, k);
  }
};

/// Gives each master node its part of them, in fixed order.
struct TieGather {
  TieArrays ties;
  Array<const int*> target;  ///< by master: row of the sum
  Array<double* [3]> sum;    ///< N
  bool alone = false;        ///< nothing else has a part in these sums, and nobody has cleared them

  /// One team for each component of each master node: where the masters are coarse, they have many slaves.
  template <class Member>
  KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
    const int m = team.league_rank() / 3, k = team.league_rank() % 3;
    double total = 0;
    Kokkos::parallel_reduce(
        Kokkos::TeamThreadRange(team, ties.first_share(m), ties.first_share(m + 1)),
        [&](int i, double& part) {
          const TieShare share = ties.shares(i);
          part += share.weight * ties.passed_on(share.slave, k) + share.slope_xi * ties.passed_on(share.slave, 3 + k) +
                  share.slope_eta * ties.passed_on(share.slave, 6 + k);
        },
        total);
    if (team.team_rank() == 0) sum(target(m), k) = (alone ? 0.0 : sum(target(m), k)) + total;
  }
};

/// Brings the slaves where their faces have gone, with the velocity that does so.
struct TieFollow {
  TieArrays ties;
  NodeArrays nodes;
  double step;  ///< s

  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    const TiedPlace tied = ties.places(s);
    const Vector3 x = tied.place(nodes.position);
    for (int k = 0; k < 3; ++k) {
      nodes.velocity(tied.slave, k) = (x[k] - ties.before(s, k)) / step;
      nodes.position(tied.slave, k) = x[k];
    }
  }
};

/// The same where nodes are in single precision.
struct RelativeTieFollow {
  TieFollow in_double;
  RelativeArrays relative;
  Array<const int*> frame;  ///< by slave

  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    in_double(s);
    const int n = in_double.ties.places(s).slave;
    const FrameInstant& next = relative.frame(frame(s)).next;
    const Vector3 X = row(in_double.nodes.reference, n);
    const Vector3 d = row(in_double.nodes.position, n) - next.position(X),
                  w = row(in_double.nodes.velocity, n) - next.velocity_of(X);
    RelativeNode& own = relative.node(n);
    for (int k = 0; k < 3; ++k) {
      own.displacement[k] = static_cast<float>(d[k]);
      own.velocity[k] = static_cast<float>(w[k]);
    }
  }
};

/// Small motions of the slaves that go with those of the master, about the present places.
struct TieMotion {
  TieArrays ties;
  Array<const double* [3]> position;
  Array<double* [3]> motion;

  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    const TiedPlace tied = ties.places(s);
    Vector3 moved = tied.sum(tied.weight, motion);
    if (tied.distance != 0) {
      const Vector3 along = tied.sum(tied.slope_xi, position), across = tied.sum(tied.slope_eta, position),
                    area = cross(along, across);
      const double size = norm(area);
      const Vector3 n = (1 / size) * area;
      const Vector3 turned =
          cross(tied.sum(tied.slope_xi, motion), across) + cross(along, tied.sum(tied.slope_eta, motion));
      moved = moved + (tied.distance / size) * (turned - dot(n, turned) * n);
    }
    for (int k = 0; k < 3; ++k) motion(tied.slave, k) = moved[k];
  }
};

/// Forces on the slaves of such motions.
struct TieMotionForce {
  TieArrays ties;
  Array<const double*[3]> position, force;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    pass_on(ties, position, s, row(force, ties.places(s).slave));
  }
};

}  // namespace railwave
