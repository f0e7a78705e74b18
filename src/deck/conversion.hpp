#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "deck/bodies.hpp"
#include "deck/units.hpp"
#include "deck/written_mesh.hpp"

namespace railwave::deck {

/// The sections of a case file, as they are written.
class CaseText {
 public:
  /// Begins a section "[parts.wheel]"; keys follow.
  void section(const std::string& name);
  void key(const std::string& name, const std::string& value);
  void key(const std::string& name, double value);
  void key(const std::string& name, const Vec3& value);
  void remark(const std::string& text);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A number, a text and lists of them as TOML has them. Numbers have 15 digits: what conversion of units adds beyond
/// these is rounding. Throws InputError for a number that is not finite.
std::string toml(double value);
std::string toml(const Vec3& value);
std::string toml(const std::string& text);
std::string toml(const std::vector<std::string>& texts);

/// A node of no hexahedron that the case has as a point: where beams, springs or masses are.
struct Point {
  std::string name;
  double mass = 0;  ///< in the deck's unit
  bool beam = false;
  std::array<bool, 6> held{};
  bool ground = false;  ///< held in all directions and without mass: connectors lead to the ground
  Source source;        ///< what needs it
};

/// What a set of nodes is in the case: nodes of bodies, and points.
struct Target {
  std::map<int, std::vector<int>> of_body;
  std::vector<int> points;  ///< nodes
  std::vector<int> unused;  ///< nodes of nothing
};

/// A deck on its way into a case; what the writers below share.
struct Conversion {
  const Deck& deck;
  Report& report;
  Units units;
  Bodies& bodies;
  WrittenMesh mesh;
  CaseText text;
  std::string mesh_file;
  std::map<int, Point> points;                ///< by node's position
  std::map<std::string, std::string> curves;  ///< sections of curves that are used, by name
  std::vector<std::string> plastic;           ///< bodies whose material yields
  std::map<Number, std::string> materials;    ///< names of those that are written
  std::vector<std::pair<Number, int>>
      node_order{};  ///< numbers of nodes and their positions, ascending; made when asked

  /// @throws InputError "file:line: *KEYWORD: ..."
  [[noreturn]] void fail(const Source& source, const std::string& text) const;

  int node(Number number, const Source& source) const;  ///< position
  const NumberSet& part_set(Number number, const Source& source) const;
  void add_nodes_within(const Box& box, std::vector<int>& nodes) const;
  std::vector<int> members(const Nodes& nodes, const Source& source);
  Target target(const std::vector<int>& nodes) const;
  std::string name_of(const Nodes& nodes) const;      ///< for a set of the mesh: the title, or the number
  std::string name_of_segments(Number number) const;  ///< likewise

  /// One node as a case names it: a set of a body, or a point.
  std::string node_name(int node);

  /// Elements of a part, and their outside faces.
  std::vector<int> elements_of(const std::set<Number>& parts) const;
  std::vector<Face> skin_of(const std::set<Number>& parts) const;

  /// Numbers of parts of a part set or of one part.
  std::set<Number> parts_of(Number number, bool is_set, const Source& source) const;

  /// The outside face of a hexahedron that a segment is; `outwards` is 1, or -1 where its nodes run the other way.
  Face face_of(const Segment& segment, const Source& source, int& outwards) const;
  std::vector<Face> faces_of_set(Number number, const Source& source) const;
  std::map<int, std::vector<Face>> by_body(const std::vector<Face>& faces) const;

  const Curve& curve(Number number, const Source& source) const;
  /// The name of a case's curve made of one of the deck's.
  std::string use_curve(Number number, const Source& source);
  /// Another curve, of times in the deck's unit.
  std::string add_curve(const std::string& name, const std::vector<std::array<double, 2>>& points);

  std::array<Vec3, 3> axes(Number number, const Source& source) const;
  double body_mass(int body) const;         ///< in the deck's unit
  std::vector<double> node_masses() const;  ///< likewise, by node, of all bodies together
};

/// Of a slave's faces those that lie on the master: all of whose corners are within 5 % of the shorter diagonal of a
/// master's face, as LS-DYNA ties them (*CONTACT_TIED, remark on tolerances of solids [LSTC 2021]).
/// @param left_out how many nodes lie so near, but are corners of no such face
std::vector<Face> faces_on(const Mesh& mesh, const std::vector<Face>& slave, const std::vector<Face>& master,
                           std::size_t& left_out);

void write_bodies(Conversion& conversion);
void write_points(Conversion& conversion);
void write_joints(Conversion& conversion);
void write_beams(Conversion& conversion);
void write_connectors(Conversion& conversion);
void write_constraints(Conversion& conversion);
void write_motions(Conversion& conversion);
void write_non_reflecting(Conversion& conversion);
void write_velocities(Conversion& conversion);
void write_loads(Conversion& conversion);
void write_contacts(Conversion& conversion);
void write_run(Conversion& conversion);

}  // namespace railwave::deck
