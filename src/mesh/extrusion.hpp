#pragma once

#include <functional>
#include <vector>

#include "mesh/grading.hpp"
#include "mesh/mesh.hpp"
#include "mesh/sections/section.hpp"

namespace railwave {

/// Where the elements and nodes of an extruded mesh come from.
struct Extrusion {
  Mesh mesh;
  std::vector<int> section_quad;   ///< of each element
  std::vector<int> first_station;  ///< of each element: the station at which it begins
  std::vector<int> section_node;   ///< of each node; -1 inside a transition's template
  std::vector<int> station;        ///< of each node
};

/// Maps a section point and a station's coordinate into space.
using Placement = std::function<Vec3(Point2 point, double station)>;

/// Extrudes a section along stations; quads of level k become elements between the stations that level k keeps, and a
/// transition quad fills a cell of level + 1 with four elements over three cells of its level, or one over one.
/// `turned` says that the placement mirrors (section counter-clockwise seen against the direction of the stations).
/// All elements come out with positive volume; sides 2 to 5 of an element of a plain quad are the quad's edges 0 to 3.
Extrusion extrude(const SectionMesh& section, const Stations& stations, const Placement& place, bool turned);

/// At most so many elements an extrusion has: each template of a transition counts as the four that it can have.
double extruded_elements(const SectionMesh& section, const Stations& stations);

/// Faces of elements that lie on the named edges of the section and begin at stations from `first` up to before `last`.
std::vector<Face> faces_on_edges(const Extrusion& extrusion, const std::vector<SectionEdge>& edges, int first,
                                 int last);

/// Mesh nodes made from the given nodes of the section, at all stations.
std::vector<int> nodes_on_section_nodes(const Extrusion& extrusion, const std::vector<int>& section_nodes);

/// Faces that lie across the extrusion at a station, made from the section's own nodes.
std::vector<Face> faces_at_station(const Extrusion& extrusion, int station);

/// Elements made from zone quads between the stations `first` and `last`.
std::vector<int> zone_elements(const Extrusion& extrusion, const SectionMesh& section, int first, int last);

}  // namespace railwave
