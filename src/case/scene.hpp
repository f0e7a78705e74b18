#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "case/scene_bodies.hpp"
#include "case/scene_meshes.hpp"
#include "case/scene_run.hpp"
#include "case/scene_track.hpp"
#include "case/surface_names.hpp"

/// What a case file says, read and checked: plain host structs in SI units, in the file's order. Meshes, bodies,
/// tracks and how it is run are in headers of their own.
/// Names that refer to other entries have been checked to exist; names of sets inside a mesh (`part.set`) are resolved
/// when the model is built, because a mesh may come from a file.
namespace railwave::scene {

using Box = std::array<Vec3, 2>;  ///< lowest and highest corner

/// The entry of that name, or null.
template <class Entry>
const Entry* find_entry(const std::vector<Entry>& entries, const std::string& name) {
  for (const Entry& entry : entries)
    if (entry.name == name) return &entry;
  return nullptr;
}

/// A crack in a mesh: nodes doubled on a plane across the rail, its two faces surfaces NAME_before and NAME_behind.
struct Seam : Place {
  std::string mesh;
  Vec3 place{0, 0, 0};  ///< m, middle of its mouth on the mesh's upper surface
  double length = 0;    ///< m, along y
  double depth = 0;     ///< m, along its plane
  double angle = 0;     ///< rad from the vertical, positive: deeper parts lie farther along x
  double width = 0;     ///< m, between its faces, square to its plane
};

/// Nodes of a part picked by where they are, as `part.NAME`: those in a box, or those near a position.
struct NodeSet : Place {
  std::string part;
  std::string surface;           ///< of the part; empty: any node
  std::optional<Box> box;        ///< m, of the scene, before close_gap
  std::optional<Vec3> position;  ///< m; instead of a box
  double radius = 0;             ///< m, about the position; the nearest node is in the set however far it is
};

/// Elements of a part picked by where they are, as `part.NAME`: those whose centre is in a box, or near a position.
struct ElementSet : Place {
  std::string part;
  std::string surface;           ///< of the part: only elements with a face in it; empty: any element
  std::optional<Box> box;        ///< m, of the scene, before close_gap
  std::optional<Vec3> position;  ///< m; instead of a box: the element that it lies in, and those around
  double radius = 0;             ///< m, about the position
};

/// A blow on a surface: becomes a node set `part.NAME`, a load and a history set of that name.
struct Hammer : Place {
  std::string part;
  std::string surface;       ///< of the part; empty: any node
  Vec3 position{0, 0, 0};    ///< m, middle of the struck patch
  double radius = 0;         ///< m, of the patch; 0: the nearest node
  Vec3 direction{0, 0, -1};  ///< of the force
  double peak = 0;           ///< N
  double start = 0;          ///< s
  double duration = 0;       ///< s, of the half sine
  std::string curve;         ///< measured shape instead of the half sine; empty: none
};

/// A place whose history is written: becomes a node set where its motion is asked for, an element set where stress or
/// strain is, and a history set `part.NAME`; or a row of them, `part.NAME_1` and so on.
struct Probe : Place {
  std::string part;
  std::string surface;     ///< of the part; empty: any node
  Vec3 position{0, 0, 0};  ///< m, of the first
  double radius = 0;       ///< m; 0: the nearest node
  int count = 1;
  Vec3 spacing{0, 0, 0};  ///< m, from one to the next
  std::vector<std::string> quantities{"displacement", "velocity",
                                      "acceleration"};  ///< names of case/field_table.hpp that serve histories
};

enum class CurveType { constant, cosine_ramp, table, half_sine };

struct Curve : Place {
  CurveType type = CurveType::constant;
  double start = 0;     ///< s, cosine_ramp, half_sine: zero before
  double duration = 0;  ///< s, cosine_ramp: 1 after start + duration (thesis eq. 3.2); half_sine: zero after
  std::vector<std::array<double, 2>> points;  ///< table: (time, value), linear between, constant beyond
  std::string file;  ///< table: CSV of these (already joined to the case file's folder); empty: given in the case
};

enum class LoadType { nodal_force, pressure, traction, torque };

struct Load : Place {
  LoadType type = LoadType::nodal_force;
  std::string target;   ///< `part.node_set` or a point mass (nodal_force), `part.node_set` or a point where beams end
                        ///< (torque), `part.surface` (pressure, traction)
  Vec3 force{0, 0, 0};  ///< nodal_force: total, shared by mass over the set, N
  double pressure = 0;  ///< Pa, positive pushes into the body, follows the surface
  Vec3 traction{0, 0, 0};  ///< Pa, fixed direction and reference area
  double moment = 0;       ///< N m about axis through the set's moving centre of mass
  Vec3 axis{0, 1, 0};
  std::string curve;  ///< empty: constant 1
};

/// Linear spring and dashpot in parallel in each direction between the mean motions of two node sets (or point masses).
struct Connector : Place {
  std::string from;  ///< `part.node_set`, a point mass, or "ground"
  std::string to;
  Vec3 stiffness{0, 0, 0};  ///< N/m along the axes
  Vec3 damping{0, 0, 0};    ///< N s/m
  Vec3 preload{0, 0, 0};    ///< force on `to` at zero relative displacement, N, along the global axes
  std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<int, 2> spread{
      0, 0};                ///< cells along axes[0] and axes[1] of an area shared by two facing surfaces; 0: not spread
  std::optional<Box> area;  ///< m, bounds of that area; absent: where the ends overlap
};

enum class BeamSection { circle, rectangle };

/// Straight elastic beams from one node to one or several others.
struct Beam : Place {
  std::string from;  ///< a point mass or a `part.node_set` of one node
  std::string to;    ///< a point mass or a `part.node_set`
  std::string material;
  BeamSection section = BeamSection::circle;
  double radius = 0;  ///< m, circle
  double width = 0;   ///< m, rectangle, across orientation
  double height = 0;  ///< m, rectangle, along orientation
  std::optional<Vec3>
      orientation;  ///< normal of the plane in which beams are spread; absent: the global axis most across the beam
  std::optional<int> count;          ///< beams, spread evenly around `from`; absent: one to each node of `to`
  int divisions = 1;                 ///< elements of each beam
  std::optional<double> pretension;  ///< N, axial force in equilibrium; absent: the beam is stress-free as it lies
};

struct Constraint : Place {
  std::string target;                                       ///< `part.node_set` or a point mass
  std::array<bool, 3> fixed{false, false, false};           ///< along axes[0], axes[1], axes[2]
  std::array<bool, 3> fixed_rotation{false, false, false};  ///< about them, where beams end
  std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

enum class ContactAlgorithm { penalty, multiplier, automatic };
enum class ContactNormals { facet, smooth };

/// m: cracks, slots and gaps in a master as wide as this are crossed, but none wider than four of the slave's smallest
/// faces; those as wide as one always.
inline constexpr double usual_bridged_gap = 1e-3;

/// s: of friction that falls with the speed of sliding; docs/contact.md has what contacts of rail and wheel need.
inline constexpr double usual_friction_memory = 4e-5;

struct Contact : Place {
  std::string slave;                       ///< `part.surface`
  SurfaceNames master;                     ///< `part.surface`; several are one surface
  double friction = 0;                     ///< Coulomb coefficient, at rest where it falls with the sliding speed
  std::optional<double> dynamic_friction;  ///< at high speed, mu_d of thesis eq. 2.29
  double friction_decay = 0;               ///< c of thesis eq. 2.29, s/m; 0: friction is constant
  double friction_memory = usual_friction_memory;            ///< s, see kernels/contact/laws/falling_friction.hpp
  ContactAlgorithm algorithm = ContactAlgorithm::automatic;  ///< the model makes that one of the two
  /// Of one that was automatic: why it became penalty, or "" for multipliers; see model/checks/choose_algorithm.cpp.
  std::optional<std::string> algorithm_reason;
  ContactNormals normals = ContactNormals::facet;  ///< of the master, along which it presses
  int sweeps = 2;                                  ///< of the multipliers' iteration, in a step
  double penalty_scale = 1.0;                      ///< f_SI of thesis eq. 2.26d
  std::vector<std::array<double, 2>>
      penalty_growth;      ///< (penetration in m, factor on the spring's tangent stiffness); empty: linear
  double damping = 0;      ///< share of critical damping of the contact spring and the masses that it joins
  bool symmetric = false;  ///< the master's nodes against the slave's faces as well, each with half the stiffness
  std::optional<double> bridged_gap;  ///< m, widest crack, slot or gap in the master that is crossed as if closed;
                                      ///< absent: see usual_bridged_gap
  std::optional<Vec3> close_gap;  ///< the slave's part is moved along this direction until first touch, before the run
  double zone_lateral_start = 0, zone_lateral_end = 0;  ///< m, for ZoneBand::contact: how far the wheel moves along y
  double zone_roll = 0;                                 ///< rad, its axle's about x, likewise
  double zone_margin = 0.004;                           ///< m, of the band beyond where the profiles meet

  bool falling_friction() const { return friction_decay > 0; }
};

struct InitialMotion : Place {
  std::vector<std::string> parts;  ///< parts and point masses
  Vec3 velocity{0, 0, 0};
  Vec3 angular_velocity{0, 0, 0};  ///< rad/s
  bool rolling =
      false;  ///< the angular velocity is the one that rolls; the model fills it in, see model/contact/rolling.hpp
  std::optional<double> rolling_radius;  ///< m, for that; absent: where the part touches, or its mesh's nominal radius
  std::optional<Vec3> centre;            ///< of rotation; absent: see rotation_centre() of solve/statics/settle.hpp
  std::string around;                    ///< node set whose centre is that of the rotation, e.g. an axle's bore
};

/// A node set that moves as a rigid body does whose motion is known, in all directions or some; held in these while the
/// scene settles.
struct PrescribedMotion : Place {
  std::string target;              ///< `part.node_set`
  Vec3 velocity{0, 0, 0};          ///< m/s, of the centre
  Vec3 angular_velocity{0, 0, 0};  ///< rad/s, about an axis of fixed direction through the moving centre
  std::optional<Vec3> centre;      ///< m, where the run begins; absent: see centre_of_rotation() of round_part.hpp
  std::string curve;               ///< factor on both; empty: constant 1
  Vec3 displacement{0, 0, 0};      ///< m, besides what the velocities make
  std::string displacement_curve;  ///< factor on that
  std::array<bool, 3> directions{true, true, true};  ///< along axes[0], axes[1], axes[2]: in others the nodes are free
  std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// Dashpots on a surface that let waves out (Lysmer and Kuhlemeyer 1969); while the scene settles its nodes are held.
struct NonReflecting : Place {
  std::string target;  ///< `part.surface`
};

/// A zone before a part's end in which mass-proportional damping grows with the cube of the way to the end, so that
/// waves of all kinds die out.
struct AbsorbingLayer : Place {
  std::string target;  ///< `part.surface`: the end
  double length = 0;   ///< m, from the end into the body
  double reflection =
      0.01;  ///< of the part's fastest waves' amplitude that its damping leaves on the way to the end and back
};

/// Each node of the slave stays where it lies over a face of the master.
struct Tie : Place {
  std::string slave;                   ///< `part.surface`
  std::string master;                  ///< `part.surface`
  std::optional<double> max_distance;  ///< m from the master's faces; absent: a tenth of the face's shorter diagonal
};

struct Scene {
  std::string title;
  std::string path;  ///< of the case file
  std::string
      static_text;  ///< what of the case the static state can depend on, key by key; empty where there is no file
  std::vector<Material> materials;
  std::vector<MeshSource> meshes;
  std::vector<Seam> seams;
  std::vector<Part> parts;
  std::vector<NodeSet> node_sets;
  std::vector<ElementSet> element_sets;
  std::vector<Hammer> hammers;
  std::vector<Probe> probes;
  std::vector<Sleeper> sleepers;
  std::vector<Track> tracks;
  std::vector<Curve> curves;
  std::vector<PointMass> points;
  std::vector<Load> loads;
  std::vector<Connector> connectors;
  std::vector<Beam> beams;
  std::vector<Constraint> constraints;
  std::vector<Contact> contacts;
  std::vector<InitialMotion> initial_motions;
  std::vector<PrescribedMotion> prescribed_motions;
  std::vector<NonReflecting> non_reflecting;
  std::vector<AbsorbingLayer> absorbing_layers;
  std::vector<Tie> ties;
  Vec3 gravity{0, 0, 0};  ///< m/s2
  Settle settle;
  Checkpoint checkpoint;
  Time time;
  Solver solver;
  Monitor monitor;
  Output output;
  std::vector<OutputWindow> output_windows;
};

}  // namespace railwave::scene
