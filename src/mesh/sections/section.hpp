#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/curve.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A node of a section. Nodes on a boundary curve may slide along it while the section is smoothed.
struct SectionNode {
  Point2 position;
  int level = 0;         ///< level of longitudinal coarsening: present in every layer that this level keeps
  int curve = -1;        ///< boundary curve, -1: none
  double parameter = 0;  ///< arc length on that curve
  bool fixed = false;
};

/// A quadrilateral of a section, corners counter-clockwise with the running surface upwards and y to the right.
/// In a transition quad, corners 0, 1 belong to level + 1 and 3, 2 (above them) to `level`: its extrusion holds the
/// 3:1 transition.
struct SectionQuad {
  std::array<int, 4> nodes;
  int level = 0;
  bool transition = false;
  bool zone = false;
  std::array<Point2, 4> ideal{};  ///< the shape and size that smoothing aims at
};

/// Edge `edge` (corner to next corner) of a quad, for surfaces.
struct SectionEdge {
  int quad;
  int edge;
};

/// A section in quadrilaterals, with the names that its extrusion gives to sets.
struct SectionMesh {
  std::vector<SectionNode> nodes;
  std::vector<SectionQuad> quads;
  std::vector<Curve> curves;
  std::map<std::string, std::vector<SectionEdge>> edges;
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> lines;  ///< nodes one after the other along the outline

  int add_node(Point2 position);
  int add_fixed_node(Point2 position);
  int add_curve(Curve curve);
  int add_curve_node(int curve, double parameter);
  /// `parts + 1` nodes along a curve, evenly spaced by arc length, between two nodes that exist.
  std::vector<int> add_curve_line(int first, int curve, int parts, int last);
  /// The edges of quads between each two nodes that follow each other.
  std::vector<SectionEdge> edges_along(const std::vector<int>& line) const;
  Point2 position(int node) const { return nodes[node].position; }
};

/// What a row of quads does on the way down from the running surface.
enum class RowKind {
  plain,
  longitudinal,  ///< 3:1 along the extrusion
  lateral        ///< 3:1 in the section
};

struct Row {
  RowKind kind = RowKind::plain;
  double height = 0;  ///< relative to the block's other rows
};

/// The quads of one row, by column of the line above, and its position: what a caller needs to name sets.
struct BlockRow {
  std::vector<int> top_line;     ///< nodes above the row
  std::vector<int> first_quads;  ///< of each column of a plain or longitudinal row
};

/// Fills a four-sided block with rows from `top` (left to right) down to `bottom`. `left` and `right` hold one node for
/// each row line, top and bottom corners included. A lateral row merges the columns in the next of `merges`
/// (group sizes, left to right), so `bottom` has as many nodes as then remain. New nodes are placed by transfinite
/// interpolation. `level` is the longitudinal level at the top; returns the rows, top row first.
std::vector<BlockRow> fill_block(SectionMesh& section, const std::vector<int>& top, const std::vector<Row>& rows,
                                 const std::vector<std::vector<int>>& merges, const std::vector<int>& left,
                                 const std::vector<int>& right, const std::vector<int>& bottom, int level);

/// Sets each quad's ideal shape from the present positions: a rectangle with the mean lengths of opposite edges; quads
/// of a lateral transition keep the template's shape, which fill_block has stored, scaled. No ideal edge is shorter
/// than `smallest`, so that smoothing widens what the start has squeezed and no element sets a short time step.
void set_ideal_shapes(SectionMesh& section, double smallest);

/// Fractions of a transition row's height and of a cell's width at which the template's inner nodes lie, from the
/// merged side; with a row 2.4 cells high every hexahedron keeps a stable step of 0.8 of the fine cell's.
inline constexpr double transition_depth = 0.54;
inline constexpr double transition_inset = 0.1;
inline constexpr double transition_height = 2.4;

/// Moves the free nodes of a section, and those on curves along their curve, so that each quad comes close to its ideal
/// shape and size: minimises the sum over quad corners of |T|^2 / (2 det T) - 1 + (det T + 1 / det T - 2) / 2, where T
/// maps the ideal corner onto the present one (target-matrix optimisation, Knupp 2012). The determinant is regularised
/// while quads are inverted, so that the start may be tangled. Fixed nodes stay.
void smooth_section(SectionMesh& section);

/// Shifts boundary nodes along their normals so that the section's polygon has the area of the outline on which its
/// nodes lie: each edge's area between chord and outline is shared by its two ends. Otherwise chords would reduce area
/// and bending stiffness at every rounding. `outline` is closed, counter-clockwise and finely sampled;
/// nodes with `kept[n]` stay on it.
void match_outline_area(SectionMesh& section, const std::vector<Point2>& outline, const std::vector<char>& kept);

/// Points on a closed curve, `spacing` apart.
std::vector<Point2> sample_closed(const Curve& curve, double spacing);

/// Area (m2), centroid (m) and second moments (m4) of plane faces, about the axes y and z through the centroid.
struct SectionProperties {
  double area = 0;
  double centroid_y = 0, centroid_z = 0;
  double moment_y = 0;                           ///< integral of (z - centroid_z)^2: vertical bending
  double moment_z = 0;                           ///< integral of (y - centroid_y)^2: lateral bending
  double product = 0;                            ///< integral of (y - centroid_y) (z - centroid_z)
  double greatest_moment = 0, least_moment = 0;  ///< principal values
};

/// Properties of faces that lie in a plane of constant x; each face counts as the polygon of its corners.
SectionProperties section_properties(const Mesh& mesh, const std::vector<Face>& faces);

}  // namespace railwave
