#include <cmath>
#include <map>
#include <utility>

#include "mesh/sections/section.hpp"

namespace railwave {

namespace {

/// The section's boundary edges, counter-clockwise: those that only one quad has.
std::vector<std::pair<int, int>> boundary_edges(const SectionMesh& section) {
  std::map<std::pair<int, int>, int> uses;
  for (const SectionQuad& quad : section.quads)
    for (int i = 0; i < 4; ++i) ++uses[{quad.nodes[i], quad.nodes[(i + 1) % 4]}];
  std::vector<std::pair<int, int>> edges;
  for (const auto& [edge, count] : uses)
    if (uses.count({edge.second, edge.first}) == 0) edges.push_back(edge);
  return edges;
}

std::size_t nearest(const std::vector<Point2>& outline, Point2 p) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < outline.size(); ++i)
    if (norm(outline[i] - p) < norm(outline[best] - p)) best = i;
  return best;
}

/// Area between the outline from sample i to sample j and the chord from a to b.
double area_beyond_chord(const std::vector<Point2>& outline, Point2 a, std::size_t i, Point2 b, std::size_t j) {
  double area = 0;
  Point2 before{0, 0};
  for (std::size_t k = (i + 1) % outline.size(); i != j && k != j; k = (k + 1) % outline.size()) {
    const Point2 now = outline[k] - a;
    area += cross(before, now) / 2;
    before = now;
  }
  return area + cross(before, b - a) / 2;
}

}  // namespace

std::vector<Point2> sample_closed(const Curve& curve, double spacing) {
  const int count = static_cast<int>(std::ceil(curve.length / spacing));
  std::vector<Point2> points;
  for (int i = 0; i < count; ++i) points.push_back(curve.at(curve.length * i / count));
  return points;
}

void match_outline_area(SectionMesh& section, const std::vector<Point2>& outline, const std::vector<char>& kept) {
  struct Share {
    double area = 0;
    Point2 normal;           // sum over the node's edges of length times outward normal, which is also the
    std::size_t sample = 0;  // gradient of twice the area
    bool found = false;
  };
  std::map<int, Share> shares;
  const auto edges = boundary_edges(section);
  const auto sample_of = [&](int node) {
    Share& share = shares[node];
    if (!share.found) share.sample = nearest(outline, section.position(node));
    share.found = true;
    return share.sample;
  };
  for (const auto& [from, to] : edges) {
    const Point2 a = section.position(from), b = section.position(to), along = b - a;
    const double area = area_beyond_chord(outline, a, sample_of(from), b, sample_of(to));
    const int movers = (kept[from] ? 0 : 1) + (kept[to] ? 0 : 1);
    for (int node : {from, to}) {
      shares[node].normal = shares[node].normal + Point2{along.z, -along.y};
      if (!kept[node]) shares[node].area += area / movers;
    }
  }
  for (const auto& [node, share] : shares) {
    if (kept[node]) continue;
    // A shift d changes the area by d . normal / 2.
    const double steepness = dot(share.normal, share.normal);
    section.nodes[node].position = section.position(node) + (2 * share.area / steepness) * share.normal;
  }
}

}  // namespace railwave
