#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <numeric>
#include <set>

#include "kernels/elements/element_blocks.hpp"
#include "model/elements/block_nodes.hpp"

using namespace railwave;

namespace {

using Elements = std::vector<CornerNodes>;

/// A box of 4 by 4 by 8 elements, two by two by two as blocks are divided.
Elements box() {
  Elements elements;
  for (int slot = 0; slot < 128; ++slot) {
    const auto bit = [&](int b) { return slot >> b & 1; };
    const int x = bit(0) + 2 * bit(3), y = bit(1) + 2 * bit(4), z = bit(2) + 2 * bit(5) + 4 * bit(6);
    const auto node = [](int i, int j, int k) { return i + 5 * (j + 5 * k); };
    elements.push_back({node(x, y, z), node(x + 1, y, z), node(x + 1, y + 1, z), node(x, y + 1, z), node(x, y, z + 1),
                        node(x + 1, y, z + 1), node(x + 1, y + 1, z + 1), node(x, y + 1, z + 1)});
  }
  return elements;
}

/// Twelve elements round one axis, so that twelve corners meet at each of its two nodes, as at the middle of a fan.
Elements fan() {
  Elements elements;
  for (int e = 0; e < 12; ++e) {
    const int a = 2 + 4 * e, b = 2 + 4 * ((e + 1) % 12);
    elements.push_back({0, a, a + 1, b, 1, a + 2, a + 3, b + 2});
  }
  return elements;
}

/// A block's nodes as they come from the mesh, with numbers that are not in its order.
std::vector<BlockNode> nodes_of(const Elements& elements) {
  int count = 0;
  for (const auto& corners : elements) count = std::max(count, 1 + *std::max_element(corners.begin(), corners.end()));
  std::vector<BlockNode> nodes(count);
  for (int n = 0; n < count; ++n) nodes[n] = {0, n, 1000 + n * 89 % count};
  for (const auto& corners : elements)
    for (int n : corners) ++nodes[n].corners;
  return nodes;
}

std::vector<int> places_of(const std::vector<BlockNode>& ordered) {
  std::vector<int> place(ordered.size());
  for (std::size_t l = 0; l < ordered.size(); ++l) place[ordered[l].mesh_number] = static_cast<int>(l);
  return place;
}

int rounds_of(const BlockNode& node) { return (node.corners + corners_at_once - 1) / corners_at_once; }

std::vector<BlockNode> by_rounds_and_number(std::vector<BlockNode> nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const BlockNode& one, const BlockNode& other) {
    return std::make_pair(rounds_of(one), one.number) < std::make_pair(rounds_of(other), other.number);
  });
  return nodes;
}

/// The numbers of each warp's nodes, in no order.
std::vector<std::set<int>> warps_of(const std::vector<BlockNode>& nodes) {
  std::vector<std::set<int>> warps((nodes.size() + warp_lanes - 1) / warp_lanes);
  for (std::size_t l = 0; l < nodes.size(); ++l) warps[l / warp_lanes].insert(nodes[l].number);
  return warps;
}

}  // namespace

TEST_CASE("A device's block has its nodes by rounds and number, and those of a warp where banks do not wait") {
  for (const Elements& elements : {box(), fan()})
    for (const int banks : {16, 32}) {
      CAPTURE(elements.size(), banks);
      const std::vector<BlockNode> sorted = by_rounds_and_number(nodes_of(elements));
      std::vector<BlockNode> nodes = nodes_of(elements);
      order_for_warps(elements, banks, nodes);
      CHECK(warps_of(nodes) == warps_of(sorted));
      for (std::size_t l = 0; l < nodes.size(); ++l) CHECK(rounds_of(nodes[l]) == rounds_of(sorted[l]));
      CHECK(bank_turns(elements, banks, places_of(nodes)) <= bank_turns(elements, banks, places_of(sorted)));
    }
}

TEST_CASE("Banks wait a fifth less where nodes have been moved, in double and in single precision") {
  const Elements elements = box();
  for (const int banks : {16, 32}) {
    CAPTURE(banks);
    std::vector<BlockNode> nodes = nodes_of(elements);
    order_for_warps(elements, banks, nodes);
    CHECK(bank_turns(elements, banks, places_of(nodes)) <
          0.8 * bank_turns(elements, banks, places_of(by_rounds_and_number(nodes))));
  }
}

TEST_CASE("Turns of banks count the fullest bank of each request, and a value that two ask for once") {
  // Two elements that share a face: each request has one or two nodes.
  const Elements two = {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 8, 9, 2, 5, 10, 11, 6}};
  std::vector<int> place(12);
  std::iota(place.begin(), place.end(), 0);
  CHECK(bank_turns(two, 16, place) == 8);
  CHECK(bank_turns({two[0], two[0]}, 16, place) == 8);
  place[1] = 16;  // with node 0 in one bank: both are first corners
  CHECK(bank_turns(two, 16, place) == 9);
}

TEST_CASE("A host's block has its nodes by corners, then in the mesh's order") {
  std::vector<BlockNode> nodes = nodes_of(box());
  order_for_packs(nodes);
  CHECK(std::is_sorted(nodes.begin(), nodes.end(), [](const BlockNode& one, const BlockNode& other) {
    return std::make_pair(one.corners, one.mesh_number) < std::make_pair(other.corners, other.mesh_number);
  }));
}
