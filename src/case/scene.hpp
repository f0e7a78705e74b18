#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "case/scene_meshes.hpp"
#include "case/surface_names.hpp"

/// What a case file says, read and checked: plain host structs in SI units, in the file's order.
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

struct Material : Place {
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;
  double density = 0;                  ///< kg/m3
  std::optional<double> yield_stress;  ///< Pa, von Mises; absent: elastic
  double tangent_modulus = 0;          ///< Pa, slope of stress over strain beyond yield, uniaxial stress
  double hardening_beta = 1;           ///< share of the hardening that is isotropic; the rest moves the yield surface
  double isotropic_saturation = 0;     ///< Pa, by how much the flow stress grows in the end
  double isotropic_rate = 0;           ///< of that over plastic strain
  double back_stress_modulus = 0;      ///< Pa, by which the yield surface begins to move
  double back_stress_recall = 0;       ///< share of the back stress that fades over plastic strain

  /// lambda + 2 mu, Pa
  double dilatational_modulus() const {
    return youngs_modulus * (1 - poissons_ratio) / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
  /// C_d of thesis eq. 2.14b, m/s
  double dilatational_speed() const { return std::sqrt(dilatational_modulus() / density); }
  /// C_s, m/s
  double shear_speed() const { return std::sqrt(shear_modulus() / density); }
};

/// A crack in a mesh: nodes doubled on a plane across the rail, its two faces surfaces NAME_before and NAME_behind.
struct Seam : Place {
  std::string mesh;
  Vec3 place{0, 0, 0};  ///< m, middle of its mouth on the mesh's upper surface
  double length = 0;    ///< m, along y
  double depth = 0;     ///< m, along its plane
  double angle = 0;     ///< rad from the vertical, positive: deeper parts lie farther along x
};

enum class HourglassType { viscous, stiffness };

struct Part : Place {
  std::string mesh;
  std::string material;
  std::string element_set;                             ///< empty: the whole mesh
  Vec3 position{0, 0, 0};                              ///< translation of the mesh, m
  bool mirror = false;                                 ///< y of the mesh is turned round
  double angle_of_attack = 0;                          ///< rad, about z through the mesh's origin, after mirroring
  HourglassType hourglass = HourglassType::stiffness;  ///< chosen by scripts/hourglass_table: docs/hourglass.md
  double hourglass_coefficient = 0.05;

  /// With the coefficient that goes with a type unless one is given.
  void take_hourglass(HourglassType type) {
    hourglass = type;
    hourglass_coefficient = type == HourglassType::stiffness ? 0.05 : 0.1;
  }
  double mass_damping = 0;           ///< 1/s: force on a node is that times its mass and velocity, against the velocity
  double stiffness_damping = 0;      ///< s: viscous stress is that times what elasticity makes of the strain's rate
  double linear_bulk_viscosity = 0;  ///< of volumes that shrink, over rho c l times the rate
  double quadratic_bulk_viscosity = 0;  ///< the same over rho l^2 times its square

  bool damped() const {
    return mass_damping > 0 || stiffness_damping > 0 || linear_bulk_viscosity > 0 || quadratic_bulk_viscosity > 0;
  }
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

struct PointMass : Place {
  double mass = 0;  ///< kg; 0 only where beams end, which give it mass
  Vec3 position{0, 0, 0};
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
  Vec3 preload{0, 0, 0};    ///< force on `to` at zero relative displacement, N
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

enum class ContactAlgorithm { penalty, multiplier };
enum class ContactNormals { facet, smooth };

/// m: cracks, slots and gaps in a master as wide as this are crossed, but none wider than four of the slave's smallest
/// faces; those as wide as one always.
inline constexpr double usual_bridged_gap = 1e-3;

struct Contact : Place {
  std::string slave;                       ///< `part.surface`
  SurfaceNames master;                     ///< `part.surface`; several are one surface
  double friction = 0;                     ///< Coulomb coefficient, at rest where it falls with the sliding speed
  std::optional<double> dynamic_friction;  ///< at high speed, mu_d of thesis eq. 2.29
  double friction_decay = 0;               ///< c of thesis eq. 2.29, s/m; 0: friction is constant
  ContactAlgorithm algorithm = ContactAlgorithm::penalty;
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

  bool falling_friction() const { return friction_decay > 0; }
};

struct InitialMotion : Place {
  std::vector<std::string> parts;  ///< parts and point masses
  Vec3 velocity{0, 0, 0};
  Vec3 angular_velocity{0, 0, 0};  ///< rad/s
  bool rolling =
      false;  ///< the angular velocity is the one that rolls; the model fills it in, see model/contact/rolling.hpp
  std::optional<double> rolling_radius;  ///< m, for that; absent: where the part touches, or its mesh's nominal radius
  std::optional<Vec3> centre;            ///< of rotation; absent: the centre of mass of `around`, or of each part
  std::string around;  ///< node set whose centre of mass is the centre of rotation, e.g. an axle's bore
};

/// A node set that moves as a rigid body does whose motion is known, in all directions or some; held in these while the
/// scene settles.
struct PrescribedMotion : Place {
  std::string target;              ///< `part.node_set`
  Vec3 velocity{0, 0, 0};          ///< m/s, of the centre
  Vec3 angular_velocity{0, 0, 0};  ///< rad/s, about an axis of fixed direction through the moving centre
  std::optional<Vec3> centre;      ///< m, where the run begins; absent: the set's centre of mass
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

/// automatic: Newton's method, and relaxation where that finds no equilibrium.
enum class SettleMethod { automatic, newton, relaxation };

/// Static equilibrium before the run; absent: the run starts from the undeformed mesh.
struct Settle {
  bool active = false;
  SettleMethod method = SettleMethod::automatic;
  double tolerance = 1e-3;  ///< residual force over applied force at which it counts as settled
  int max_steps = 20000;
  bool friction = true;      ///< false: contacts are frictionless while the scene settles
  bool cache = true;         ///< keep the settled state in a file, and take it from there
  std::string cache_folder;  ///< where that lies; empty: beside the results
};

struct Time {
  double end = 0;           ///< s
  double step_scale = 0.9;  ///< sf, thesis 3.3.6
  double step = 0;          ///< s; 0: from elements and contact
};

enum class Precision { double_precision, mixed, single_precision };

enum class StepEstimate { element, eigenvalue, global };

/// What is kept of a run so that it can be taken up again.
struct Checkpoint {
  double interval = 300;  ///< wall seconds; 0: none but where the run is stopped
  std::string file;       ///< empty: beside the results
};

/// How the time loop computes; what it computes is the other sections' matter.
struct Solver {
  Precision precision =
      Precision::double_precision;  ///< mixed: elements in single, nodes in double; single: both in single
  StepEstimate step_estimate = StepEstimate::element;  ///< what the stable step is taken from
  bool subcycling = false;                             ///< coarse regions take larger steps than fine ones
  int renew_steps = 20000;                             ///< steps between renewals of the global estimate; 0: never

  bool elements_in_single() const { return precision != Precision::double_precision; }
};

/// Limits of the checks of a running solution: beyond one the run warns, beyond a fatal one it stops.
struct Monitor {
  bool active = true;
  double energy_error = 0.05;       ///< of the balance, over what deformation has held and dissipated
  double fatal_energy_error = 0.5;  ///< the same; the run stops
  double kinetic_growth = 0.1;      ///< kinetic energy beyond what the run was given, over the same
  double hourglass_share =
      0.1;  ///< hourglass energy of a part, stored or dissipated within a millisecond, over that of its deformation
  double hourglass_distortion = 0.3;  ///< hourglass displacement of an element over its size
  double penetration = 0.1;           ///< of a contact node over the size of the face under it
  double volume_ratio = 0.3;          ///< smallest Jacobian of an element over its undeformed one; the run stops at 0
  double speed = 500;                 ///< m/s, of a node
  double fatal_speed = 20000;         ///< m/s; the run stops
  double contact_edge = 0.1;  ///< normal force of a contact node at an end of its surface over the contact's largest
  double fine_zone = 0.1;     ///< the same outside the fine zone of a part
  int chatter = 10;           ///< times that a contact node was seen to open and to close again
  double box = 0;             ///< m, half the edge of what is written about a fault; 0: six times the element's size
};

enum class ResultsPrecision { double_precision, single };

/// Without a list of names all are meant.
inline bool is_among(const std::string& one, const std::optional<std::vector<std::string>>& names) {
  return !names || std::find(names->begin(), names->end(), one) != names->end();
}

struct Output {
  std::string file = "results.h5";  ///< relative to the folder the program runs in unless absolute
  double history_interval = 0;      ///< s; 0: every step
  double field_interval = 0;        ///< s; 0: only at the beginning and the end
  std::vector<std::string>
      field_sets;  ///< `part` or `part.element_set` or `part.surface`: element and node fields on these
  std::vector<std::string> fields;  ///< names of case/field_table.hpp that serve fields
  std::vector<std::string>
      history_sets;  ///< `part.node_set` or point masses: mean motion; `part.element_set`: mean stress and strain
  std::optional<std::vector<std::string>> history_beams;   ///< of which section forces are written; absent: all
  std::optional<double> contact_margin;                    ///< m; absent: contact surfaces are written whole
  std::optional<std::vector<std::string>> contact_fields;  ///< names of case/field_table.hpp; absent: all
  std::vector<std::string> contact_sides = {"slave", "master"};
  ResultsPrecision precision = ResultsPrecision::double_precision;  ///< of fields and contacts; histories are in double
  std::optional<int> significant_digits;                            ///< of fields and contacts but places; absent: all
  double progress_interval = 5;                                     ///< wall seconds between progress lines
};

/// Part of a run in which fields are written besides those of Output::field_interval. Absent lists: all.
struct OutputWindow : Place {
  double start = 0;                                    ///< s
  std::optional<double> end;                           ///< s; absent: the run's
  double interval = 0;                                 ///< s; 0: every step
  std::optional<std::vector<std::string>> field_sets;  ///< of Output::field_sets
  std::optional<std::vector<std::string>> contacts;    ///< names

  bool has_set(const std::string& set) const { return is_among(set, field_sets); }
  bool has_contact(const std::string& contact) const { return is_among(contact, contacts); }
};

/// What is under the rail at one place: half a sleeper, its fastening and its ballast. Absent: as `base` has it.
struct Sleeper : Place {
  enum class Base { concrete, timber };
  Base base = Base::concrete;
  std::string material;                              ///< empty: that of the base
  std::optional<double> half_length, width, height;  ///< m: across the track from its centre, along it, up
  std::optional<std::array<int, 3>> divisions;       ///< elements along x, y, z
  std::optional<double> pad_thickness, pad_length;   ///< m: gap between foot and sleeper, extent along the rail
  std::optional<Vec3> fastening_stiffness, fastening_damping;  ///< N/m, N s/m along x, y, z
  std::optional<double> ballast_stiffness, ballast_damping;    ///< vertical, N/m, N s/m
  std::optional<double> ballast_lateral_stiffness,
      ballast_lateral_damping;  ///< N/m, N s/m under half a sleeper; absent: its middle is held
  std::array<int, 2> fastening_spread{3, 3}, ballast_spread{2, 6};
  enum class Pad { springs, solid };
  Pad pad = Pad::springs;             ///< solid: a body between foot and sleeper, tied to both
  std::optional<double> pad_modulus;  ///< Pa; absent: of the vertical stiffness
  double pad_poissons_ratio = 0.3;
  double pad_density = 1000;          ///< kg/m3
  std::optional<double> pad_damping;  ///< s, stiffness damping; absent: of the vertical stiffness and damping
  int pad_layers = 2;                 ///< elements through its thickness
};

enum class FishplateFit { tie, contact };

/// Half a track or a whole one, generated: see case/expand.hpp for what it becomes.
struct Track : Place {
  RailMesh rail;
  std::string rail_material;          ///< empty: elastic rail steel of its own
  double rail_stiffness_damping = 0;  ///< s, Part::stiffness_damping of the rails
  Vec3 position{0, 0, 0};
  bool mirror = false;                                 ///< all its parts are mirrored
  bool both_rails = false;                             ///< whole sleepers and the other rail
  HourglassType hourglass = HourglassType::stiffness;  ///< of rails and sleepers
  double rail_distance = 0.755;  ///< m, from the track's centre plane to the middle of the rail's foot
  std::string sleeper = "concrete";
  double pitch = 0.6;                   ///< m
  std::optional<double> first_sleeper;  ///< x of the first regular one; absent: half a pitch from the rail's start
  std::vector<double> positions;        ///< x of the regular ones instead
  std::string other_sleeper = "timber";
  std::vector<double> other_positions;
  std::optional<double> pair_position;  ///< x of the middle of a pair of other sleepers
  double pair_distance = 0.24;          ///< m
  std::optional<double> gap_position;   ///< x of the middle of the gap between two rails
  double gap = 0.006;                   ///< m
  bool fishplates = false;              ///< and bolts, at the gap
  FishplateFit fishplate_fit = FishplateFit::tie;
  double fishplate_friction = 0.3;                                 ///< where they are in contact
  std::string fishplate_material;                                  ///< empty: the rail's
  double fishplate_length = 0.6;                                   ///< m
  double fishplate_thickness = 0.02;                               ///< m
  double fishplate_clearance = 0;                                  ///< m
  std::optional<double> fishplate_size;                            ///< m
  std::vector<double> bolt_positions{-0.23, -0.065, 0.065, 0.23};  ///< m along x from the gap's middle
  std::optional<double>
      bolt_height;                  ///< m above the foot's underside, before inclination; absent: the chamber's middle
  double bolt_diameter = 0.024;     ///< m
  double bolt_pretension = 12.5e3;  ///< N
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
