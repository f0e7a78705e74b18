#include "mesh/extrusion.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/mesh_memory.hpp"

namespace railwave {

namespace {

class Extruder {
 public:
  Extruder(const SectionMesh& section, const Stations& stations, const Placement& place, bool turned)
      : section_(section), stations_(stations), place_(place), turned_(turned) {
    const double nodes = static_cast<double>(section.nodes.size()) * static_cast<double>(stations.position.size());
    expect_mesh_memory(extruded_elements(section, stations), nodes);
    node_at_.assign(section.nodes.size() * stations.position.size(), -1);
  }

  Extrusion run() {
    for (std::size_t q = 0; q < section_.quads.size(); ++q) {
      const SectionQuad& quad = section_.quads[q];
      if (quad.transition)
        add_transition(static_cast<int>(q));
      else
        add_plain(static_cast<int>(q));
    }
    return std::move(result_);
  }

 private:
  /// The cells of a level as pairs of stations.
  std::vector<std::pair<int, int>> cells(int level) const {
    const auto& kept = stations_.levels[level];
    std::vector<std::pair<int, int>> result;
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) result.push_back({kept[i], kept[i + 1]});
    if (stations_.periodic) result.push_back({kept.back(), kept.front()});
    return result;
  }

  int node(int section_node, int station) {
    int& number = node_at_[section_node * stations_.position.size() + station];
    if (number < 0)
      number = add_node(section_node, station, section_.position(section_node), stations_.position[station]);
    return number;
  }

  int add_node(int section_node, int station, Point2 point, double coordinate) {
    result_.mesh.nodes.push_back(place_(point, coordinate));
    result_.section_node.push_back(section_node);
    result_.station.push_back(station);
    return static_cast<int>(result_.mesh.nodes.size()) - 1;
  }

  /// Inner node of a template in the plane of a lower and an upper section node, moved from `station` towards the
  /// template's middle.
  int inner_node(int lower, int upper, int station, double towards_middle) {
    const auto key = std::make_pair(std::make_pair(lower, upper), station);
    const auto found = inner_.find(key);
    if (found != inner_.end()) return found->second;
    const Point2 point =
        (1 - transition_depth) * section_.position(lower) + transition_depth * section_.position(upper);
    return inner_[key] = add_node(-1, station, point, stations_.position[station] + towards_middle);
  }

  void add_element(CornerNodes nodes, int quad, int station) {
    if (turned_)
      for (int i = 0; i < 4; ++i) std::swap(nodes[i], nodes[i + 4]);
    result_.mesh.elements.push_back(nodes);
    result_.section_quad.push_back(quad);
    result_.first_station.push_back(station);
  }

  void add_plain(int number) {
    const SectionQuad& quad = section_.quads[number];
    for (const auto& [first, last] : cells(quad.level)) {
      CornerNodes nodes{};
      for (int i = 0; i < 4; ++i) {
        nodes[i] = node(quad.nodes[i], first);
        nodes[i + 4] = node(quad.nodes[i], last);
      }
      add_element(nodes, number, first);
    }
  }

  void add_transition(int number) {
    const SectionQuad& quad = section_.quads[number];
    const auto& fine = stations_.levels[quad.level];
    for (const auto& [first, last] : cells(quad.level + 1)) {
      const std::size_t begin = std::lower_bound(fine.begin(), fine.end(), first) - fine.begin();
      std::vector<int> at{first};
      for (std::size_t i = begin; at.back() != last || at.size() == 1;) {
        i = (i + 1) % fine.size();
        at.push_back(fine[i]);
      }
      add_template(number, at);
    }
  }

  void add_template(int number, const std::vector<int>& at) {
    const SectionQuad& quad = section_.quads[number];
    // Side 0 holds corners 0 and 3, side 1 corners 1 and 2; each point of the plane template once on both sides.
    using Edge = std::array<int, 2>;
    const auto on = [&](int corner_a, int corner_b, int station) {
      return Edge{node(quad.nodes[corner_a], station), node(quad.nodes[corner_b], station)};
    };
    const auto hexahedron = [&](Edge p0, Edge p1, Edge p2, Edge p3) {
      add_element({p0[0], p0[1], p3[1], p3[0], p1[0], p1[1], p2[1], p2[0]}, number, at[0]);
    };
    if (at.size() == 2) {
      hexahedron(on(0, 1, at[0]), on(0, 1, at[1]), on(3, 2, at[1]), on(3, 2, at[0]));
      return;
    }
    double middle = stations_.position[at[2]] - stations_.position[at[1]];
    if (middle < 0) middle += stations_.period;
    const double inset = transition_inset * middle;
    const auto inner = [&](int which) {
      const double shift = which == 1 ? inset : -inset;
      return Edge{inner_node(quad.nodes[0], quad.nodes[3], at[which], shift),
                  inner_node(quad.nodes[1], quad.nodes[2], at[which], shift)};
    };
    const Edge b0 = on(0, 1, at[0]), b3 = on(0, 1, at[3]), i1 = inner(1), i2 = inner(2);
    Edge t[4];
    for (int k = 0; k < 4; ++k) t[k] = on(3, 2, at[k]);
    hexahedron(b0, b3, i2, i1);
    hexahedron(b0, i1, t[1], t[0]);
    hexahedron(i1, i2, t[2], t[1]);
    hexahedron(b3, t[3], t[2], i2);
  }

  const SectionMesh& section_;
  const Stations& stations_;
  const Placement& place_;
  bool turned_;
  Extrusion result_;
  std::vector<int> node_at_;
  std::map<std::pair<std::pair<int, int>, int>, int> inner_;
};

}  // namespace

double extruded_elements(const SectionMesh& section, const Stations& stations) {
  double count = 0;
  for (const SectionQuad& quad : section.quads)
    count += static_cast<double>(quad.transition ? 4 * stations.levels[quad.level + 1].size()
                                                 : stations.levels[quad.level].size());
  return count;
}

Extrusion extrude(const SectionMesh& section, const Stations& stations, const Placement& place, bool turned) {
  return Extruder(section, stations, place, turned).run();
}

std::vector<Face> faces_on_edges(const Extrusion& extrusion, const std::vector<SectionEdge>& edges, int first,
                                 int last) {
  std::map<int, std::vector<int>> edges_of_quad;
  for (const SectionEdge& edge : edges) edges_of_quad[edge.quad].push_back(edge.edge);
  std::vector<Face> faces;
  for (std::size_t e = 0; e < extrusion.mesh.elements.size(); ++e) {
    const auto found = edges_of_quad.find(extrusion.section_quad[e]);
    const int station = extrusion.first_station[e];
    if (found == edges_of_quad.end() || station < first || station >= last) continue;
    for (int edge : found->second) faces.push_back({static_cast<int>(e), 2 + edge});
  }
  return faces;
}

std::vector<int> nodes_on_section_nodes(const Extrusion& extrusion, const std::vector<int>& section_nodes) {
  std::vector<int> sorted = section_nodes, nodes;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t n = 0; n < extrusion.section_node.size(); ++n)
    if (std::binary_search(sorted.begin(), sorted.end(), extrusion.section_node[n]))
      nodes.push_back(static_cast<int>(n));
  return nodes;
}

std::vector<Face> faces_at_station(const Extrusion& extrusion, int station) {
  std::vector<Face> faces;
  for (int e = 0; e < static_cast<int>(extrusion.mesh.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      const auto nodes = extrusion.mesh.face_nodes({e, side});
      const auto there = [&](int n) { return extrusion.section_node[n] >= 0 && extrusion.station[n] == station; };
      if (std::all_of(nodes.begin(), nodes.end(), there)) faces.push_back({e, side});
    }
  return faces;
}

std::vector<int> zone_elements(const Extrusion& extrusion, const SectionMesh& section, int first, int last) {
  std::vector<int> elements;
  for (std::size_t e = 0; e < extrusion.mesh.elements.size(); ++e) {
    const int station = extrusion.first_station[e];
    if (section.quads[extrusion.section_quad[e]].zone && station >= first && station < last)
      elements.push_back(static_cast<int>(e));
  }
  return elements;
}

}  // namespace railwave
