#pragma once

#include <array>
#include <vector>

#include "kernels/contact_search.hpp"
#include "model/host_copy.hpp"

namespace railwave {

using Point = std::array<double, 3>;
using Quad = std::array<int, 4>;

/// Quadrilaterals with their neighbours.
inline std::vector<Segment> linked(const std::vector<Quad>& quads) {
  std::vector<Segment> segments;
  for (const Quad& quad : quads) {
    Segment segment;
    for (int k = 0; k < 4; ++k) {
      segment.node[k] = quad[k];
      segment.neighbour[k] = -1;
      for (std::size_t other = 0; other < quads.size(); ++other)
        for (int j = 0; j < 4; ++j)
          if (quads[other][j] == quad[(k + 1) % 4] && quads[other][(j + 1) % 4] == quad[k])
            segment.neighbour[k] = static_cast<int>(other);
    }
    segments.push_back(segment);
  }
  return segments;
}

/// A master surface of its own, every node a master node.
inline ContactSearch search_on(const std::vector<Point>& nodes, const std::vector<Quad>& quads) {
  std::vector<int> first(nodes.size() + 1, 0), around, identity;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    identity.push_back(static_cast<int>(n));
    for (std::size_t q = 0; q < quads.size(); ++q)
      for (int corner : quads[q])
        if (corner == static_cast<int>(n)) around.push_back(static_cast<int>(q));
    first[n + 1] = static_cast<int>(around.size());
  }
  ContactSearch search;
  search.contact.master_count = static_cast<int>(nodes.size());
  search.contact.segment_count = static_cast<int>(quads.size());
  search.contact.master_nodes = to_device("master nodes", identity);
  search.contact.segments = to_device("segments", quads);
  search.contact.first_segment = to_device("first segment", first);
  search.contact.surface = to_device("surface", linked(quads));
  search.contact.segment_of_node = to_device("segment of node", around);
  search.position = to_device("position", nodes);
  return search;
}

}  // namespace railwave
