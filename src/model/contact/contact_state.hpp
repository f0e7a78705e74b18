#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

// Readers of results need no more of the modules than their names.
namespace railwave {

struct ContactPair;
struct NodalState;
struct Ties;

/// State of one contact pair at the present instant: one entry for every node of the slave surface and of the master
/// surface (not only those that touch), or for those near the contact. Vectors have three components, global axes.
/// Forces of a symmetric contact are those of both its halves; gap, slip velocity and whether a node slips are those of
/// the slave's nodes against the master's faces.
struct ContactSide {
  std::vector<int> nodes;                  ///< model node numbers
  std::vector<double> area;                ///< m2, a quarter of every facet around the node, present geometry
  std::vector<double> position;            ///< m
  std::vector<double> velocity;            ///< m/s
  std::vector<double> normal;              ///< unit outward normal of the surface at the node
  std::vector<double> normal_force;        ///< N, on this side, vector
  std::vector<double> tangential_force;    ///< N, on this side, vector
  std::vector<std::array<int, 4>> facets;  ///< positions in `nodes`, turned outwards
  std::vector<double> displacement = {};   ///< m; a made-up or read side may have none
  std::vector<int> places = {};            ///< of the nodes among those of the surface, ascending; a read side that
                                           ///< is whole may have none
};
struct ContactState {
  std::string name;
  double friction = 0;  ///< coefficient; at rest, where it falls with speed
  std::vector<double>
      friction_now;  ///< that which acts at each slave node, `friction` where it does not touch; empty where constant
  ContactSide slave;
  ContactSide master;
  std::vector<double> gap;  ///< m, of each slave node; negative: penetration; NaN where far from the master
  std::vector<double>
      slip_velocity;          ///< m/s, slave relative to master in the tangent plane at the contact point, 3 each
  std::vector<int> slipping;  ///< of each slave node: 0 no contact, 1 sticks, 2 slips

  /// The coefficient that bounds a slave node's tangential force.
  double friction_at(std::size_t slave_node) const {
    return friction_now.empty() ? friction : friction_now[slave_node];
  }
};

/// What is asked of a contact_state(). A run that writes thousands of them asks for what it writes.
struct ContactWish {
  std::optional<double> margin = {};  ///< m: only nodes within that distance of a box around those that touch, and the
                                      ///< facets between them; none where nothing touches. Absent: the whole surfaces
  bool slave = true, master = true;   ///< else that side has no nodes
  bool shape = true;                  ///< areas, positions, normals and facets
  bool gap = true;
};

ContactState contact_state(const NodalState& nodal, const Ties& ties, const std::vector<ContactPair>& contacts,
                           int contact, const ContactWish& wish = {});

/// Areas and unit normals at the nodes of a surface, from its facets as they lie.
struct SurfaceGeometry {
  std::vector<double> area;    ///< m2, a quarter of every facet around the node
  std::vector<double> normal;  ///< outwards, 3 of each node; not-a-number where no facet is around the node
};

/// @param position m, 3 of each node
/// @param facets positions of their corners among the nodes, turned outwards
SurfaceGeometry surface_geometry(const std::vector<double>& position, const std::vector<std::array<int, 4>>& facets);

}  // namespace railwave
