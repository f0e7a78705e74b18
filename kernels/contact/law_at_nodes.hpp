#pragma once

#include "kernels/contact/contact_normals.hpp"

namespace railwave {

/// What a law keeps of one node, while the law works on it.
template <class Law>
struct LawState {
  double values[Law::state_values > 0 ? Law::state_values : 1];

  /// @param all see ContactLawArrays
  KOKKOS_INLINE_FUNCTION static LawState of_node(const Array<const double*>& all, int slave_count, int s) {
    LawState state{};
    for (int k = 0; k < Law::state_values; ++k) state.values[k] = all(k * slave_count + s);
    return state;
  }
};

/// A law as the contact kernels use it: they hand it the numbers that it asks for, and its state.
/// @tparam Normals along which nodes press: see kernels/contact/contact_normals.hpp
template <class Law, class Normals>
struct LawAtNodes {
  static constexpr bool has_state = Law::state_values > 0;
  using State = LawState<Law>;

  /// What laws that have a state need besides.
  struct Arrays {
    Array<double*> state;       ///< see ContactLawArrays
    Array<const double*> mass;  ///< kg, by model node
  };
  struct Nothing {};

  Law law;
  std::conditional_t<has_state, Arrays, Nothing> arrays;

  KOKKOS_INLINE_FUNCTION State state_of(const ContactSearch& search, int s) const {
    if constexpr (has_state)
      return State::of_node(arrays.state, search.contact.slave_count, s);
    else
      return {};
  }
  KOKKOS_INLINE_FUNCTION void keep(const ContactSearch& search, int s, const State& state) const {
    if constexpr (has_state)
      for (int k = 0; k < Law::state_values; ++k) arrays.state(k * search.contact.slave_count + s) = state.values[k];
  }

  /// N/m, of the springs at a segment.
  KOKKOS_INLINE_FUNCTION double stiffness(const ContactSearch& search, int segment) const {
    return law.spring(search.contact.segment_stiffness(segment));
  }

  KOKKOS_INLINE_FUNCTION bool touches(const ContactSearch& search, const Projection& now, const State& state) const {
    if (now.segment < 0) return false;
    return law.touches({now.gap, stiffness(search, now.segment)}, state.values);
  }

  KOKKOS_INLINE_FUNCTION double pressing(const ContactSearch& search, const LastStep& last, int node,
                                         const Projection& now, double spring, State& state) const {
    return law.pressing(point(search, last, node, now, spring), state.values);
  }

  KOKKOS_INLINE_FUNCTION double friction_before(const State& state) const { return law.friction_before(state.values); }

  /// @param slid of the contact point over the master in the last step, what its spring took up left out, m
  KOKKOS_INLINE_FUNCTION double friction(const LastStep& last, const Vector3& slid, State& state) const {
    return law.friction({slid, last.elapsed}, state.values);
  }

  KOKKOS_INLINE_FUNCTION void part(const ContactSearch& search, const LastStep& last, int node, const Projection& now,
                                   State& state) const {
    law.part(point(search, last, node, now, 0), state.values);
  }

 private:
  KOKKOS_INLINE_FUNCTION ContactPoint point(const ContactSearch& search, const LastStep& last, int node,
                                            const Projection& now, double spring) const {
    ContactPoint result{now.gap, spring};
    if constexpr (has_state)
      if (law.asks_approach()) {
        result.elapsed = last.elapsed;
        if (now.segment >= 0) add_approach(search, last.velocity, node, now, result);
      }
    return result;
  }

  /// The contact as one mass that meets a wall: the slave's node, and the segment's nodes as the contact point feels
  /// them.
  KOKKOS_INLINE_FUNCTION void add_approach(const ContactSearch& search, const Array<const double* [3]>& velocity,
                                           int node, const Projection& now, ContactPoint& result) const {
    const ContactArrays& contact = search.contact;
    const Segment segment = contact.surface(now.segment);
    Vector3 relative = row(velocity, node);
    double inverse_mass = 1.0 / arrays.mass(node);
    for (int k = 0; k < 4; ++k) {
      const double share = segment_shape(k, now.place.xi, now.place.eta);
      relative = relative - share * row(velocity, contact.node_of(segment.node[k]));
      inverse_mass += share * share / arrays.mass(contact.node_of(segment.node[k]));
    }
    if constexpr (Normals::curved)
      relative = row(velocity, node) - Normals::carried(search, now.segment, now.place, velocity);
    result.approach = -dot(relative, now.normal);
    result.inverse_mass = inverse_mass;
  }
};

}  // namespace railwave
