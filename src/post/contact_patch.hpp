#pragma once

#include "post/micro_slip.hpp"
#include "post/patch_shape.hpp"
#include "post/rigid_slip.hpp"

namespace railwave {

/// Touching nodes that hang together are a patch; with fewer than this number, a facet's corners, a small one.
inline constexpr int smallest_patch = 4;

/// One patch of contact at one instant, from the nodal forces of the slave surface (thesis 3.4). Forces and stresses
/// are those on the slave.
struct ContactPatch {
  std::vector<int> touching;           ///< slave nodes in contact: normal force above `contact_threshold`
  std::vector<double> pressure;        ///< Pa, of these
  std::vector<int> facets;             ///< those with a touching corner
  std::vector<int> surroundings;       ///< all corners of these
  std::vector<RelativeMotion> motion;  ///< of `surroundings`
  SlipRegions regions;                 ///< of `touching`

  LocalFrame frame;          ///< about the centre of the normal force
  double area_by_count = 0;  ///< m2, sum of the areas of the nodes in contact
  double area = 0;           ///< m2, inside the zero line of the pressure (post/patch_shape.hpp)
  EquivalentEllipse ellipse;
  double peak_nodal_pressure = 0;   ///< Pa, largest normal force of a node over the node's area
  double peak_facet_pressure = 0;   ///< Pa, largest mean of a facet (eq. 3.3)
  double peak_shear = 0;            ///< Pa, largest tangential force of a node over the node's area
  double peak_facet_shear = 0;      ///< Pa
  double peak_micro_slip = 0;       ///< m/s, of the touching nodes
  double normal_force = 0;          ///< N, size of the sum
  double creep_force = 0;           ///< N, longitudinal
  double lateral_force = 0;         ///< N
  double traction_coefficient = 0;  ///< tangential over normal force
  double slip_difference = 0;       ///< m/s, largest distance of the micro-slip found here from the run's own; NaN: the
                                    ///< results do not have that
  RigidSlip rigid_slip;

  /// Fewer nodes than that: such as chatter leaves at an edge, or a mesh too coarse for the contact.
  bool small() const { return touching.size() < smallest_patch; }
  /// m: the larger semi-axis of the ellipse; of a small patch, whose ellipse may be a point, no less than the radius of
  /// its nodes' areas.
  double size() const;
  /// m: the semi-axis along, likewise.
  double length() const;
};

/// What the user may choose.
struct PatchOptions {
  Vector rolling = Vector::UnitX();  ///< rolling direction
  CreepageRing ring;
};

/// Everything about one contact at one instant that the patches share. Keeps a reference to the state.
struct ContactSurfaces {
  explicit ContactSurfaces(const ContactState& contact_state);

  const ContactState& state;
  FacetsAroundNodes around_slave, around_master;
  SurfaceSearch master;
  TouchingNodes touching;
};

/// The patch of the touching nodes listed; all zero without nodes.
ContactPatch contact_patch(const ContactSurfaces& surfaces, const std::vector<int>& nodes, const PatchOptions& options);

/// Contact solution of one pair at one instant.
struct ContactSolution {
  ContactPatch whole;                 ///< of all touching nodes together
  std::vector<ContactPatch> patches;  ///< each alone, small ones too, the one with the largest normal force first
  int stray_nodes = 0;                ///< in small patches beside the others; without others, beside the largest
  double stray_force = 0;             ///< N, sum of their normal forces
};

ContactSolution contact_solution(const ContactState& state, const PatchOptions& options = {});

}  // namespace railwave
