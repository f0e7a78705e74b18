#pragma once

#include <cmath>

#include "kernels/contact/laws/contact_point.hpp"
#include "kernels/contact/laws/falling_friction.hpp"

namespace railwave {

/// A penalty spring that grows with penetration. Its stiffness over the segment's own is given by points, straight
/// lines between, constant beyond the last; its force and energy are the integrals of that.
struct PenaltyGrowth {
  /// At a penetration, of a spring of 1 N/m.
  struct Spring {
    double stiffness;  ///< tangent
    double force;      ///< m
    double energy;     ///< m2
  };

  /// From the first, which is at no penetration.
  struct Point {
    double depth;   ///< m
    double factor;  ///< of the stiffness
    double slope;   ///< 1/m, of the factor, to the next point
    double force;   ///< m
    double energy;  ///< m2
  };
  const Point* points;
  int count;

  KOKKOS_INLINE_FUNCTION Spring at(double depth) const {
    int k = 0;
    while (k + 1 < count && points[k + 1].depth <= depth) ++k;
    const double d = depth - points[k].depth, factor = points[k].factor, slope = points[k].slope,
                 force = points[k].force;
    return {factor + d * slope, force + d * (factor + 0.5 * d * slope),
            points[k].energy + d * (force + d * (0.5 * factor + d * slope / 6.0))};
  }
};

/// A penalty that grows with penetration, friction that falls with the speed of sliding, and a dashpot beside the
/// spring: each is there with its parameters, and none with those of the linear penalty.
struct GrowingPenalty {
  static constexpr int friction_state = 0;  ///< of the state: FallingFriction's
  static constexpr int damping_force =
      FallingFriction::state_values;                        ///< N, pressing, what damping adds to the penalty
  static constexpr int damping_energy = damping_force + 1;  ///< J dissipated so far
  static constexpr int state_values = damping_energy + 1;

  PenaltyGrowth growth;
  FallingFriction falling_friction;
  bool falling;    ///< friction falls
  double damping;  ///< share of critical damping; 0: none

  KOKKOS_INLINE_FUNCTION bool asks_approach() const { return damping != 0; }
  KOKKOS_INLINE_FUNCTION double spring(double stiffness) const { return stiffness; }
  KOKKOS_INLINE_FUNCTION bool touches(const ContactPoint& point, const double* /*state*/) const {
    return point.gap < 0;
  }

  /// The penalty spring's force and the dashpot's beside it; never a pull.
  KOKKOS_INLINE_FUNCTION double pressing(const ContactPoint& point, double* state) const {
    const PenaltyGrowth::Spring spring_now = growth.at(-point.gap);
    const double force = point.stiffness * spring_now.force;
    if (damping == 0) return force;
    const double dashpot = 2 * damping * std::sqrt(point.stiffness * spring_now.stiffness / point.inverse_mass);
    const double damped = std::fmax(0.0, force + dashpot * point.approach);
    book(point, damped - force, state);
    return damped;
  }

  KOKKOS_INLINE_FUNCTION double friction_before(const double* state) const {
    return falling ? state[friction_state + FallingFriction::now] : falling_friction.at_rest;
  }

  /// The force at t_n is bounded by the normal force at t_n and the coefficient of the movement up to t_n, and the
  /// coefficient that made the bound is kept beside the two forces: they are of one instant (thesis 5.3.2.3 shows what
  /// it is to mix instants).
  KOKKOS_INLINE_FUNCTION double friction(const Sliding& sliding, double* state) const {
    return falling ? falling_friction.coefficient(sliding, state + friction_state) : falling_friction.at_rest;
  }

  KOKKOS_INLINE_FUNCTION void part(const ContactPoint& point, double* state) const {
    if (falling) falling_friction.forget(state + friction_state);
    if (damping != 0) book(point, 0, state);
  }

  KOKKOS_INLINE_FUNCTION double stored(const ContactPoint& point, double /*normal_square*/,
                                       double tangential_square) const {
    return point.stiffness * growth.at(-point.gap).energy + 0.5 * tangential_square / point.stiffness;
  }
  KOKKOS_INLINE_FUNCTION double dissipated(const double* state) const { return state[damping_energy]; }

 private:
  /// What damping took since the instant before, by the trapezoidal rule over the way.
  KOKKOS_INLINE_FUNCTION static void book(const ContactPoint& point, double force, double* state) {
    state[damping_energy] += 0.5 * point.elapsed * point.approach * (state[damping_force] + force);
    state[damping_force] = force;
  }
};

}  // namespace railwave
