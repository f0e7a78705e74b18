#pragma once

#include "kernels/contact_normals.hpp"

namespace railwave {

/// The law of most pairs: a linear penalty (thesis eq. 2.26c) and a constant coefficient of friction.
struct PlainContactLaw {
  /// N/m, of the spring at a segment.
  KOKKOS_INLINE_FUNCTION double stiffness(const ContactArrays& contact, int segment) const {
    return contact.segment_stiffness(segment);
  }
  KOKKOS_INLINE_FUNCTION bool apart(const ContactArrays& /*contact*/, int /*s*/, const Projection& now) const {
    return !(now.gap < 0);
  }
  KOKKOS_INLINE_FUNCTION double pressing(const ContactArrays& /*contact*/, int /*s*/, int /*node*/,
                                         const Projection& now, double stiffness) const {
    return -now.gap * stiffness;
  }
  KOKKOS_INLINE_FUNCTION double friction(const ContactArrays& contact, int /*s*/, const Vector3& /*moved*/) const {
    return contact.friction;
  }
  KOKKOS_INLINE_FUNCTION void part(const ContactArrays& /*contact*/, int /*s*/, int /*node*/,
                                   const Projection& /*now*/) const {}
};

/// A penalty spring that grows with penetration. Its stiffness over the segment's own is given by points, straight
/// lines between, constant beyond the last; its force and energy are the integrals of that.
struct PenaltyGrowth {
  /// At a penetration, of a spring of 1 N/m.
  struct Spring {
    double stiffness;  ///< tangent
    double force;      ///< m
    double energy;     ///< m2
  };

  /// From the first, which is at no penetration: penetration (m), factor, its slope to the next point (1/m), force,
  /// energy.
  Array<const double* [5]> points;

  KOKKOS_INLINE_FUNCTION Spring at(double depth) const {
    int k = 0;
    while (k + 1 < static_cast<int>(points.extent(0)) && points(k + 1, 0) <= depth) ++k;
    const double d = depth - points(k, 0), factor = points(k, 1), slope = points(k, 2), force = points(k, 3);
    return {factor + d * slope, force + d * (factor + 0.5 * d * slope),
            points(k, 4) + d * (force + d * (0.5 * factor + d * slope / 6.0))};
  }
};

/// What a pair whose law is not the plain one has besides.
struct ContactLawArrays {
  bool active = false;  ///< false: PlainContactLaw, and all else is empty
  PenaltyGrowth growth;
  double dynamic_friction = 0, friction_decay = 0;  ///< mu_d; c, s/m: 0 where friction is constant
  double damping = 0;                               ///< share of critical damping

  /// By slave node.
  Array<double*> friction_now;    ///< coefficient that acts; empty where friction is constant
  Array<double*> damping_force;   ///< N, pressing, what damping adds to the penalty; empty without damping, as the next
  Array<double*> damping_energy;  ///< J dissipated so far
};

/// Any law, at one instant.
struct ContactLaw {
  ContactLawArrays arrays;
  Array<const double* [3]> velocity;  ///< m/s, half a step back
  Array<const double*> mass;          ///< kg
  double damping;                     ///< share of critical damping now: none while a scene settles
  double elapsed;                     ///< s since the instant before; 0: there is none, or time has no meaning
  Array<const double* [3]> position;  ///< m, of a pair with smooth normals; empty otherwise

  KOKKOS_INLINE_FUNCTION double stiffness(const ContactArrays& contact, int segment) const {
    return contact.segment_stiffness(segment);
  }
  KOKKOS_INLINE_FUNCTION bool apart(const ContactArrays& /*contact*/, int /*s*/, const Projection& now) const {
    return !(now.gap < 0);
  }

  /// The penalty spring's force and the dashpot's beside it; never a pull.
  KOKKOS_INLINE_FUNCTION double pressing(const ContactArrays& contact, int s, int node, const Projection& now,
                                         double stiffness) const {
    const PenaltyGrowth::Spring spring = arrays.growth.at(-now.gap);
    const double force = stiffness * spring.force;
    if (damping == 0) return force;
    const Approach approach = approach_of(contact, node, now);
    const double coefficient = 2 * damping * std::sqrt(stiffness * spring.stiffness / approach.inverse_mass);
    const double damped = std::fmax(0.0, force + coefficient * approach.speed);
    book(s, damped - force, approach.speed);
    return damped;
  }

  /// Falling friction, thesis eqs. 2.29: mu_d + (mu_s - mu_d) exp(-c |u|), u = de / dt. The force at t_n is bounded by
  /// the normal force at t_n and the coefficient of the movement from t_(n-1) to t_n, and the coefficient that made the
  /// bound is kept beside the two forces: they are of one instant (thesis 5.3.2.3 shows what it is to mix instants).
  /// @param moved de of the contact point over the master since the instant before, m
  KOKKOS_INLINE_FUNCTION double friction(const ContactArrays& contact, int s, const Vector3& moved) const {
    if (arrays.friction_now.extent(0) == 0) return contact.friction;
    const double speed = elapsed > 0 ? norm(moved) / elapsed : 0.0;
    const double extra = contact.friction - arrays.dynamic_friction;
    const double now = arrays.dynamic_friction + extra * std::exp(-arrays.friction_decay * speed);
    arrays.friction_now(s) = now;
    return now;
  }

  KOKKOS_INLINE_FUNCTION void part(const ContactArrays& contact, int s, int node, const Projection& now) const {
    if (arrays.friction_now.extent(0) != 0) arrays.friction_now(s) = contact.friction;
    if (damping == 0) return;
    book(s, 0, now.segment < 0 ? 0.0 : approach_of(contact, node, now).speed);
  }

 private:
  /// The contact as one mass that meets a wall.
  struct Approach {
    double speed;         ///< m/s, positive: they near each other
    double inverse_mass;  ///< 1/kg, of the slave's node and of the segment's nodes as the contact point feels them
  };

  KOKKOS_INLINE_FUNCTION Approach approach_of(const ContactArrays& contact, int node, const Projection& now) const {
    const Segment segment = contact.surface(now.segment);
    Vector3 relative = row(velocity, node);
    double inverse_mass = 1.0 / mass(node);
    for (int k = 0; k < 4; ++k) {
      const double share = segment_shape(k, now.place.xi, now.place.eta);
      relative = relative - share * row(velocity, contact.node_of(segment.node[k]));
      inverse_mass += share * share / mass(contact.node_of(segment.node[k]));
    }
    if (position.extent(0) != 0)
      relative = row(velocity, node) -
                 SmoothNormals::carried(ContactSearch{{contact, position}}, now.segment, now.place, velocity);
    return {-dot(relative, now.normal), inverse_mass};
  }

  /// What damping took since the instant before, by the trapezoidal rule over the way.
  KOKKOS_INLINE_FUNCTION void book(int s, double force, double speed) const {
    arrays.damping_energy(s) += 0.5 * elapsed * speed * (arrays.damping_force(s) + force);
    arrays.damping_force(s) = force;
  }
};

}  // namespace railwave
