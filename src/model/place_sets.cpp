#include "model/place_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/error.hpp"

namespace railwave {
namespace {

/// m: what rounding may take a node out of a box on whose side it lies.
constexpr double slack = 1e-9;

/// How far outside the box a place is, m.
double distance(const scene::Box& box, const Vec3& x) {
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    const double outside = std::max({box[0][i] - x[i], x[i] - box[1][i], 0.0});
    squared += outside * outside;
  }
  return std::sqrt(squared);
}

std::string text_of(const Vec3& x) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x[0], x[1], x[2]); }

}  // namespace

void add_node_sets(const scene::Scene& scene, Assembly& assembly) {
  for (const scene::NodeSet& set : scene.node_sets) {
    const auto where = fmt::format("{}:{}: [node_sets.{}]", scene.path, set.line, set.name);
    const auto name = set.part + "." + set.name;
    if (assembly.node_sets.count(name) != 0 || assembly.element_sets.count(name) != 0)
      throw InputError(fmt::format("{}: the part '{}' has a set '{}' already; choose another name", where, set.part, set.name));
    const bool of_surface = !set.surface.empty();
    if (of_surface) find_surface(scene, assembly, set, "surface", set.part + "." + set.surface);
    const auto& candidates = assembly.node_sets.at(of_surface ? set.part + "." + set.surface : set.part);
    std::vector<int> nodes;
    int nearest = candidates.front();
    for (int n : candidates) {
      if (distance(*set.box, assembly.nodes[n]) <= slack) nodes.push_back(n);
      if (distance(*set.box, assembly.nodes[n]) < distance(*set.box, assembly.nodes[nearest])) nearest = n;
    }
    if (nodes.empty())
      throw InputError(fmt::format("{} box: no node of '{}' is in it; the nearest is at {} m, {:.4g} m away", where,
                                   of_surface ? set.part + "." + set.surface : set.part, text_of(assembly.nodes[nearest]),
                                   distance(*set.box, assembly.nodes[nearest])));
    std::sort(nodes.begin(), nodes.end());
    if (of_surface) {
      std::vector<Face> faces;
      for (const Face& face : assembly.surfaces.at(set.part + "." + set.surface)) {
        const auto corners = assembly.face_nodes(face);
        if (std::all_of(corners.begin(), corners.end(), [&](int n) { return std::binary_search(nodes.begin(), nodes.end(), n); }))
          faces.push_back(face);
      }
      if (!faces.empty()) assembly.surfaces[name] = std::move(faces);
    }
    assembly.node_sets[name] = std::move(nodes);
  }
}

}  // namespace railwave
