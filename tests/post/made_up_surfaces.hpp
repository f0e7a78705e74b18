#pragma once

#include <cmath>

#include "post/field_vectors.hpp"

namespace railwave {

/// A surface of nx by ny nodes at place(i, j), that looks to +z (the rail) or to -z (the wheel), at rest and free of
/// forces. Areas and normals are found as for a run's.
template <class Place>
ContactSide made_up_side(int nx, int ny, bool looks_up, Place place) {
  ContactSide side;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      side.nodes.push_back(j * nx + i);
      const Vector point = place(i, j);
      side.position.insert(side.position.end(), {point[0], point[1], point[2]});
    }
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = j * nx + i, b = a + 1, c = a + nx + 1, d = a + nx;
      side.facets.push_back(looks_up ? std::array<int, 4>{a, b, c, d} : std::array<int, 4>{a, d, c, b});
    }
  const std::size_t count = side.nodes.size();
  side.area.assign(count, 0);
  for (auto* vectors : {&side.velocity, &side.normal, &side.normal_force, &side.tangential_force})
    vectors->assign(3 * count, 0);
  for (const auto& f : side.facets) {
    const Vector twice = (entry(side.position, f[2]) - entry(side.position, f[0]))
                             .cross(entry(side.position, f[3]) - entry(side.position, f[1]));
    for (const int corner : f) {
      side.area[corner] += 0.125 * twice.norm();
      for (int c = 0; c < 3; ++c) side.normal[3 * corner + c] += twice[c];
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vector normal = entry(side.normal, i).normalized();
    for (int c = 0; c < 3; ++c) side.normal[3 * i + c] = normal[c];
  }
  return side;
}

/// Sets an array of vectors to what `value` says of each node's place.
template <class Value>
void set_vectors(const ContactSide& side, std::vector<double>& vectors, Value value) {
  for (std::size_t i = 0; i < side.nodes.size(); ++i) {
    const Vector v = value(entry(side.position, i));
    for (int c = 0; c < 3; ++c) vectors[3 * i + c] = v[c];
  }
}

/// Nodal forces of a pressure, Pa, and a shear, Pa, sampled at the nodes.
template <class Pressure, class Shear>
void press(ContactSide& side, Pressure pressure, Shear shear) {
  for (std::size_t i = 0; i < side.nodes.size(); ++i) {
    const Vector place = entry(side.position, i), normal = -side.area[i] * pressure(place) * entry(side.normal, i);
    const Vector tangential = side.area[i] * shear(place);
    for (int c = 0; c < 3; ++c) {
      side.normal_force[3 * i + c] = normal[c];
      side.tangential_force[3 * i + c] = tangential[c];
    }
  }
}

/// Both surfaces as one contact, of which the run found nothing yet.
inline ContactState made_up_state(ContactSide slave, ContactSide master, double friction) {
  ContactState state;
  state.name = "tread";
  state.friction = friction;
  const std::size_t count = slave.nodes.size();
  state.slave = std::move(slave);
  state.master = std::move(master);
  state.gap.assign(count, 0);
  state.slip_velocity.assign(3 * count, 0);
  state.slipping.assign(count, 0);
  return state;
}

/// Cells that grow towards one side, on mesh lines that meet at 70 degrees and wave: no two facets alike, none a
/// rectangle.
inline Vector skewed_place(int i, int j, double cell) {
  const double along = cell * i * (1 + 0.01 * i), across = cell * j * (1 + 0.015 * j);
  return {along + 0.34 * across + 0.15 * cell * std::sin(0.9 * j), 0.94 * across + 0.15 * cell * std::sin(0.7 * i), 0};
}

}  // namespace railwave
