#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "model/contact/contact_state.hpp"

namespace railwave {

/// A made-up elliptic contact whose every number is known: Hertzian pressure p0 sqrt(1 - x2/a2 - y2/b2), and the shear
/// of Vermeulen and Johnson along x: mu p less the same, shrunk by `stick` in length and height, at the leading edge.
struct HertzContact {
  double a = 6.5e-3, b = 5e-3;  ///< semi-axes along x and y, m
  double p0 = 1e9;              ///< Pa
  double friction = 0.4;
  double stick = 0.6;  ///< size of the stick ellipse over that of the patch
  double centre_x = 0, centre_y = 0;

  static double dome(double x, double y) {
    const double square = 1 - x * x - y * y;
    return square > 0 ? std::sqrt(square) : 0.0;
  }
  double pressure(double x, double y) const { return p0 * dome((x - centre_x) / a, (y - centre_y) / b); }
  bool sticks(double x, double y) const {
    return dome((x - centre_x - (1 - stick) * a) / (stick * a), (y - centre_y) / (stick * b)) > 0;
  }
  double shear(double x, double y) const {
    return friction * (pressure(x, y) -
                       stick * p0 * dome((x - centre_x - (1 - stick) * a) / (stick * a), (y - centre_y) / (stick * b)));
  }
  double normal_force() const { return 2.0 / 3.0 * M_PI * a * b * p0; }
  double creep_force() const { return friction * normal_force() * (1 - stick * stick * stick); }
  double area() const { return M_PI * a * b; }
};

/// A regular grid of nodes in the plane z = 0, from (x0, y0), `nx` by `ny` nodes at distances `dx` and `dy`, m.
struct HertzGrid {
  double x0 = -10e-3, y0 = -8e-3, dx = 1e-3, dy = 1e-3;
  int nx = 21, ny = 17;
};

/// How stresses become nodal forces.
enum class HertzForces {
  sampled,    ///< stress at the node times the node's area
  consistent  ///< integral of the stress times the node's bilinear shape function
};

/// The contact on a slave grid that looks down (the wheel) and a master grid that looks up (the rail), both the same.
inline ContactState hertz_contact_state(const HertzContact& hertz, const HertzGrid& grid, HertzForces forces) {
  ContactState state;
  state.name = "tread";
  state.friction = hertz.friction;
  const auto number = [&](int i, int j) { return j * grid.nx + i; };
  for (int j = 0; j + 1 < grid.ny; ++j) {
    for (int i = 0; i + 1 < grid.nx; ++i) {
      state.master.facets.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
      state.slave.facets.push_back({number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j)});
    }
  }
  const auto nodal = [&](double x, double y, double area, auto&& stress) {
    if (forces == HertzForces::sampled) return area * stress(x, y);
    constexpr int points = 40;  // a side of the square that the node's shape function covers
    double sum = 0;
    for (int q = 0; q < points; ++q)
      for (int p = 0; p < points; ++p) {
        const double u = 2 * (p + 0.5) / points - 1, v = 2 * (q + 0.5) / points - 1;
        sum += (1 - std::fabs(u)) * (1 - std::fabs(v)) * stress(x + u * grid.dx, y + v * grid.dy);
      }
    return sum * 4 / (points * points) * grid.dx * grid.dy;
  };
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const double x = grid.x0 + i * grid.dx, y = grid.y0 + j * grid.dy;
      const bool edge_x = i == 0 || i + 1 == grid.nx, edge_y = j == 0 || j + 1 == grid.ny;
      const double area = grid.dx * grid.dy * (edge_x ? 0.5 : 1) * (edge_y ? 0.5 : 1);
      const double normal = nodal(x, y, area, [&](double u, double v) { return hertz.pressure(u, v); });
      const double tangential = nodal(x, y, area, [&](double u, double v) { return hertz.shear(u, v); });
      const bool slips = normal > 0 && !hertz.sticks(x, y);
      for (ContactSide* side : {&state.slave, &state.master}) {
        const double sign = side == &state.slave ? 1 : -1;
        side->nodes.push_back(number(i, j) + (sign > 0 ? 0 : grid.nx * grid.ny));
        side->area.push_back(area);
        for (const double value : {x, y, 0.0}) side->position.push_back(value);
        for (const double value : {sign > 0 && slips ? -0.2 : 0.0, 0.0, 0.0}) side->velocity.push_back(value);
        for (const double value : {0.0, 0.0, -sign}) side->normal.push_back(value);
        for (const double value : {0.0, 0.0, sign * normal}) side->normal_force.push_back(value);
        for (const double value : {sign * tangential, 0.0, 0.0}) side->tangential_force.push_back(value);
      }
      state.gap.push_back(normal > 0                                                           ? -1e-6
                          : std::hypot(x - hertz.centre_x, y - hertz.centre_y) > 1.5 * hertz.a ? std::nan("")
                                                                                               : 1e-6);
      for (const double value : {slips ? -0.2 : normal > 0 ? -0.001 : 0.0, 0.0, 0.0})
        state.slip_velocity.push_back(value);
      state.slipping.push_back(normal > 0 ? (slips ? 2 : 1) : 0);
    }
  }
  return state;
}

}  // namespace railwave
