#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/files/dyna_lines.hpp"
#include "mesh/files/numbered_mesh.hpp"

/// What an LS-DYNA keyword deck says, in the deck's own units and numbers: plain structs that the readers of keywords
/// fill (deck_reader.hpp) and of which a mesh file and a case are made (scene_of_deck.hpp).
namespace railwave::deck {

using Number = std::int64_t;

/// Where something was written, and under which keyword.
struct Source {
  FilePlace place;
  std::string keyword;  ///< without *
};

struct Part {
  Source source;
  std::string title;
  Number section = 0, material = 0, hourglass = 0;
};

struct Section {
  enum class Kind { solid, beam, discrete, other };
  Source source;
  Kind kind = Kind::other;
  Number formulation = 0;       ///< ELFORM
  bool circle = false;          ///< of a beam; else a rectangle
  double outer = 0, inner = 0;  ///< its diameters, or sides along s and t
  std::string refusal;          ///< why it cannot be taken; empty: it can
};

struct Material {
  enum class Kind { elastic, plastic, spring, damper, other };
  Source source;
  Kind kind = Kind::other;
  std::string title;
  double density = 0, youngs_modulus = 0, poissons_ratio = 0;
  double yield_stress = 0, tangent_modulus = 0, hardening_beta = 1;
  double coefficient = 0;                        ///< stiffness or damping of a spring or dashpot
  std::string refusal, key;                      ///< why it cannot be taken, and what --drop takes to leave that out
  std::vector<std::array<std::string, 2>> more;  ///< further such pairs: reason, key
};

struct Hourglass {
  Source source;
  Number type = 0;  ///< IHQ; 0: the deck's default
  double coefficient = 0;
  double quadratic = 0, linear = 0;  ///< bulk viscosity, 0: the deck's default
};

struct Beam {
  Source source;
  Number number = 0, part = 0;
  std::array<Number, 3> nodes{};  ///< ends, and the node of orientation
};

struct Discrete {
  Source source;
  Number number = 0, part = 0;
  std::array<Number, 2> nodes{};  ///< the second 0: ground
  Number orientation = 0;
  double scale = 1;
  double offset = 0;
};

struct PointMass {
  Source source;
  Number number = 0, node = 0;
  double mass = 0;
};

struct Range {
  Number first, last, step;
};

/// Numbers of a set, as written; nodes, parts or solids.
struct NumberSet {
  Source source;
  std::string title;
  std::vector<Range> ranges;
  std::vector<Number> parts;  ///< of a node set: all nodes of these
  bool all = false;
  std::vector<Number> boxes;  ///< of a node set: all nodes within one of these
};

/// Along the axes, from its lowest to its highest corner.
struct Box {
  Source source;
  Vec3 low{0, 0, 0}, high{0, 0, 0};
};

using Segment = std::array<Number, 4>;

struct SegmentSet {
  Source source;
  std::string title;
  std::vector<Segment> segments;
  std::vector<Number> parts;  ///< all outside faces of these
};

struct Curve {
  Source source;
  std::string title;
  std::vector<std::array<double, 2>> points;
};

/// Unit vectors along x, y, z of a system of coordinates, or the nodes that they are made of.
struct Axes {
  Source source;
  std::optional<std::array<Number, 3>> nodes;
  int direction = 0;  ///< of nodes: which local axis leads from the first to the second
  std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// A direction by *DEFINE_VECTOR or *DEFINE_SD_ORIENTATION.
struct Direction {
  Source source;
  Number option = 0;  ///< IOP
  Vec3 vector{0, 0, 0};
  std::array<Number, 2> nodes{};
};

/// One node, or a set of them.
struct Nodes {
  Number number = 0;
  bool is_set = false;
};

struct Constraint {
  Source source;
  Nodes nodes;
  Number axes = 0;
  std::array<bool, 6> fixed{};
};

struct Motion {
  Source source;
  Nodes nodes;
  Number direction = 0;  ///< DOF
  Number kind = 0;       ///< VAD: velocity, acceleration, displacement
  Number curve = 0;
  double scale = 1;
  Number vector = 0;
};

struct NodalLoad {
  Source source;
  Nodes nodes;
  Number direction = 0, curve = 0, axes = 0;
  double scale = 1;
};

struct Pressure {
  Source source;
  Number curve = 0, set = 0;
  std::vector<Segment> segments;
  double scale = 1;
};

struct BodyLoad {
  Source source;
  int direction = 0;
  Number curve = 0;
  double scale = 1;
};

struct InitialVelocity {
  Source source;
  enum class Of { all, node, node_set, part, part_set } of = Of::all;
  Number number = 0;
  Vec3 velocity{0, 0, 0};
  Number axes = 0;     ///< along which the velocity is given, 0: x, y, z
  double turning = 0;  ///< rad per time, about axis through centre
  Vec3 centre{0, 0, 0}, axis{0, 0, 1};
};

struct Side {
  Number number = 0, type = 0;  ///< SSID, SSTYP
};

struct Contact {
  Source source;
  Number number = 0;
  std::string title;
  enum class Kind { surfaces, nodes, tied, single } kind = Kind::surfaces;
  Side slave, master;
  double friction = 0, dynamic_friction = 0, decay = 0, damping = 0;
  double penalty_scale = 1;
};

struct NonReflecting {
  Source source;
  Number set = 0;
};

/// A plane that nodes do not pass.
struct Wall {
  Source source;
  Number set = 0;                     ///< of nodes; 0: all
  Vec3 tail{0, 0, 0}, head{0, 0, 0};  ///< a point of the plane, and one on the side where bodies are
  double friction = 0;
};

struct Damping {
  Source source;
  bool by_mass = true;
  Number part = 0;  ///< 0: all
  bool is_set = false;
  Number curve = 0;
  double value = 0;
};

struct Transformation {
  Source source;
  /// Row by row: x' = matrix x + shift.
  std::array<Vec3, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3 shift{0, 0, 0};
};

struct Control {
  std::optional<double> end;
  double step_scale = 0;
  Number hourglass_type = 0;
  double hourglass_coefficient = 0;
  double quadratic_viscosity = 0, linear_viscosity = 0;
  double field_interval = 0, history_interval = 0;
  double contact_stiffness = 0;
  Source end_source;
};

struct Deck {
  std::string title;
  bool of_abaqus = false;             ///< numbers stand for names
  NumberedMesh mesh;                  ///< all nodes; hexahedra
  std::vector<int> node_scopes;       ///< by position of the node, see DynaScope
  std::vector<Number> element_parts;  ///< by position of the element
  std::map<Number, Part> parts;
  std::map<Number, Section> sections;
  std::map<Number, Material> materials;
  std::map<Number, Hourglass> hourglass;
  std::vector<Beam> beams;
  std::vector<Discrete> discretes;
  std::vector<PointMass> masses;
  std::map<Number, NumberSet> node_sets, part_sets, solid_sets;
  std::map<Number, SegmentSet> segment_sets;
  std::map<Number, Curve> curves;
  std::map<Number, Axes> axes;
  std::map<Number, Box> boxes;
  std::map<Number, Direction> vectors, orientations;
  std::map<Number, Transformation> transformations;
  std::vector<Constraint> constraints;
  std::vector<Motion> motions;
  std::vector<NodalLoad> nodal_loads;
  std::vector<Pressure> pressures;
  std::vector<BodyLoad> body_loads;
  std::vector<InitialVelocity> velocities;
  std::vector<Contact> contacts;
  std::vector<NonReflecting> non_reflecting;
  std::vector<Wall> walls;
  std::size_t own_nodes = 0, own_elements = 0;  ///< without those of walls, which come last
  std::vector<Damping> dampings;
  std::vector<std::pair<Source, Number>> history_nodes, history_node_sets, history_solids;
  Control control;
};

}  // namespace railwave::deck
