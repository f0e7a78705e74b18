#pragma once

#include "kernels/contact/contact_normals.hpp"
#include "kernels/contact/laws/growing_penalty.hpp"

namespace railwave {

/// What a pair keeps for its law.
struct ContactLawArrays {
  int number = 0;                       ///< of the law among `ContactLaws`, see src/model/contact/contact_law.hpp
  double damping = 0;                   ///< share of critical damping
  Array<PenaltyGrowth::Point*> growth;  ///< empty without
  Array<double*> state;                 ///< the law's state, value by value, each by slave node
};

/// What laws that have a state are brought to the nodes with.
struct LawSurroundings {
  Array<double*> state;               ///< value by value, each by slave node
  Array<const double* [3]> velocity;  ///< m/s, half a step back
  Array<const double*> mass;          ///< kg
  double elapsed = 0;                 ///< s since the instant before; 0: there is none, or time has no meaning
};

template <class Law>
inline constexpr bool has_surroundings = Law::state_values > 0;

/// A law as the contact kernels use it: it is told what it asks for, its state comes from the arrays and goes there.
/// @tparam Normals along which nodes press: see kernels/contact/contact_normals.hpp
template <class Law, class Normals>
struct LawAtNodes {
  struct Nothing {};
  Law law;
  std::conditional_t<has_surroundings<Law>, LawSurroundings, Nothing> around;

  /// A node's state while the law works on it.
  struct State {
    double values[Law::state_values > 0 ? Law::state_values : 1];
  };

  KOKKOS_INLINE_FUNCTION State state_of(const ContactSearch& search, int s) const {
    State state{};
    if constexpr (Law::state_values > 0)
      for (int k = 0; k < Law::state_values; ++k) state.values[k] = around.state(k * search.contact.slave_count + s);
    return state;
  }
  KOKKOS_INLINE_FUNCTION void keep(const ContactSearch& search, int s, const State& state) const {
    if constexpr (Law::state_values > 0)
      for (int k = 0; k < Law::state_values; ++k) around.state(k * search.contact.slave_count + s) = state.values[k];
  }

  /// N/m, of the springs at a segment.
  KOKKOS_INLINE_FUNCTION double stiffness(const ContactSearch& search, int segment) const {
    return law.spring(search.contact.segment_stiffness(segment));
  }

  KOKKOS_INLINE_FUNCTION bool touches(const ContactSearch& search, int s, const Projection& now) const {
    if (now.segment < 0) return false;
    return law.touches({now.gap, stiffness(search, now.segment)}, state_of(search, s).values);
  }

  KOKKOS_INLINE_FUNCTION double pressing(const ContactSearch& search, int s, int node, const Projection& now,
                                         double spring) const {
    State state = state_of(search, s);
    const double force = law.pressing(point(search, node, now, spring), state.values);
    keep(search, s, state);
    return force;
  }

  /// @param moved de of the contact point over the master since the instant before, m
  KOKKOS_INLINE_FUNCTION double friction(const ContactSearch& search, int s, const Vector3& moved) const {
    State state = state_of(search, s);
    double slip = 0;
    if constexpr (has_surroundings<Law>)
      if (around.elapsed > 0) slip = norm(moved) / around.elapsed;
    const double coefficient = law.friction(slip, state.values);
    keep(search, s, state);
    return coefficient;
  }

  KOKKOS_INLINE_FUNCTION void part(const ContactSearch& search, int s, int node, const Projection& now) const {
    State state = state_of(search, s);
    law.part(point(search, node, now, 0), state.values);
    keep(search, s, state);
  }

 private:
  KOKKOS_INLINE_FUNCTION ContactPoint point(const ContactSearch& search, int node, const Projection& now,
                                            double spring) const {
    ContactPoint result{now.gap, spring};
    if constexpr (has_surroundings<Law>)
      if (law.asks_approach()) {
        result.elapsed = around.elapsed;
        if (now.segment >= 0) add_approach(search, node, now, result);
      }
    return result;
  }

  /// The contact as one mass that meets a wall: the slave's node, and the segment's nodes as the contact point feels
  /// them.
  KOKKOS_INLINE_FUNCTION void add_approach(const ContactSearch& search, int node, const Projection& now,
                                           ContactPoint& result) const {
    const ContactArrays& contact = search.contact;
    const Segment segment = contact.surface(now.segment);
    Vector3 relative = row(around.velocity, node);
    double inverse_mass = 1.0 / around.mass(node);
    for (int k = 0; k < 4; ++k) {
      const double share = segment_shape(k, now.place.xi, now.place.eta);
      relative = relative - share * row(around.velocity, contact.node_of(segment.node[k]));
      inverse_mass += share * share / around.mass(contact.node_of(segment.node[k]));
    }
    if constexpr (Normals::curved)
      relative = row(around.velocity, node) - Normals::carried(search, now.segment, now.place, around.velocity);
    result.approach = -dot(relative, now.normal);
    result.inverse_mass = inverse_mass;
  }
};

}  // namespace railwave
