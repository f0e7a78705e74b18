#include "post/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "post/facet.hpp"
#include "post/patch_shape.hpp"

namespace railwave {
namespace {

/// Pressure of the patch's own nodes, zero at all others.
std::vector<double> own_pressure(const TouchingNodes& touching, const std::vector<int>& nodes) {
  std::vector<double> pressure(touching.pressure.size(), 0.0);
  for (const int node : nodes) pressure[node] = touching.pressure[node];
  return pressure;
}

void find_forces(const ContactSide& slave, const std::vector<double>& pressure, const Vector& rolling,
                 ContactPatch& patch) {
  Vector normal_sum = Vector::Zero(), tangential_sum = Vector::Zero(), moment = Vector::Zero();
  std::vector<double> forces;
  double sum = 0;
  for (const int node : patch.touching) {
    const double force = pressure[node] * slave.area[node];
    normal_sum += entry(slave.normal_force, node);
    tangential_sum += entry(slave.tangential_force, node);
    moment += force * entry(slave.position, node);
    sum += force;
    forces.push_back(force);
    patch.pressure.push_back(pressure[node]);
    patch.area_by_count += slave.area[node];
    patch.peak_nodal_pressure = std::max(patch.peak_nodal_pressure, pressure[node]);
    patch.peak_shear = std::max(patch.peak_shear, entry(slave.tangential_force, node).norm() / slave.area[node]);
  }
  patch.frame = local_frame(moment / sum, normal_sum, rolling);
  patch.ellipse = equivalent_ellipse(slave, patch.touching, forces, patch.frame);
  patch.normal_force = normal_sum.norm();
  patch.creep_force = tangential_sum.dot(patch.frame.along);
  patch.lateral_force = tangential_sum.dot(patch.frame.across);
  patch.traction_coefficient = tangential_sum.norm() / patch.normal_force;
}

void find_facet_stress(const ContactSide& slave, const std::vector<double>& pressure, ContactPatch& patch) {
  for (const int facet : patch.facets) {
    const FacetStress stress = facet_stress(slave, facet, pressure);
    patch.peak_facet_pressure = std::max(patch.peak_facet_pressure, stress.pressure);
    patch.peak_facet_shear = std::max(patch.peak_facet_shear, stress.shear.norm());
  }
}

/// Relative motion of the nodes. Where the results lack the motion of one of the surfaces, the run's own slip velocity
/// of touching nodes stands for it, and how fast they part is not known.
std::vector<RelativeMotion> motion_of(const ContactSurfaces& surfaces, const std::vector<int>& nodes) {
  const ContactState& state = surfaces.state;
  if (!state.slave.velocity.empty() && !state.master.velocity.empty())
    return relative_motion(state.slave, nodes, state.master, surfaces.master);
  std::vector<RelativeMotion> motions(nodes.size());
  if (state.slip_velocity.empty()) return motions;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (surfaces.touching.has(nodes[i]))
      motions[i] = {true, entry(state.slip_velocity, nodes[i]), std::numeric_limits<double>::quiet_NaN()};
  return motions;
}

void find_slip(const ContactSurfaces& surfaces, ContactPatch& patch) {
  const ContactState& state = surfaces.state;
  patch.motion = motion_of(surfaces, patch.surroundings);
  std::vector<double> micro_slip;
  if (state.slip_velocity.empty()) patch.slip_difference = std::numeric_limits<double>::quiet_NaN();
  for (const int node : patch.touching) {
    const auto place =
        std::lower_bound(patch.surroundings.begin(), patch.surroundings.end(), node) - patch.surroundings.begin();
    const RelativeMotion& motion = patch.motion[place];
    micro_slip.push_back(motion.known ? motion.slip.norm() : std::numeric_limits<double>::quiet_NaN());
    if (!motion.known) continue;
    patch.peak_micro_slip = std::max(patch.peak_micro_slip, motion.slip.norm());
    if (!state.slip_velocity.empty())
      patch.slip_difference = std::max(patch.slip_difference, (motion.slip - entry(state.slip_velocity, node)).norm());
  }
  patch.regions = slip_regions(state, patch.touching, micro_slip);
}

double normal_force_of(const ContactSurfaces& surfaces, const std::vector<int>& nodes) {
  double sum = 0;
  for (const int node : nodes) sum += surfaces.touching.pressure[node] * surfaces.state.slave.area[node];
  return sum;
}

}  // namespace

double ContactPatch::size() const { return std::max(length(), ellipse.semi_axis_across); }

double ContactPatch::length() const {
  return small() ? std::max(ellipse.semi_axis_along, std::sqrt(area_by_count / M_PI)) : ellipse.semi_axis_along;
}

ContactSurfaces::ContactSurfaces(const ContactState& contact_state)
    : state(contact_state),
      around_slave(state.slave),
      around_master(state.master),
      master(state.master, around_master),
      touching(touching_nodes(state.slave)) {}

ContactPatch contact_patch(const ContactSurfaces& surfaces, const std::vector<int>& nodes,
                           const PatchOptions& options) {
  const ContactSide& slave = surfaces.state.slave;
  ContactPatch patch;
  patch.touching = nodes;
  if (nodes.empty()) return patch;
  const std::vector<double> pressure = own_pressure(surfaces.touching, nodes);
  patch.facets = facets_around(surfaces.around_slave, nodes);
  patch.surroundings = nodes_of_facets(slave, patch.facets);
  find_forces(slave, pressure, options.rolling, patch);
  find_facet_stress(slave, pressure, patch);
  patch.area = patch_area(slave, surfaces.around_slave, pressure);
  find_slip(surfaces, patch);
  patch.rigid_slip = rigid_slip(surfaces.state, patch.frame, patch.size(), options.ring);
  return patch;
}

ContactSolution contact_solution(const ContactState& state, const PatchOptions& options) {
  const ContactSurfaces surfaces(state);
  ContactSolution solution;
  solution.whole = contact_patch(surfaces, surfaces.touching.nodes, options);
  std::vector<std::vector<int>> parts = connected_nodes(state.slave, surfaces.around_slave, surfaces.touching);
  std::stable_sort(parts.begin(), parts.end(), [&](const auto& one, const auto& other) {
    return normal_force_of(surfaces, one) > normal_force_of(surfaces, other);
  });
  const auto large = [](const std::vector<int>& nodes) { return nodes.size() >= smallest_patch; };
  const bool any_large = std::any_of(parts.begin(), parts.end(), large);
  for (const std::vector<int>& nodes : parts) {
    const bool stray = !large(nodes) && (any_large || !solution.patches.empty());
    solution.patches.push_back(parts.size() == 1 ? solution.whole : contact_patch(surfaces, nodes, options));
    if (!stray) continue;
    solution.stray_nodes += static_cast<int>(nodes.size());
    solution.stray_force += normal_force_of(surfaces, nodes);
  }
  return solution;
}

}  // namespace railwave
