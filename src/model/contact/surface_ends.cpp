#include "model/contact/surface_ends.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/build_mesh.hpp"
#include "mesh/vectors.hpp"

namespace railwave {
namespace {

using Corners = std::array<int, 4>;
using Edge = std::array<int, 2>;

constexpr double sharp = 0.5;        ///< cosine of 60 degrees
constexpr double reach_of_gap = 10;  ///< in facets' diagonals, that a surface may be broken and yet go on
constexpr double ahead = 0.5;        ///< cosine of the angle from the outward direction within which it goes on
constexpr double coarse = 2;         ///< over the zone's element size

Edge edge_of(const Corners& corners, int side) {
  const int a = corners[side], b = corners[(side + 1) % 4];
  return {std::min(a, b), std::max(a, b)};
}

Vec3 normal_of(const std::vector<Vec3>& x, const Corners& c) {
  const Vec3 n = doubled_area(x, c);
  const double size = length(n);
  return size > 0 ? Vec3{n[0] / size, n[1] / size, n[2] / size} : n;
}

Vec3 mean(const std::vector<Vec3>& x, const int* nodes, int count) {
  Vec3 sum{0, 0, 0};
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < 3; ++i) sum[i] += x[nodes[k]][i] / count;
  return sum;
}

double diagonal(const std::vector<Vec3>& x, const Corners& c) {
  return std::max(length(difference(x[c[2]], x[c[0]])), length(difference(x[c[3]], x[c[1]])));
}

/// A facet at an end of a surface.
struct OpenRim {
  Vec3 middle, normal;
  double diagonal;
  Corners corners;
};

/// The skin's other facets at each of some edges: faces that belong to one element only.
std::map<Edge, std::vector<Corners>> skin_at(const Assembly& assembly, const std::map<Edge, int>& edges) {
  std::vector<char> marked(assembly.nodes.size(), 0);
  for (const auto& [edge, facet] : edges) marked[edge[0]] = marked[edge[1]] = 1;
  std::map<Corners, std::pair<int, Corners>> faces;  // by sorted nodes: elements that have it
  for (int e = 0; e < static_cast<int>(assembly.elements.size()); ++e) {
    const auto& element = assembly.elements[e];
    if (std::count_if(element.begin(), element.end(), [&](int n) { return marked[n] != 0; }) < 2) continue;
    for (int side = 0; side < 6; ++side) {
      const Corners corners = assembly.face_nodes({e, side});
      Corners sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      auto& face = faces[sorted];
      ++face.first;
      face.second = corners;
    }
  }
  std::map<Edge, std::vector<Corners>> found;
  for (const auto& [sorted, face] : faces)
    for (int k = 0; face.first == 1 && k < 4; ++k)
      if (const Edge edge = edge_of(face.second, k); edges.count(edge) != 0) found[edge].push_back(face.second);
  return found;
}

std::vector<Corners> facets_of(const std::vector<int>& nodes, const std::vector<Corners>& facets) {
  std::vector<Corners> result = facets;
  for (Corners& facet : result)
    for (int& n : facet) n = nodes[n];
  return result;
}

}  // namespace

Vec3 outward(const std::vector<Vec3>& place, const std::array<int, 4>& corners, int side) {
  Vec3 out = cross(difference(place[corners[(side + 1) % 4]], place[corners[side]]), normal_of(place, corners));
  const double size = length(out);
  for (double& c : out) c = size > 0 ? c / size : 0;
  return out;
}

double longest_side(const std::vector<Vec3>& place, const std::array<int, 4>& corners) {
  double longest = 0;
  for (int k = 0; k < 4; ++k)
    longest = std::max(longest, length(difference(place[corners[(k + 1) % 4]], place[corners[k]])));
  return longest;
}

SurfaceEnds surface_ends(const Assembly& assembly, std::vector<std::array<int, 4>> corners,
                         const std::vector<std::vector<std::array<int, 4>>>& others) {
  const auto& x = assembly.nodes;
  SurfaceEnds ends;
  ends.corners = std::move(corners);
  ends.beyond.assign(ends.corners.size(), Corners{});
  std::map<Edge, std::vector<std::array<int, 2>>> sides;  // facet, side
  for (int f = 0; f < static_cast<int>(ends.corners.size()); ++f)
    for (int k = 0; k < 4; ++k) sides[edge_of(ends.corners[f], k)].push_back({f, k});
  std::map<Edge, int> open;
  for (const auto& [edge, around] : sides) {
    if (around.size() == 1) open[edge] = around[0][0];
    for (std::size_t i = 0; around.size() > 1 && i < around.size(); ++i)
      ends.beyond[around[i][0]][around[i][1]] = around[i == 0 ? 1 : 0][0];
  }
  if (open.empty()) return ends;

  // Where the surface goes on: facets at its own ends and at those of the others.
  std::vector<OpenRim> rims;
  const auto add_rim = [&](const std::vector<Corners>& facets) {
    std::map<Edge, int> count;
    for (const Corners& facet : facets)
      for (int k = 0; k < 4; ++k) ++count[edge_of(facet, k)];
    for (const Corners& facet : facets)
      for (int k = 0; k < 4; ++k)
        if (count[edge_of(facet, k)] == 1) {
          rims.push_back({mean(x, facet.data(), 4), normal_of(x, facet), diagonal(x, facet), facet});
          break;
        }
  };
  add_rim(ends.corners);
  for (const auto& other : others) add_rim(other);

  const auto skin = skin_at(assembly, open);
  for (const auto& [edge, facet] : open) {
    const int side = sides[edge][0][1];
    const Corners& own = ends.corners[facet];
    const Vec3 middle = mean(x, edge.data(), 2), out = outward(x, own, side), normal = normal_of(x, own);
    const double reach = reach_of_gap * diagonal(x, own);
    const bool goes_on = std::any_of(rims.begin(), rims.end(), [&](const OpenRim& other) {
      const Vec3 way = difference(other.middle, middle);
      const double far = reach + 0.5 * other.diagonal, square = dot(way, way);
      return square < far * far && dot(way, out) > ahead * std::sqrt(square) && dot(normal, other.normal) > sharp &&
             other.corners != own;
    });
    Beyond what = goes_on ? Beyond::goes_on : Beyond::body_ends;
    const auto around = skin.find(edge);
    if (!goes_on && around != skin.end())
      for (const Corners& face : around->second) {
        Corners a = face, b = own;
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        if (a != b && dot(normal, normal_of(x, face)) > sharp) what = Beyond::set_ends;
      }
    ends.beyond[facet][side] = static_cast<int>(what);
  }
  return ends;
}

std::array<SurfaceEnds, 2> pair_ends(const Assembly& assembly, const std::vector<ContactPair>& contacts,
                                     const ContactPair& pair) {
  const auto part = [&](const std::vector<int>& nodes) {
    return nodes.empty() ? -1 : part_of_node(assembly, nodes.front());
  };
  const int slave = part(pair.slave_nodes), master = part(pair.master_nodes);
  std::array<std::vector<std::vector<Corners>>, 2> others;
  for (const ContactPair& other : contacts) {
    if (other.contact == pair.contact) continue;
    for (const bool exchanged : {false, true}) {
      const auto& its_slaves = exchanged ? other.master_nodes : other.slave_nodes;
      const auto& its_masters = exchanged ? other.slave_nodes : other.master_nodes;
      const auto& slave_facets = exchanged ? other.master_segments : other.slave_facets;
      const auto& master_facets = exchanged ? other.slave_facets : other.master_segments;
      if (part(its_slaves) == slave) others[1].push_back(facets_of(its_masters, master_facets));
      if (part(its_masters) == master) others[0].push_back(facets_of(its_slaves, slave_facets));
    }
  }
  return {surface_ends(assembly, facets_of(pair.slave_nodes, pair.slave_facets), others[0]),
          surface_ends(assembly, facets_of(pair.master_nodes, pair.master_segments), others[1])};
}

double finest_wanted(const scene::Scene& scene, const std::string& part) {
  const scene::Part* own = find_entry(scene.parts, part);
  if (own == nullptr) return 0;
  const scene::MeshSource* mesh = find_entry(scene.meshes, own->mesh);
  if (mesh == nullptr) return 0;
  return coarse * fine_element_size(*mesh);
}

}  // namespace railwave
