#include "model/checks/inside_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/vectors.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {

OutsideFaces::OutsideFaces(const Assembly& assembly) : assembly_(assembly) {
  const auto sorted = [&](const Face& face) {
    auto nodes = assembly.face_nodes(face);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  for (const auto& [name, surface] : assembly.surfaces)
    for (const Face& face : surface) owners_[sorted(face)] = 0;
  const int elements = owners_.empty() ? 0 : static_cast<int>(assembly.elements.size());
  std::vector<char> named(assembly.nodes.size(), 0);
  for (const auto& entry : owners_)
    for (int n : entry.first) named[n] = 1;
  for (int e = 0; e < elements; ++e)
    for (int side = 0; side < 6; ++side) {
      const Face face{e, side};
      const auto nodes = assembly.face_nodes(face);
      if (!std::all_of(nodes.begin(), nodes.end(), [&](int n) { return named[n] != 0; })) continue;
      const auto found = owners_.find(sorted(face));
      if (found != owners_.end()) ++found->second;
    }
}

bool OutsideFaces::has(const Face& face) const {
  auto nodes = assembly_.face_nodes(face);
  std::sort(nodes.begin(), nodes.end());
  const auto found = owners_.find(nodes);
  return found == owners_.end() || found->second < 2;
}

namespace {

constexpr double most_local = 0.9;  ///< of the half edges

Bounds bounds_of(const Assembly& assembly, const Assembly::PartRange& part) {
  Bounds bounds = no_bounds;
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n) widen(bounds, assembly.nodes[n]);
  return bounds;
}

Bounds common(const Bounds& a, const Bounds& b) {
  Bounds result;
  for (int i = 0; i < 3; ++i) {
    result[0][i] = std::max(a[0][i], b[0][i]);
    result[1][i] = std::min(a[1][i], b[1][i]);
  }
  return result;
}

/// Whether the element's own coordinates of a place are well inside it, by Newton's method on the trilinear map.
bool well_inside(const Assembly& assembly, const CornerNodes& element, const Vec3& x) {
  constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  Vec3 local{0, 0, 0};
  for (int iteration = 0; iteration < 12; ++iteration) {
    Vec3 off = x, column[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    for (int c = 0; c < 8; ++c) {
      double factor[3];
      for (int k = 0; k < 3; ++k) factor[k] = 0.5 * (1 + sign[c][k] * local[k]);
      const Vec3& corner = assembly.nodes[element[c]];
      for (int i = 0; i < 3; ++i) {
        off[i] -= factor[0] * factor[1] * factor[2] * corner[i];
        for (int k = 0; k < 3; ++k)
          column[k][i] += 0.5 * sign[c][k] * factor[(k + 1) % 3] * factor[(k + 2) % 3] * corner[i];
      }
    }
    const double determinant = dot(column[0], cross(column[1], column[2]));
    if (!(std::fabs(determinant) > 0)) return false;
    const Vec3 step = {dot(off, cross(column[1], column[2])) / determinant,
                       dot(off, cross(column[2], column[0])) / determinant,
                       dot(off, cross(column[0], column[1])) / determinant};
    double size = 0;
    for (int k = 0; k < 3; ++k) {
      local[k] += step[k];
      size = std::max(size, std::fabs(local[k]));
    }
    if (!(size < 8)) return false;
    if (length(step) < 1e-6) return size < most_local;
  }
  return false;
}

void count_inside(const Assembly& assembly, const Assembly::PartRange& part, const Assembly::PartRange& around,
                  const Bounds& where, PartOverlap& overlap) {
  std::vector<int> nodes;
  for (int n = part.first_node; n < part.first_node + part.node_count; ++n)
    if (holds(where, assembly.nodes[n])) nodes.push_back(n);
  overlap.nodes = part.node_count;
  if (nodes.empty()) return;
  const NodeGrid grid(assembly.nodes, nodes, where);
  std::vector<char> counted(part.node_count, 0);
  for (int e = around.first_element; e < around.first_element + around.element_count; ++e) {
    Bounds bounds = no_bounds;
    for (int n : assembly.elements[e]) widen(bounds, assembly.nodes[n]);
    bounds = common(bounds, where);
    if (!(bounds[0][0] <= bounds[1][0] && bounds[0][1] <= bounds[1][1] && bounds[0][2] <= bounds[1][2])) continue;
    grid.within(bounds, [&](int n) {
      if (counted[n - part.first_node] != 0 || !well_inside(assembly, assembly.elements[e], assembly.nodes[n])) return;
      counted[n - part.first_node] = 1;
      if (overlap.inside++ == 0) overlap.place = assembly.nodes[n];
    });
  }
}

/// The same nodes in the same order: the same mesh twice.
bool same_nodes(const Assembly& assembly, const Assembly::PartRange& a, const Assembly::PartRange& b, double size) {
  if (a.node_count != b.node_count) return false;
  for (int k = 0; k < a.node_count; ++k)
    if (length(difference(assembly.nodes[a.first_node + k], assembly.nodes[b.first_node + k])) > 1e-6 * size)
      return false;
  return true;
}

}  // namespace

std::vector<PartOverlap> part_overlaps(const Assembly& assembly) {
  std::vector<Bounds> bounds;
  for (const auto& part : assembly.parts) bounds.push_back(bounds_of(assembly, part));
  std::vector<PartOverlap> found;
  for (std::size_t j = 0; j < bounds.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Bounds both = common(bounds[i], bounds[j]);
      if (!(both[0][0] < both[1][0] && both[0][1] < both[1][1] && both[0][2] < both[1][2])) continue;
      const auto &first = assembly.parts[i], &second = assembly.parts[j];
      PartOverlap overlap{i, j};
      overlap.coincident = same_nodes(assembly, first, second, length(difference(bounds[j][1], bounds[j][0])));
      const bool first_is_smaller = first.node_count < second.node_count;
      if (!overlap.coincident)
        count_inside(assembly, first_is_smaller ? first : second, first_is_smaller ? second : first, both, overlap);
      // A coarse part may have no node inside a fine one that sticks in it.
      if (!overlap.coincident && overlap.inside == 0)
        count_inside(assembly, first_is_smaller ? second : first, first_is_smaller ? first : second, both, overlap);
      if (overlap.coincident || overlap.inside > 0) found.push_back(overlap);
    }
  return found;
}

}  // namespace railwave
