#pragma once

#include <vector>

#include "case/scene.hpp"
#include "kernels/boundaries/prescribed_motion.hpp"
#include "kernels/support/spaces.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

struct NodalState;

/// A node set that moves as a rigid motion says, in the directions that are prescribed. In the others forces move its
/// nodes, or another such set whose directions are perpendicular: then each has the work and the force along its own.
struct PrescribedSet {
  int number = 0;  ///< among the scene's prescribed motions
  const scene::PrescribedMotion* motion = nullptr;
  const scene::Curve* curve = nullptr;  ///< of the velocities; null: constant 1
  const scene::Curve* displacement_curve = nullptr;
  double held[3][3] = {};  ///< sum of d d^T over the prescribed directions d
  Vec3 centre{};           ///< m, of the rotation, undeformed
  Array<int*> nodes;
  std::vector<int> host_nodes;  ///< ascending
  Array<double*> work;          ///< J, by node of the set
  int first_alike = 0;  ///< number of the first set with common nodes, at once or by way of others; its own: none
  bool loaded = false;  ///< loads, ties or non-reflecting ends act on its nodes
  bool pushed = false;  ///< contact by multipliers does, on them or on those of a set with common nodes
};

/// Position and rotation of a set at a time: the integrals over time of velocity and angular velocity, both times their
/// curve, and the displacement times its own.
RigidPlace place_at(const PrescribedSet& set, double time);

/// The kernel that moves a set from the present instant by a step; and, with a step of 0, what its account needs.
/// @param step s
PrescribedMotion prescribed_motion(const NodalState& nodal, const PrescribedSet& set, double step);

/// How the set moves at the present instant: the derivatives of place_at(), at a kink or jump of a curve those of the
/// time before it.
PrescribedInstant prescribed_instant(const NodalState& nodal, const PrescribedSet& set);

}  // namespace railwave
