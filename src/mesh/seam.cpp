#include "mesh/seam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "case/error.hpp"
#include "mesh/face_table.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/surface_above.hpp"
#include "mesh/vectors.hpp"

namespace railwave {
namespace {

/// A face between two elements that lies across x.
struct LayerFace {
  std::array<int, 4> nodes{};  ///< sorted
  Face before{}, behind{};     ///< the same face of the element at each side
  Vec3 centre{0, 0, 0};
  double area = 0;
};

/// Nodes within this many times the largest displacement of the plane move with it, by linearly less with the distance:
/// so the distance between two nodes along x shrinks by a third at most.
constexpr double reach = 3;

Vec3 centre_of(const Mesh& mesh, int element) {
  return hexahedron_centre(corners_of(mesh.nodes, mesh.elements[element]));
}

/// A seam of a case, and z of the mesh's upper surface over its place: its depth is measured from there.
struct Crack {
  const scene::Seam& seam;
  std::string place;  ///< "FILE:LINE: [seams.NAME]"
  double surface;     ///< m

  /// Along the seam's plane, m.
  double depth_of(const Vec3& x) const { return (surface - x[2]) / std::cos(seam.angle); }
  bool has(const LayerFace& face) const {
    return std::fabs(face.centre[1] - seam.place[1]) <= 0.5 * seam.length && depth_of(face.centre) <= seam.depth;
  }
};

std::string at(const Vec3& x) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x[0], x[1], x[2]); }

/// The mesh's upper surface over the seam's place, which has to lie on it but for an element's height.
double surface_over(const scene::Seam& seam, const std::string& place, const Mesh& mesh) {
  const SurfaceAbove surface(mesh);
  const auto top = surface.over(seam.place[0], seam.place[1]);
  if (!top)
    throw InputError(
        fmt::format("{} place: {} lies beside the mesh: its upper surface is nowhere over or under it; the nearest "
                    "place on it is {}",
                    place, at(seam.place), at(surface.nearest(seam.place))));
  const double above = seam.place[2] - top->z;
  if (std::fabs(above) > top->element_height)
    throw InputError(
        fmt::format("{} place: {} is {:.4g} m {} the mesh's upper surface, from which the depth is measured; the "
                    "nearest place on it is {}",
                    place, at(seam.place), std::fabs(above), above > 0 ? "above" : "below",
                    at({seam.place[0], seam.place[1], top->z})));
  return top->z;
}

/// Faces across x with an element at both sides, by layer (x in units of a tolerance).
std::map<long, std::vector<LayerFace>> layers_within(const Crack& crack, const Mesh& mesh, double tolerance) {
  std::map<std::array<int, 4>, Face> open;
  std::map<long, std::vector<LayerFace>> layers;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      auto nodes = mesh.face_nodes({e, side});
      const double x = mesh.nodes[nodes[0]][0];
      if (!std::all_of(nodes.begin(), nodes.end(), [&](int n) { return std::fabs(mesh.nodes[n][0] - x) < tolerance; }))
        continue;
      LayerFace face;
      face.centre = facet_centre(mesh.nodes, nodes);
      if (!crack.has(face)) continue;
      face.area = 0.5 * length(doubled_area(mesh.nodes, nodes));
      std::sort(nodes.begin(), nodes.end());
      const auto other = open.find(nodes);
      if (other == open.end()) {
        open[nodes] = {e, side};
        continue;
      }
      face.nodes = nodes;
      const bool first_before = centre_of(mesh, other->second.element)[0] < x;
      face.before = first_before ? other->second : Face{e, side};
      face.behind = first_before ? Face{e, side} : other->second;
      layers[std::lround(x / tolerance)].push_back(face);
    }
  return layers;
}

/// The layer nearest to the mouth of those that have faces over the whole seam: deeper layers of a mesh may be coarser.
std::vector<LayerFace> chosen_layer(const scene::Seam& seam, const std::map<long, std::vector<LayerFace>>& layers) {
  const auto area = [](const std::vector<LayerFace>& faces) {
    double sum = 0;
    for (const LayerFace& face : faces) sum += face.area;
    return sum;
  };
  double largest = 0;
  for (const auto& [x, faces] : layers) largest = std::max(largest, area(faces));
  const std::vector<LayerFace>* best = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [x, faces] : layers) {
    const double off = std::fabs(faces.front().centre[0] - seam.place[0]);
    if (area(faces) < 0.98 * largest || off >= nearest) continue;
    nearest = off;
    best = &faces;
  }
  return best ? *best : std::vector<LayerFace>{};
}

/// The extents of these faces' nodes: along y, and down from the surface along the seam's plane, m.
struct Extent {
  double length = 0, depth = 0;
};

Extent extent_of(const Crack& crack, const Mesh& mesh, const std::vector<LayerFace>& faces) {
  double low = std::numeric_limits<double>::infinity(), high = -low, deepest = 0;
  for (const LayerFace& face : faces)
    for (int n : face.nodes) {
      low = std::min(low, mesh.nodes[n][1]);
      high = std::max(high, mesh.nodes[n][1]);
      deepest = std::max(deepest, crack.depth_of(mesh.nodes[n]));
    }
  return {high - low, deepest};
}

/// How large a seam has to be here to open anything, by the element under its place.
std::string least_size(const scene::Seam& seam, const Mesh& mesh) {
  const auto element = SurfaceAbove(mesh).over(seam.place[0], seam.place[1]);
  if (!element) return "larger than the elements are";
  return fmt::format("at least two elements ({:.4g} m) long and one ({:.4g} m) deep", 2 * element->element_width,
                     element->element_height);
}

/// Moves the layer of these faces onto the seam's plane, and what is beside it by less.
void incline(const scene::Seam& seam, const std::string& place, const std::vector<LayerFace>& faces, Mesh& mesh) {
  const double slope = std::tan(seam.angle), x = faces.front().centre[0];
  double deepest = 0;
  for (const LayerFace& face : faces)
    for (int n : face.nodes) deepest = std::max(deepest, seam.place[2] - mesh.nodes[n][2]);
  const auto move = [&](const Vec3& at) {
    return seam.place[0] - x + slope * std::clamp(seam.place[2] - at[2], 0.0, deepest);
  };
  double largest = 0, first = x, last = x;
  for (const Vec3& at : mesh.nodes) {
    largest = std::max(largest, std::fabs(move(at)));
    first = std::min(first, at[0]);
    last = std::max(last, at[0]);
  }
  const double range = reach * largest;
  if (x - range < first || x + range > last)
    throw InputError(
        fmt::format("{}: nodes up to {:.4g} m beside x = {:.6g} would have to move onto its plane, beyond the mesh's "
                    "end; place the "
                    "seam farther from the end, or make it less deep or less inclined",
                    place, range, x));
  for (Vec3& at : mesh.nodes) {
    const double beside = std::fabs(at[0] - x);
    if (beside < range) at[0] += (1 - beside / range) * move(at);
  }
}

/// Nodes of the seam that both sides keep in common: the crack front inside the mesh.
std::set<int> front_of(const Mesh& mesh, const std::vector<LayerFace>& faces) {
  std::map<std::array<int, 2>, int> edges;
  const auto edges_of = [&](const std::array<int, 4>& corner, const auto& visit) {
    for (int k = 0; k < 4; ++k)
      visit(std::array<int, 2>{std::min(corner[k], corner[(k + 1) % 4]), std::max(corner[k], corner[(k + 1) % 4])});
  };
  for (const LayerFace& face : faces) edges_of(mesh.face_nodes(face.before), [&](auto edge) { ++edges[edge]; });
  // The seam may end on the mesh's outside: there it is open.
  std::set<std::array<int, 2>> outside;
  for (const Face& face : FaceTable(mesh).exterior())
    edges_of(mesh.face_nodes(face), [&](auto edge) { outside.insert(edge); });
  std::set<int> front;
  for (const auto& [edge, count] : edges)
    if (count == 1 && outside.count(edge) == 0) front.insert(edge.begin(), edge.end());
  return front;
}

/// Nodes of these faces that the seam opens, as keys; the values become the numbers of their duplicates.
std::map<int, int> opened_by(const Crack& crack, const std::vector<LayerFace>& faces, const Mesh& mesh) {
  const std::set<int> front = front_of(mesh, faces);
  std::map<int, int> twin;
  for (const LayerFace& face : faces)
    for (int n : face.nodes)
      if (front.count(n) == 0) twin.emplace(n, 0);
  if (twin.empty())
    throw InputError(
        fmt::format("{}: opens no node: of its {} element face{} all nodes lie on its front, which stays whole; make "
                    "it {}, or the elements smaller",
                    crack.place, faces.size(), faces.size() == 1 ? "" : "s", least_size(crack.seam, mesh)));
  return twin;
}

/// The elements beside these faces are to keep two thirds of their length: each face takes half the width from them.
void expect_room(const Crack& crack, const std::vector<LayerFace>& faces, const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const LayerFace& face : faces)
    for (const Face& beside : {face.before, face.behind})
      shortest = std::min(shortest, hexahedron_length(corners_of(mesh.nodes, mesh.elements[beside.element])));
  const double most = 2.0 / 3 * shortest;
  if (crack.seam.width > most)
    throw InputError(
        fmt::format("{} width = {:g} m is too wide for the elements beside it, the least {:.4g} m long; allowed: up to "
                    "{:.4g} m, or larger elements",
                    crack.place, crack.seam.width, shortest, most));
}

/// Duplicates the opened nodes: the elements behind the seam get the duplicates. Both sides' nodes draw apart by half
/// the width each.
void part(const scene::Seam& seam, const std::vector<LayerFace>& faces, std::map<int, int> twin, Mesh& mesh) {
  for (auto& [n, own] : twin) {
    own = static_cast<int>(mesh.nodes.size());
    mesh.nodes.push_back(Vec3(mesh.nodes[n]));
  }
  const double slope = std::tan(seam.angle);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    auto& corners = mesh.elements[e];
    if (std::none_of(corners.begin(), corners.end(), [&](int n) { return twin.count(n) != 0; })) continue;
    const Vec3 centre = centre_of(mesh, e);
    if (centre[0] - seam.place[0] - slope * (seam.place[2] - centre[2]) < 0) continue;
    for (int& n : corners)
      if (const auto own = twin.find(n); own != twin.end()) n = own->second;
  }
  for (auto& [name, nodes] : mesh.node_sets) {
    std::vector<int> more;
    for (int n : nodes)
      if (const auto own = twin.find(n); own != twin.end()) more.push_back(own->second);
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  const double apart = 0.5 * seam.width / std::cos(seam.angle);
  for (const auto& [n, own] : twin) {
    mesh.nodes[n][0] -= apart;
    mesh.nodes[own][0] += apart;
  }
  for (const LayerFace& face : faces) {
    mesh.surfaces[seam.name + "_before"].push_back(face.before);
    mesh.surfaces[seam.name + "_behind"].push_back(face.behind);
  }
}

}  // namespace

OpenedSeam open_seam(const scene::Seam& seam, const std::string& place, Mesh& mesh) {
  for (const char* side : {"_before", "_behind"})
    if (mesh.surfaces.count(seam.name + side) != 0)
      throw InputError(
          fmt::format("{}: the mesh has a surface '{}{}' already; choose another name", place, seam.name, side));
  const Crack crack{seam, place, surface_over(seam, place, mesh)};
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& element : mesh.elements)
    shortest = std::min(shortest, hexahedron_length(corners_of(mesh.nodes, element)));
  const auto faces = chosen_layer(seam, layers_within(crack, mesh, 1e-4 * shortest));
  if (faces.empty())
    throw InputError(
        fmt::format("{}: no layer of element faces across x lies within its length and depth below z = {:.6g}, so that "
                    "it opens no node; make it {}, or move "
                    "`place` along the mesh",
                    place, crack.surface, least_size(seam, mesh)));
  const auto twins = opened_by(crack, faces, mesh);
  const Extent extent = extent_of(crack, mesh, faces);
  const int bodies = connected_bodies(mesh);
  incline(seam, place, faces, mesh);
  expect_room(crack, faces, mesh);
  part(seam, faces, twins, mesh);
  if (connected_bodies(mesh) > bodies)
    throw InputError(
        fmt::format("{}: cuts the body in two: it became {:.4g} m long and {:.4g} m deep, through all of it; make its "
                    "depth less than {:.4g} m, its length less, or "
                    "make two meshes of the two bodies",
                    place, extent.length, extent.depth, extent.depth));
  OpenedSeam opened;
  opened.nodes = static_cast<int>(twins.size());
  opened.faces = static_cast<int>(faces.size());
  opened.length = extent.length;
  opened.depth = extent.depth;
  return opened;
}

std::string describe(const scene::Seam& seam, const OpenedSeam& opened) {
  return fmt::format(
      "[seams.{}] (line {}) opens {} node{} of mesh {} between {} pairs of element faces: {:.4g} m long ({:.4g} m "
      "asked for), {:.4g} m deep ({:.4g} m asked for)",
      seam.name, seam.line, opened.nodes, opened.nodes == 1 ? "" : "s", seam.mesh, opened.faces, opened.length,
      seam.length, opened.depth, seam.depth);
}

}  // namespace railwave
