#include "model/sets/place_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/error.hpp"
#include "mesh/vectors.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {
namespace {

/// How far a node is from what the set asks for, m: outside its box, or from its position.
double distance_from(const scene::NodeSet& set, const Vec3& x) {
  return set.box ? distance_outside(*set.box, x) : length(difference(*set.position, x));
}

/// Longest edge of the elements around a node, m.
double size_around(const Assembly& assembly, int node) {
  constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  double longest = 0;
  for (const auto& element : assembly.elements) {
    if (std::find(element.begin(), element.end(), node) == element.end()) continue;
    for (const auto& edge : edges)
      longest =
          std::max(longest, length(difference(assembly.nodes[element[edge[0]]], assembly.nodes[element[edge[1]]])));
  }
  return longest;
}

/// The section that made the set, as the case file has it.
std::string section_of(const scene::Scene& scene, const scene::NodeSet& set) {
  const auto made = [&](const auto& entries) {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const auto& entry) { return entry.part == set.part && entry.line == set.line; });
  };
  return made(scene.hammers) ? "hammers" : made(scene.probes) ? "probes" : "node_sets";
}

}  // namespace

void add_node_sets(const scene::Scene& scene, Assembly& assembly) {
  for (const scene::NodeSet& set : scene.node_sets) {
    const auto where = fmt::format("{}:{}: [{}.{}]", scene.path, set.line, section_of(scene, set), set.name);
    const auto name = set.part + "." + set.name;
    if (assembly.node_sets.count(name) != 0 || assembly.element_sets.count(name) != 0)
      throw InputError(
          fmt::format("{}: the part '{}' has a set '{}' already; choose another name", where, set.part, set.name));
    const bool of_surface = !set.surface.empty();
    if (of_surface) find_surface(scene, assembly, set, "surface", set.part + "." + set.surface);
    const auto& candidates = assembly.node_sets.at(of_surface ? set.part + "." + set.surface : set.part);
    const double reach = set.box ? place_slack : set.radius + place_slack;
    std::vector<int> nodes;
    int nearest = candidates.front();
    for (int n : candidates) {
      if (distance_from(set, assembly.nodes[n]) <= reach) nodes.push_back(n);
      if (distance_from(set, assembly.nodes[n]) < distance_from(set, assembly.nodes[nearest])) nearest = n;
    }
    if (nodes.empty() && set.position) nodes.push_back(nearest);
    if (nodes.empty())
      throw InputError(fmt::format("{} box: no node of '{}' is in it; the nearest is at {} m, {:.4g} m away", where,
                                   of_surface ? set.part + "." + set.surface : set.part,
                                   text_of(assembly.nodes[nearest]),
                                   distance_outside(*set.box, assembly.nodes[nearest])));
    std::sort(nodes.begin(), nodes.end());
    if (of_surface) {
      std::vector<Face> faces;
      for (const Face& face : assembly.surfaces.at(set.part + "." + set.surface)) {
        const auto corners = assembly.face_nodes(face);
        if (std::all_of(corners.begin(), corners.end(),
                        [&](int n) { return std::binary_search(nodes.begin(), nodes.end(), n); }))
          faces.push_back(face);
      }
      if (!faces.empty()) assembly.surfaces[name] = std::move(faces);
    }
    assembly.node_sets[name] = std::move(nodes);
  }
}

std::vector<PlacedSet> placed_sets(const scene::Scene& scene, const Assembly& assembly) {
  std::vector<PlacedSet> result;
  for (const scene::NodeSet& set : scene.node_sets) {
    if (!set.position) continue;
    const auto& nodes = assembly.node_sets.at(set.part + "." + set.name);
    PlacedSet placed{&set, static_cast<int>(nodes.size()), nodes.front(), 0, {}};
    for (int n : nodes)
      if (distance_from(set, assembly.nodes[n]) < distance_from(set, assembly.nodes[placed.nearest]))
        placed.nearest = n;
    placed.distance = distance_from(set, assembly.nodes[placed.nearest]);
    const double size = size_around(assembly, placed.nearest);
    const bool moved = std::any_of(scene.contacts.begin(), scene.contacts.end(), [&](const scene::Contact& contact) {
      return contact.close_gap &&
             contact.slave.rfind(set.part + ".", 0) == 0;  // to where it touches, after sets were made
    });
    if (placed.distance > set.radius + size && !moved)
      placed.warning = fmt::format(
          "{}.{} (line {}) is asked for at {} m, but the nearest node{} is {:.3g} m away, at {} m, farther than an "
          "element's size ({:.3g} m): see "
          "whether the position is meant in the scene's axes",
          set.part, set.name, set.line, text_of(*set.position), set.surface.empty() ? "" : " of " + set.surface,
          placed.distance, text_of(assembly.nodes[placed.nearest]), size);
    else if (section_of(scene, set) == std::string("hammers") && set.radius < 0.5 * size)
      placed.warning = fmt::format(
          "[hammers.{}] (line {}) strikes within {:.3g} m of its position, among elements of {:.3g} m, which give way "
          "under so small a patch as no "
          "body does; take a radius of half an element or more, or smaller elements there",
          set.name, set.line, set.radius, size);
    result.push_back(placed);
  }
  return result;
}

}  // namespace railwave
