#pragma once

#include <array>
#include <vector>

#include "kernels/contact/contact_search.hpp"
#include "model/contact/link_segments.hpp"
#include "model/host_copy.hpp"

namespace railwave {

using Point = std::array<double, 3>;
using Quad = std::array<int, 4>;

/// A master surface of its own, every node a master node, at rest.
inline ContactSearch search_on(const std::vector<Point>& nodes, const std::vector<Quad>& quads,
                               double widest_mouth = 0) {
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
  const LinkedSegments linked = link_segments(nodes, quads, widest_mouth);
  search.contact.surface = to_device("surface", linked.segments);
  search.contact.mouth_corners = to_device("mouth corners", linked.mouth_corners);
  search.contact.boxes = make_boxes(nodes, quads);
  search.contact.segment_of_node = to_device("segment of node", around);
  search.position = to_device("position", nodes);
  const Array<double* [3]> at_rest("velocity", nodes.size());
  update_boxes(ExecutionSpace(), search, at_rest, 0, 0, EncloseBoxes{search.contact.boxes});
  return search;
}

}  // namespace railwave
