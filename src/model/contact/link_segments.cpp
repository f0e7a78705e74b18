#include "model/contact/link_segments.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include "mesh/vectors.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Cosine of the angle between two segments from which a fold counts as sharp: 60 degrees.
constexpr double sharp_fold = 0.5;
/// Cosine of the angle up to which two lips are of one surface: 30 degrees.
constexpr double one_surface = 0.866;
/// Lips may overlap by this share of the widest mouth: the two sides of a closed crack are not quite where they were
/// meshed.
constexpr double overlap = 0.05;

Vec3 unit(const Vec3& v) { return scaled(1 / length(v), v); }

/// Outward unit normal, and the centre.
struct Facet {
  Vec3 normal{}, centre{};
  Facet(const std::vector<Vec3>& x, const std::array<int, 4>& corner) : normal(unit(doubled_area(x, corner))) {
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) centre[i] += 0.25 * x[corner[k]][i];
  }
};

/// A side at which the surface ends or folds outwards.
struct Rim {
  int segment, side;
  std::array<int, 2> ends;          ///< its nodes
  Vec3 from, way, middle, outward;  ///< m; `outward` is of unit length, in the segment's plane
};

/// The place of a rim that is nearest to a point.
struct OnRim {
  double share;  ///< of the way from its first end to its second
  Vec3 way;      ///< m, there
  OnRim(const Vec3& point, const Rim& rim)
      : share(std::clamp(dot(difference(point, rim.from), rim.way) / dot(rim.way, rim.way), 0.0, 1.0)),
        way(difference(sum(rim.from, scaled(share, rim.way)), point)) {}
};

/// What is across the mouth from a node.
struct Across {
  double distance = 1e300;  ///< m
  const Rim* rim = nullptr;
  double share = 0;
  Vec3 normal{};  ///< of the surface at the node
};

/// Links segments over mouths.
/// @return by node of their rims what is across
std::map<int, Across> link_mouths(const std::vector<Vec3>& nodes, const std::vector<Facet>& facets,
                                  std::vector<Rim>& rims, double widest, std::vector<Segment>& segments) {
  std::map<int, Across> found;
  if (rims.size() < 2) return found;
  // Those that can be near each other are near along the longest axis.
  Vec3 low = rims.front().middle, high = low;
  double longest = 0;
  for (const Rim& rim : rims) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], rim.middle[i]);
      high[i] = std::max(high[i], rim.middle[i]);
    }
    longest = std::max(longest, length(rim.way));
  }
  const Vec3 extent = difference(high, low);
  const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  std::stable_sort(rims.begin(), rims.end(),
                   [axis](const Rim& a, const Rim& b) { return a.middle[axis] < b.middle[axis]; });
  const double limit = widest * (1 + 1e-6), window = limit + longest;
  std::size_t begin = 0;
  for (std::size_t r = 0; r < rims.size(); ++r) {
    const Rim& rim = rims[r];
    while (rims[begin].middle[axis] < rim.middle[axis] - window) ++begin;
    double least = limit;
    int across = -1;
    for (std::size_t o = begin; o < rims.size() && rims[o].middle[axis] <= rim.middle[axis] + window; ++o) {
      const Rim& other = rims[o];
      if (other.segment == rim.segment || dot(rim.outward, other.outward) > -0.5) continue;
      if (dot(facets[rim.segment].normal, facets[other.segment].normal) < one_surface) continue;
      const Vec3 way = OnRim(rim.middle, other).way;
      const double distance = length(way);
      if (distance > limit || dot(way, rim.outward) < -overlap * limit) continue;
      for (int end : rim.ends) {
        const OnRim there(nodes[end], other);
        Across& across_end = found[end];
        if (length(there.way) < across_end.distance)
          across_end = {length(there.way), &other, there.share, facets[rim.segment].normal};
      }
      if (distance > least || (distance == least && across >= 0 && across < other.segment)) continue;
      least = distance;
      across = other.segment;
    }
    if (across >= 0) segments[rim.segment].link[rim.side] = across;
  }
  return found;
}

/// Puts corners of both lips in place of the nodes of one.
std::vector<MouthCorner> join_lips(const std::map<int, Across>& across, const std::vector<Facet>& facets, double widest,
                                   std::vector<Segment>& segments) {
  std::vector<MouthCorner> corners;
  std::map<int, int> number;
  for (const auto& [node, there] : across) {
    const auto& ends = there.rim->ends;
    // At a crack's end both lips have the node.
    if (node == ends[0] || node == ends[1]) continue;
    number[node] = static_cast<int>(corners.size());
    MouthCorner corner{};
    const int pieces[MouthCorner::pieces] = {node, ends[0], ends[1]};
    const double shares[MouthCorner::pieces] = {0.5, 0.5 * (1 - there.share), 0.5 * there.share};
    for (int p = 0; p < MouthCorner::pieces; ++p) {
      corner.node[p] = pieces[p];
      corner.share[p] = shares[p];
    }
    corner.widest = widest;
    corners.push_back(corner);
  }
  // Of the surface's faces around such a node, not of a wall below it.
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (int& node : segments[s].node) {
      const auto corner = number.find(node);
      if (corner == number.end() || dot(facets[s].normal, across.at(node).normal) < sharp_fold) continue;
      node = -1 - corner->second;
    }
  return corners;
}

/// The bits of a number of 21 with two zeros between.
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t result = 0;
  for (int i = 0; i < 21; ++i) result |= (bits >> i & 1) << 3 * i;
  return result;
}

}  // namespace

LinkedSegments link_segments(const std::vector<Vec3>& nodes, const std::vector<std::array<int, 4>>& corners,
                             double widest_mouth) {
  std::vector<Segment> segments;
  std::vector<Facet> facets;
  std::map<std::array<int, 2>, std::vector<std::array<int, 2>>> sides;  // of two nodes: segment, its side
  for (const auto& corner : corners) {
    Segment segment{};
    for (int k = 0; k < 4; ++k) {
      segment.node[k] = corner[k];
      segment.link[k] = -1;
      const std::array<int, 2> ends{std::min(corner[k], corner[(k + 1) % 4]), std::max(corner[k], corner[(k + 1) % 4])};
      sides[ends].push_back({static_cast<int>(segments.size()), k});
    }
    segments.push_back(segment);
    facets.emplace_back(nodes, corner);
  }
  std::vector<Rim> rims;
  const auto add_rim = [&](const std::array<int, 2>& place) {
    const auto [s, k] = place;
    const Vec3 &a = nodes[corners[s][k]], &b = nodes[corners[s][(k + 1) % 4]];
    const Vec3 way = difference(b, a);
    if (!(length(way) > 0)) return;
    rims.push_back({s,
                    k,
                    {corners[s][k], corners[s][(k + 1) % 4]},
                    a,
                    way,
                    sum(a, scaled(0.5, way)),
                    unit(cross(way, facets[s].normal))});
  };
  for (const auto& [ends, pair] : sides) {
    // Where more than two segments meet there is no such thing as the neighbour.
    if (pair.size() == 1) add_rim(pair[0]);
    if (pair.size() != 2) continue;
    const auto &a = pair[0], &b = pair[1];
    const Facet &first = facets[a[0]], &second = facets[b[0]];
    const bool folds = dot(first.normal, second.normal) < sharp_fold;
    const int mark = folds ? Segment::over_fold : 0;
    segments[a[0]].link[a[1]] = b[0] | mark;
    segments[b[0]].link[b[1]] = a[0] | mark;
    if (folds && dot(first.normal, difference(second.centre, first.centre)) < 0) {
      add_rim(a);
      add_rim(b);
    }
  }
  const auto across = link_mouths(nodes, facets, rims, widest_mouth, segments);
  std::vector<MouthCorner> mouth_corners = join_lips(across, facets, std::max(widest_mouth, 1e-300), segments);
  return {std::move(segments), std::move(mouth_corners)};
}

SegmentBoxes make_boxes(const std::vector<Vec3>& nodes, const std::vector<std::array<int, 4>>& segments) {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  std::vector<Vec3> centres;
  for (const auto& corner : segments) {
    Vec3 centre{};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) centre[i] += 0.25 * nodes[corner[k]][i];
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], centre[i]);
      high[i] = std::max(high[i], centre[i]);
    }
    centres.push_back(centre);
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300});
  // Along Morton's curve.
  std::vector<std::uint64_t> code;
  for (const Vec3& c : centres) {
    std::uint64_t bits = 0;
    for (int i = 0; i < 3; ++i)
      bits |= spread(static_cast<std::uint64_t>((c[i] - low[i]) / extent * ((1 << 21) - 1))) << i;
    code.push_back(bits);
  }
  std::vector<int> order(segments.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&code](int a, int b) { return code[a] < code[b]; });
  const auto around = [](std::size_t smaller, int size) { return (smaller + size - 1) / size; };
  const std::size_t leaves = around(segments.size(), SegmentBoxes::leaf_size),
                    branches = around(leaves, SegmentBoxes::branch_size),
                    boughs = around(branches, SegmentBoxes::bough_size);
  SegmentBoxes boxes;
  boxes.order = to_device("order of segments", order);
  boxes.segment = Array<RoundedBox*>("segment boxes", segments.size());
  boxes.normal = Array<double* [3]>("segment normals", segments.size());
  boxes.leaf = Array<RoundedBox*>("leaf boxes", leaves);
  boxes.branch = Array<RoundedBox*>("branch boxes", branches);
  boxes.bough = Array<RoundedBox*>("bough boxes", boughs);
  return boxes;
}

}  // namespace railwave
