#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deck/deck.hpp"
#include "deck/report.hpp"
#include "mesh/face_table.hpp"

namespace railwave::deck {

/// A title as names of a case are: letters, digits, _ and -; "" where nothing of it is left.
std::string fit_name(const std::string& title);

/// What sets a part's elements apart from those of others, besides their places.
struct Settings {
  Number material = 0;
  bool stiffness = false;            ///< hourglass control by displacement
  double hourglass = 0;              ///< its coefficient
  double quadratic = 0, linear = 0;  ///< bulk viscosity
  double mass_damping = 0;           ///< 1/time
  double stiffness_damping = 0;      ///< time

  bool operator==(const Settings& other) const {
    return material == other.material && stiffness == other.stiffness && hourglass == other.hourglass &&
           quadratic == other.quadratic && linear == other.linear && mass_damping == other.mass_damping &&
           stiffness_damping == other.stiffness_damping;
  }
};

/// One part of the case: the parts of the deck that share nodes and have the same settings.
struct Body {
  std::string name;
  std::string element_set;
  std::vector<Number> parts;
  std::vector<int> elements;
  Settings settings;
};

/// Bodies with nodes in common: these are nodes of the first, and the second is tied to it.
struct Joint {
  int owner = 0, tied = 0;
  std::vector<Face> owner_faces, tied_faces;
};

/// A deck's hexahedra as bodies. Nodes, elements and faces are positions in the deck's mesh.
class Bodies {
 public:
  /// @param settings of each part that has elements
  /// Throws InputError for elements that can't be connected; what bodies can't be goes into the report.
  Bodies(const Deck& deck, const std::map<Number, Settings>& settings, Report& report);

  const std::vector<Body>& all() const { return bodies_; }
  const Mesh& mesh() const { return mesh_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Face>& exterior() const { return exterior_; }
  std::vector<Face> faces_at(const std::array<int, 4>& nodes) const { return faces_->find(nodes); }

  int of_element(int element) const { return of_element_[element]; }
  /// The body that a node counts for: the first that has it; -1: a node of no hexahedron.
  int of_node(int node) const { return of_node_[node]; }
  bool shared(int node) const { return shared_[node] != 0; }

  /// Whether bodies have nodes in common.
  bool joined(int a, int b) const;

  /// A name that nothing has yet, made of a title of the deck's or of `otherwise`.
  std::string new_name(const std::string& title, const std::string& otherwise);

 private:
  void group(const Deck& deck, const std::map<Number, Settings>& settings, Report& report);
  void find_joints(Report& report, const Deck& deck);
  void refuse_corners(Report& report, const Deck& deck);

  Mesh mesh_;
  std::unique_ptr<FaceTable> faces_;
  std::vector<Face> exterior_;
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  std::vector<int> of_element_, of_node_;
  std::vector<char> shared_;
  std::set<std::string> names_{"ground"};
};

}  // namespace railwave::deck
