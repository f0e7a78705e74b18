#pragma once

#include "kernels/loads/set_loads.hpp"
#include "kernels/nodes/carrier.hpp"
#include "kernels/support/lanes.hpp"
#include "kernels/support/team.hpp"

namespace railwave {

/// Row i of a matrix times a vector given by its components.
KOKKOS_FORCEINLINE_FUNCTION float product(const Matrix3<float>& m, int i, float x, float y, float z) {
  return multiply_add(m(i, 0), x, multiply_add(m(i, 1), y, m(i, 2) * z));
}

/// State of a node as told from its carrier: 32 bytes, what memory delivers at once.
struct alignas(16) CarriedNode {
  float displacement[3];  ///< m, d at t_n
  float inverse_mass;     ///< 1/kg
  float velocity[3];      ///< m/s, w half a step before t_n
  float unused;
};

/// X - c_0 of a node or of a block's own point, m, and whose arm it is.
struct alignas(16) CarriedArm {
  float x[3];
  int carrier;
};

/// What a group's blocks need of nodes in single precision.
struct CarriedArrays {
  Array<CarriedNode*> node;
  Array<const float*> local;     ///< m, X - the block's point: by block and component, `node_stride` values each
  Array<const CarriedArm*> arm;  ///< by block, of its point
  Array<const CarrierStep*> steps;
  int first = 0;  ///< of the present step's carriers

  KOKKOS_FORCEINLINE_FUNCTION const CarrierStep& carrier(int c) const { return steps(first + c); }
};

/// NodeAdvance for nodes in single precision.
struct CarriedAdvance {
  CarriedArrays nodes;
  float gravity[3];     ///< m/s2
  float velocity_step;  ///< s
  float step;           ///< s

  KOKKOS_FORCEINLINE_FUNCTION void acceleration(float inverse_mass, const Vector3& force, float (&a)[3]) const {
    for (int i = 0; i < 3; ++i) a[i] = multiply_add(inverse_mass, static_cast<float>(force[i]), gravity[i]);
  }

  /// @param carrier_change by what the carrier's velocity changes for each arm, 1/s
  /// @param arm m
  KOKKOS_FORCEINLINE_FUNCTION CarriedNode move(int n, const float (&a)[3], const Matrix3<float>& carrier_change,
                                               const float (&arm)[3]) const {
    CarriedNode node = nodes.node(n);
    for (int i = 0; i < 3; ++i) {
      // The small changes first, so that one rounding is left to the large velocity.
      const float change = multiply_add(velocity_step, a[i], -product(carrier_change, i, arm[0], arm[1], arm[2]));
      node.velocity[i] += change;
      node.displacement[i] = multiply_add(step, node.velocity[i], node.displacement[i]);
    }
    if constexpr (on_device) {
      nodes.node(n) = node;
    } else {
      // A host had better not put the numbers together first.
      CarriedNode& own = nodes.node(n);
      for (int i = 0; i < 3; ++i) {
        own.displacement[i] = node.displacement[i];
        own.velocity[i] = node.velocity[i];
      }
    }
    return node;
  }
};

/// SharedNodeUpdate for nodes in single precision. Those that extra forces or constraints concern get their positions
/// and velocities in double precision too: contact, loads and connectors know no other.
struct CarriedSharedUpdate {
  NodalAcceleration acceleration;
  CarriedAdvance advance;
  Array<const SharedNode*> shared;
  Array<const CarriedArm*> arm;  ///< of each shared node
  RowLoads rows;
  bool rows_here;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const SharedNode node = shared(i);
    const CarriedArm own = arm(i);
    const NodeArrays& in_double = acceleration.force.nodes;
    const int n = node.node & ~special_bit;
    const bool special = node.node < 0;
    const CarrierStep& carrier = advance.nodes.carrier(own.carrier);
    const int r = special ? in_double.extra(n) : -1;
    if (rows_here && r >= 0 && rows.extra.loaded_of_row(r) >= 0) rows.gather<1>(rows.extra.loaded_of_row(r));
    float a[3];
    advance.acceleration(advance.nodes.node(n).inverse_mass, acceleration.force(node), a);
    if (special) {
      const Vector3 free = acceleration.constrain(n, {{a[0], a[1], a[2]}});
      for (int k = 0; k < 3; ++k) a[k] = static_cast<float>(free[k]);
    }
    const CarriedNode after = advance.move(n, a, carrier.change_at_start, own.x);
    if (special) {
      const Vector3 X = row(in_double.reference, n), x = carrier.next.position(X), v = carrier.next.velocity_of(X);
      for (int k = 0; k < 3; ++k) {
        in_double.position(n, k) = x[k] + static_cast<double>(after.displacement[k]);
        in_double.velocity(n, k) = v[k] + static_cast<double>(after.velocity[k]);
      }
    }
    if (r >= 0) acceleration.force.extra.clear_contact(r);
  }
};

/// Takes nodes first, first + 1, ... over from double precision.
struct TakeNodes {
  NodeArrays in_double;
  Array<CarriedNode*> node;
  CarrierInstant carrier;
  int first;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = first + k;
    const Vector3 X = row(in_double.reference, n);
    const Vector3 d = row(in_double.position, n) - carrier.position(X),
                  w = row(in_double.velocity, n) - carrier.velocity_of(X);
    CarriedNode taken;
    for (int i = 0; i < 3; ++i) {
      taken.displacement[i] = static_cast<float>(d[i]);
      taken.velocity[i] = static_cast<float>(w[i]);
    }
    taken.inverse_mass = static_cast<float>(1.0 / in_double.mass(n));
    taken.unused = 0;
    node(n) = taken;
  }
};

/// Gives them back, but for those that each step keeps in double precision anyway.
struct GiveNodes {
  NodeArrays in_double;
  Array<const CarriedNode*> node;
  CarrierInstant carrier;
  int first;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const {
    const int n = first + k;
    if (in_double.extra(n) >= 0 || in_double.constraint(n) >= 0) return;
    const CarriedNode own = node(n);
    const Vector3 X = row(in_double.reference, n), x = carrier.position(X), v = carrier.velocity_of(X);
    for (int i = 0; i < 3; ++i) {
      in_double.position(n, i) = x[i] + static_cast<double>(own.displacement[i]);
      in_double.velocity(n, i) = v[i] + static_cast<double>(own.velocity[i]);
    }
  }
};

}  // namespace railwave
