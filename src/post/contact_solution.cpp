#include "post/contact_solution.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "output/contact_section.hpp"
#include "post/patch_area.hpp"

namespace railwave {
namespace {

using Vector = Eigen::Vector3d;

Vector entry(const std::vector<double>& vectors, std::size_t i) { return Vector(vectors.data() + 3 * i); }

/// The global axis `axis` turned into the plane across `normal`; zero if it stands across that plane.
Vector in_plane(int axis, const Vector& normal) {
  Vector direction = Vector::Unit(axis) - normal[axis] * normal;
  const double length = direction.norm();
  return length > 1e-6 ? Vector(direction / length) : Vector::Zero();
}

double peak_facet_pressure(const ContactSide& side, const std::vector<double>& pressure) {
  double peak = 0;
  for (const auto& facet : side.facets) {
    double force = 0, area = 0;
    for (const int corner : facet) {
      force += pressure[corner] * side.area[corner];
      area += side.area[corner];
    }
    if (area > 0) peak = std::max(peak, force / area);
  }
  return peak;
}

}  // namespace

ContactSolution contact_solution(const ContactState& state) {
  const ContactSide& slave = state.slave;
  ContactSolution result;
  std::vector<double> pressure = nodal_pressure(slave);
  Vector normal_sum = Vector::Zero(), tangential_sum = Vector::Zero(), moment = Vector::Zero();
  double scalar_sum = 0, largest_tangential = 0;
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    const double normal_force = pressure[i] * slave.area[i];
    if (!(normal_force > contact_threshold)) {
      pressure[i] = 0;
      continue;
    }
    touching.push_back(i);
    const double tangential_force = entry(slave.tangential_force, i).norm();
    normal_sum += entry(slave.normal_force, i);
    tangential_sum += entry(slave.tangential_force, i);
    moment += normal_force * entry(slave.position, i);
    scalar_sum += normal_force;
    largest_tangential = std::max(largest_tangential, tangential_force);
    result.area_by_count += slave.area[i];
    result.peak_nodal_pressure = std::max(result.peak_nodal_pressure, pressure[i]);
    result.peak_shear = std::max(result.peak_shear, tangential_force / slave.area[i]);
  }
  result.nodes = static_cast<int>(touching.size());
  if (touching.empty()) return result;

  for (const std::size_t i : touching) {
    const double bound = state.friction * pressure[i] * slave.area[i];
    if (bound - entry(slave.tangential_force, i).norm() < slip_force_tolerance * largest_tangential) ++result.slipping_by_force;
    if (entry(state.slip_velocity, i).norm() > slip_velocity_tolerance) ++result.slipping_by_velocity;
    if (state.slipping[i] == 2) ++result.slipping_by_solver;
  }
  result.peak_facet_pressure = peak_facet_pressure(slave, pressure);
  result.area = patch_area(slave, pressure);
  result.normal_force = normal_sum.norm();
  const Vector normal = normal_sum.normalized();
  result.creep_force = tangential_sum.dot(in_plane(0, normal));
  result.lateral_force = tangential_sum.dot(in_plane(1, normal));
  result.traction_coefficient = tangential_sum.norm() / result.normal_force;
  for (int c = 0; c < 3; ++c) {
    result.centre[c] = moment[c] / scalar_sum;
    result.normal[c] = normal[c];
  }
  return result;
}

}  // namespace railwave
