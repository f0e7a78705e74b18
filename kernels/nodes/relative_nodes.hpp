#pragma once

#include "kernels/nodes/corotating_frame.hpp"
#include "kernels/nodes/shared_nodes.hpp"
#include "kernels/support/lanes.hpp"
#include "kernels/support/team.hpp"

namespace railwave {

/// Row i of a matrix times a vector given by its components.
KOKKOS_FORCEINLINE_FUNCTION float product(const Matrix3<float>& m, int i, float x, float y, float z) {
  return multiply_add(m(i, 0), x, multiply_add(m(i, 1), y, m(i, 2) * z));
}

/// State of a node relative to its co-rotating frame: 32 bytes, what memory delivers at once.
struct alignas(16) RelativeNode {
  float displacement[3];  ///< m, d at t_n
  float inverse_mass;     ///< 1/kg
  float velocity[3];      ///< m/s, w half a step before t_n
  float unused;
};

/// X - c_0 of a node or of a block's own point, m, and whose arm it is.
struct alignas(16) FrameArm {
  float x[3];
  int frame;
};

/// What a group's blocks need of nodes in single precision.
struct RelativeArrays {
  Array<RelativeNode*> node;
  Array<const float*> local;   ///< m, X - the block's point: by block and component, `node_stride` values each
  Array<const FrameArm*> arm;  ///< by block, of its point
  Array<const FrameStep*> steps;
  int first = 0;  ///< of the present step's frames

  KOKKOS_FORCEINLINE_FUNCTION const FrameStep& frame(int c) const { return steps(first + c); }
};

/// NodeAdvance for nodes in single precision.
struct RelativeAdvance {
  RelativeArrays nodes;
  float gravity[3];     ///< m/s2
  float velocity_step;  ///< s
  float step;           ///< s

  KOKKOS_FORCEINLINE_FUNCTION void acceleration(float inverse_mass, const Vector3& force, float (&a)[3]) const {
    for (int i = 0; i < 3; ++i) a[i] = multiply_add(inverse_mass, static_cast<float>(force[i]), gravity[i]);
  }

  /// @param frame_change by what the frame's velocity changes for each arm, 1/s
  /// @param arm m
  KOKKOS_FORCEINLINE_FUNCTION RelativeNode move(int n, const float (&a)[3], const Matrix3<float>& frame_change,
                                                const float (&arm)[3]) const {
    RelativeNode node = nodes.node(n);
    for (int i = 0; i < 3; ++i) {
      // The small changes first, so that one rounding is left to the large velocity.
      const float change = multiply_add(velocity_step, a[i], -product(frame_change, i, arm[0], arm[1], arm[2]));
      node.velocity[i] += change;
      node.displacement[i] = multiply_add(step, node.velocity[i], node.displacement[i]);
    }
    if constexpr (on_device) {
      nodes.node(n) = node;
    } else {
      // A host had better not put the numbers together first.
      RelativeNode& own = nodes.node(n);
      for (int i = 0; i < 3; ++i) {
        own.displacement[i] = node.displacement[i];
        own.velocity[i] = node.velocity[i];
      }
    }
    return node;
  }
};

/// SharedNodeUpdate for nodes in single precision. Those that external forces or constraints concern get their
/// positions and velocities in double precision too: contact, loads and connectors know no other.
struct RelativeSharedUpdate {
  SharedForces forces;
  RelativeAdvance advance;
  Array<const FrameArm*> arm;  ///< of each shared node

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const SharedNode node = forces.shared.nodes(i);
    const SpecialNode special = forces.shared.special_of(i);
    const FrameArm own = arm(i);
    const NodeArrays& in_double = forces.acceleration.force.nodes;
    const int n = node.node & ~special_bit;
    const FrameStep& frame = advance.nodes.frame(own.frame);
    float a[3];
    advance.acceleration(advance.nodes.node(n).inverse_mass, forces(node, special), a);
    const Vector3 free = projected(forces.acceleration.constraints, special.constraint, {{a[0], a[1], a[2]}});
    for (int k = 0; k < 3; ++k) a[k] = static_cast<float>(free[k]);
    const RelativeNode after = advance.move(n, a, frame.change_at_start, own.x);
    if (node.node < 0) {
      const Vector3 X = row(in_double.reference, n), x = frame.next.position(X), v = frame.next.velocity_of(X);
      for (int k = 0; k < 3; ++k) {
        in_double.position(n, k) = x[k] + static_cast<double>(after.displacement[k]);
        in_double.velocity(n, k) = v[k] + static_cast<double>(after.velocity[k]);
      }
    }
    forces.clear_contact(special);
  }
};

/// PlainNodeUpdate for nodes in single precision.
struct RelativePlainUpdate {
  NodalForce force;
  Array<const SharedNode*> shared;
  RelativeAdvance advance;
  Array<const FrameArm*> arm;  ///< of each shared node

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const SharedNode node = shared(i);
    const FrameArm own = arm(i);
#ifdef RAILWAVE_SIMD_LANES
    if (i + prefetch_ahead < static_cast<int>(shared.extent(0))) {
      const SharedNode& later = shared(i + prefetch_ahead);
      prefetch(&advance.nodes.node(later.node));
      force.prefetch_partials(later);
    }
    const PartialForce<double> sum = force.with_all_partials<float>(node);
    const Vector3 f{{sum.x[0], sum.x[1], sum.x[2]}};
#else
    const NodalForce sum = force.with_partials_in<float>();
    const Vector3 f = sum.with_rows({{0, 0, 0}}, node, sum.first_rows(node));
#endif
    float a[3];
    advance.acceleration(advance.nodes.node(node.node).inverse_mass, f, a);
    advance.move(node.node, a, advance.nodes.frame(own.frame).change_at_start, own.x);
  }
};

/// Nodes of a frame, or of these the ones that a rank has.
struct FrameNodes {
  int first;
  Array<const int*> listed;  ///< empty: first, first + 1, ...; else the nodes there

  KOKKOS_INLINE_FUNCTION int operator()(int k) const { return listed.extent(0) > 0 ? listed(first + k) : first + k; }
};

/// Makes the relative coordinates from those in double precision.
struct MakeRelative {
  NodeArrays in_double;
  Array<RelativeNode*> node;
  FrameInstant frame;
  FrameNodes number;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = number(k);
    const Vector3 X = row(in_double.reference, n);
    const Vector3 d = row(in_double.position, n) - frame.position(X),
                  w = row(in_double.velocity, n) - frame.velocity_of(X);
    RelativeNode made;
    for (int i = 0; i < 3; ++i) {
      made.displacement[i] = static_cast<float>(d[i]);
      made.velocity[i] = static_cast<float>(w[i]);
    }
    made.inverse_mass = static_cast<float>(1.0 / in_double.mass(n));
    made.unused = 0;
    node(n) = made;
  }
};

/// The other way round, but for nodes that each step keeps in double precision anyway.
struct MakeAbsolute {
  NodeArrays in_double;
  Array<const RelativeNode*> node;
  FrameInstant frame;
  FrameNodes number;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = number(k);
    if (in_double.external_row(n) >= 0 || in_double.constraint(n) >= 0) return;
    const RelativeNode own = node(n);
    const Vector3 X = row(in_double.reference, n), x = frame.position(X), v = frame.velocity_of(X);
    for (int i = 0; i < 3; ++i) {
      in_double.position(n, i) = x[i] + static_cast<double>(own.displacement[i]);
      in_double.velocity(n, i) = v[i] + static_cast<double>(own.velocity[i]);
    }
  }
};

}  // namespace railwave
