#include "model/sets/place_sets.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {
namespace {

/// Natural coordinates by which rounding may put a place outside the element on whose face it lies.
constexpr double on_the_face = 1e-6;

/// The same of a place beside a faceted surface that stands for a curved one.
constexpr double beside_a_facet = 0.1;

/// May an element hold the place, or lie right beside it?
bool is_near(const std::array<Vec3, 8>& corners, const Vec3& place) {
  for (int i = 0; i < 3; ++i) {
    double low = corners[0][i], high = low;
    for (const Vec3& corner : corners) {
      low = std::fmin(low, corner[i]);
      high = std::fmax(high, corner[i]);
    }
    const double margin = beside_a_facet * (high - low);
    if (place[i] < low - margin || place[i] > high + margin) return false;
  }
  return true;
}

/// The element that a place lies in, or the nearest.
struct Found {
  int element = -1;
  double outside = std::numeric_limits<double>::infinity();  ///< largest natural coordinate
};

/// Of elements that share the face on which a place lies the first one counts.
Found find_element(const Assembly& assembly, const std::vector<int>& candidates, const Vec3& place) {
  Found in;
  for (int e : candidates) {
    const auto corners = corners_of(assembly.nodes, assembly.elements[e]);
    if (!is_near(corners, place)) continue;
    const double outside = largest_natural_coordinate(corners, place);
    if (outside < in.outside - on_the_face) in = {e, outside};
  }
  if (in.outside <= 1 + beside_a_facet) return in;
  Found nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int e : candidates) {
    const double away = length(difference(element_centre(assembly, e), place));
    if (away < least - place_slack) least = away, nearest.element = e;
  }
  return nearest;
}

std::vector<int> candidates_of(const scene::Scene& scene, const Assembly& assembly, const scene::ElementSet& set) {
  if (set.surface.empty()) return assembly.element_sets.at(set.part);
  std::vector<int> elements;
  for (const Face& face : find_surface(scene, assembly, set, "surface", set.part + "." + set.surface))
    elements.push_back(face.element);
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

bool made_by_probe(const scene::Scene& scene, const scene::ElementSet& set) {
  return std::any_of(scene.probes.begin(), scene.probes.end(),
                     [&](const scene::Probe& probe) { return probe.part == set.part && probe.line == set.line; });
}

std::vector<int> in_box(const Assembly& assembly, const std::vector<int>& candidates, const scene::Box& box,
                        const std::string& where, const std::string& whose) {
  std::vector<int> elements;
  int nearest = candidates.front();
  const auto away = [&](int e) { return distance_outside(box, element_centre(assembly, e)); };
  for (int e : candidates) {
    if (away(e) <= place_slack) elements.push_back(e);
    if (away(e) < away(nearest)) nearest = e;
  }
  if (elements.empty())
    throw InputError(
        fmt::format("{} box: no element of '{}' has its centre in it; the nearest has it at {} m, {:.4g} m away", where,
                    whose, text_of(element_centre(assembly, nearest)), away(nearest)));
  return elements;
}

}  // namespace

Vec3 element_centre(const Assembly& assembly, int element) {
  return hexahedron_centre(corners_of(assembly.nodes, assembly.elements[element]));
}

Vec3 natural_coordinates(const std::array<Vec3, 8>& corners, const Vec3& place) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const auto& sign = hexahedron_corner_signs;
  constexpr int most_iterations = 30;
  Eigen::Vector3d xi = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Eigen::Vector3d missed(place[0], place[1], place[2]);
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector3d x(corners[k][0], corners[k][1], corners[k][2]);
      const double a = 1 + sign[k][0] * xi[0], b = 1 + sign[k][1] * xi[1], c = 1 + sign[k][2] * xi[2];
      missed -= 0.125 * a * b * c * x;
      slope.col(0) += 0.125 * sign[k][0] * b * c * x;
      slope.col(1) += 0.125 * sign[k][1] * a * c * x;
      slope.col(2) += 0.125 * sign[k][2] * a * b * x;
    }
    const Eigen::Vector3d more = slope.partialPivLu().solve(missed);
    if (!more.allFinite()) break;
    xi += more;
    if (more.lpNorm<Eigen::Infinity>() < 1e-12) return {xi[0], xi[1], xi[2]};
    if (xi.lpNorm<Eigen::Infinity>() > 1e3) break;
  }
  // Right at rounding Newton's method may not settle any further.
  if (!xi.allFinite() || xi.lpNorm<Eigen::Infinity>() >= 1e3) return {nowhere, nowhere, nowhere};
  return {xi[0], xi[1], xi[2]};
}

double largest_natural_coordinate(const std::array<Vec3, 8>& corners, const Vec3& place) {
  const Vec3 xi = natural_coordinates(corners, place);
  return std::max({std::fabs(xi[0]), std::fabs(xi[1]), std::fabs(xi[2])});
}

void add_element_sets(const scene::Scene& scene, Assembly& assembly) {
  for (const scene::ElementSet& set : scene.element_sets) {
    const bool of_probe = made_by_probe(scene, set);
    const auto where =
        fmt::format("{}:{}: [{}.{}]", scene.path, set.line, of_probe ? "probes" : "element_sets", set.name);
    const auto name = set.part + "." + set.name;
    // A probe's nodes and its elements have one name.
    const bool own_nodes =
        of_probe && std::any_of(scene.node_sets.begin(), scene.node_sets.end(), [&](const scene::NodeSet& nodes) {
          return nodes.part == set.part && nodes.name == set.name && nodes.line == set.line;
        });
    if (assembly.element_sets.count(name) != 0 || (assembly.node_sets.count(name) != 0 && !own_nodes))
      throw InputError(
          fmt::format("{}: the part '{}' has a set '{}' already; choose another name", where, set.part, set.name));
    const auto candidates = candidates_of(scene, assembly, set);
    if (set.box) {
      assembly.element_sets[name] =
          in_box(assembly, candidates, *set.box, where, set.surface.empty() ? set.part : set.part + "." + set.surface);
      continue;
    }
    std::vector<int> elements{find_element(assembly, candidates, *set.position).element};
    if (set.radius > 0)
      for (int e : candidates)
        if (length(difference(element_centre(assembly, e), *set.position)) <= set.radius + place_slack &&
            e != elements.front())
          elements.push_back(e);
    std::sort(elements.begin(), elements.end());
    assembly.element_sets[name] = std::move(elements);
  }
}

std::vector<PlacedElements> placed_element_sets(const scene::Scene& scene, const Assembly& assembly) {
  std::vector<PlacedElements> result;
  for (const scene::ElementSet& set : scene.element_sets) {
    if (!set.position) continue;
    const auto& elements = assembly.element_sets.at(set.part + "." + set.name);
    const Found found = find_element(assembly, elements, *set.position);
    PlacedElements placed{
        &set, static_cast<int>(elements.size()), found.element, element_centre(assembly, found.element), 0, {}};
    placed.distance = length(difference(placed.centre, *set.position));
    // Sets are made before the part is moved to where it touches, or turned.
    const bool moved = std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                   [&](const scene::Contact& contact) {
                                     return contact.close_gap && contact.slave.rfind(set.part + ".", 0) == 0;
                                   }) ||
                       std::any_of(scene.parts.begin(), scene.parts.end(), [&](const scene::Part& part) {
                         return part.name == set.part && part.angle_of_attack != 0;
                       });
    if (found.outside > 1 + beside_a_facet && !moved)
      placed.warning = fmt::format(
          "{}.{} (line {}) is asked for at {} m, which lies in no element of the {}: stress and strain are those of "
          "the element with the nearest "
          "centre, {:.3g} m away at {} m; see whether the position is meant in the scene's axes",
          set.part, set.name, set.line, text_of(*set.position), set.surface.empty() ? "part" : "surface " + set.surface,
          placed.distance, text_of(placed.centre));
    result.push_back(placed);
  }
  return result;
}

}  // namespace railwave
