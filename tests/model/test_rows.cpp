#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <numeric>
#include <random>
#include <set>

#include "mesh/build_mesh.hpp"
#include "model/elements/block_order.hpp"
#include "model/elements/edge_groups.hpp"

using namespace railwave;

namespace {

Assembly assembly_of(scene::MeshSource source) {
  source.name = "mesh";
  const Mesh mesh = build_mesh(source);
  Assembly assembly;
  assembly.nodes = mesh.nodes;
  assembly.elements = mesh.elements;
  return assembly;
}

Assembly box(const std::array<int, 3>& divisions) {
  scene::MeshSource source;
  source.type = scene::MeshType::box;
  source.box.divisions = divisions;
  for (int i = 0; i < 3; ++i) source.box.size[i] = 1e-3 * divisions[i];
  return assembly_of(source);
}

Assembly wheel() {
  scene::MeshSource source;
  source.type = scene::MeshType::wheel;
  return assembly_of(source);
}

struct Rows {
  std::vector<int> elements, first;
  int left;
};

Rows rows_of(const Assembly& assembly) {
  Rows rows;
  rows.elements.resize(assembly.elements.size());
  std::iota(rows.elements.begin(), rows.elements.end(), 0);
  rows.left = gather_rows(assembly, rows.elements, 0, static_cast<int>(rows.elements.size()), rows.first);
  return rows;
}

/// Calls act(corners by places among the block's nodes, how many these are) for each block of rows.
template <class Act>
void each_block(const Assembly& assembly, const Rows& rows, const Act& act) {
  for (std::size_t p = 0; p < rows.first.size(); ++p) {
    const int end = p + 1 < rows.first.size() ? rows.first[p + 1] : rows.left;
    std::vector<CornerNodes> elements;
    std::vector<int> nodes;
    for (int k = rows.first[p]; k < end; ++k) {
      elements.push_back(assembly.elements[rows.elements[k]]);
      nodes.insert(nodes.end(), elements.back().begin(), elements.back().end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (auto& element : elements)
      for (int& n : element) n = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), n) - nodes.begin());
    act(elements, static_cast<int>(nodes.size()));
  }
}

/// Each element's corners numbered in another of the ways that keep it right-handed.
void turn_at_random(Assembly& assembly) {
  std::mt19937 generator(7);
  for (auto& c : assembly.elements)
    for (int k = 0; k < 4; ++k)
      if (generator() % 2 == 0)
        c = {c[1], c[2], c[3], c[0], c[5], c[6], c[7], c[4]};
      else
        c = {c[0], c[3], c[7], c[4], c[1], c[2], c[6], c[5]};
}

}  // namespace

TEST_CASE("blocks of rows hold each element once, keep to their limits and share their edges") {
  Assembly assembly;
  double least = 0;
  SECTION("a box that blocks of 8 x 4 x 4 fill") {
    assembly = box({16, 8, 12});
    least = 1;
  }
  SECTION("the same with corners numbered anyhow") {
    assembly = box({16, 8, 12});
    turn_at_random(assembly);
    least = 1;
  }
  SECTION("a box whose only rows lie across the first element's first direction") {
    assembly = box({5, 9, 24});
    least = 1;
  }
  SECTION("a wheel, with zones of several directions") {
    assembly = wheel();
    least = 0.8;
  }
  const Rows rows = rows_of(assembly);
  std::vector<int> sorted = rows.elements;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < sorted.size(); ++k) REQUIRE(sorted[k] == static_cast<int>(k));
  CHECK(rows.left >= least * static_cast<double>(sorted.size()));
  REQUIRE(!rows.first.empty());
  CHECK(rows.first.front() == 0);
  std::size_t with_edges = 0, edges = 0;
  each_block(assembly, rows, [&](const std::vector<CornerNodes>& elements, int nodes) {
    CHECK(elements.size() <= elements_of_block);
    CHECK(nodes <= nodes_of_block);
    CHECK(elements.size() % elements_of_group == 0);
    const EdgeGroups groups = edge_groups(elements);
    if (groups.node.empty()) return;
    with_edges += elements.size();
    edges += groups.node.size();
  });
  INFO(edges << " edge groups for " << with_edges << " elements, " << rows.left << " in rows");
  CHECK(static_cast<double>(with_edges) > 0.95 * rows.left);
  CHECK(static_cast<double>(edges * elements_of_group) < 1.8 * static_cast<double>(with_edges));
}

TEST_CASE("elements find the neighbours at all their sides, however corners are numbered") {
  const std::array<int, 3> divisions{3, 4, 5};
  Assembly assembly = box(divisions);
  turn_at_random(assembly);
  // A part of the mesh, in another order.
  std::vector<int> elements(assembly.elements.size());
  std::iota(elements.rbegin(), elements.rend(), 0);
  elements.resize(elements.size() - 3 * 4);
  const TurnedElements turned_ones = turned_elements(assembly.elements, elements);
  std::vector<std::set<int>> nodes;
  for (int e : elements) nodes.emplace_back(assembly.elements[e].begin(), assembly.elements[e].end());
  for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
    std::set<int> expected, found;
    for (int other = 0; other < static_cast<int>(elements.size()); ++other) {
      const auto common =
          std::count_if(nodes[other].begin(), nodes[other].end(), [&](int n) { return nodes[e].count(n); });
      if (common == 4) expected.insert(other);
    }
    for (int side = 0; side < element_sides; ++side) {
      const int other = turned_ones.next[e][side];
      if (other == no_element) continue;
      found.insert(other);
      CHECK(turned_ones.next[other][side ^ 1] == e);
    }
    CHECK(found == expected);
  }
}

TEST_CASE("the edges of a group are those of its elements, turned like one another") {
  const Assembly assembly = wheel();
  const Rows rows = rows_of(assembly);
  // Pairs of corners that an edge joins.
  const std::set<std::pair<int, int>> joined{{0, 1}, {1, 2}, {2, 3}, {0, 3}, {4, 5}, {5, 6},
                                             {6, 7}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  int checked = 0;
  each_block(assembly, rows, [&](const std::vector<CornerNodes>& elements, int /*nodes*/) {
    const EdgeGroups groups = edge_groups(elements);
    for (std::size_t g = 0; g < groups.of_group.size(); ++g)
      for (int lane = 0; lane < elements_of_group; ++lane) {
        const auto& element = elements[elements_of_group * g + lane];
        const auto corner = [&](int n) {
          return static_cast<int>(std::find(element.begin(), element.end(), n) - element.begin());
        };
        // Corners as the kernel has them.
        constexpr int lower[4] = {0, 3, 4, 7}, upper[4] = {1, 2, 5, 6};
        int turned[8];
        for (int k = 0; k < 4; ++k) {
          const auto& edge = groups.node[groups.of_group[g][k]];
          turned[lower[k]] = corner(edge[lane]);
          turned[upper[k]] = corner(edge[elements_of_group + lane]);
        }
        bool right = true;
        for (int N = 0; N < 8; ++N) right = right && turned[N] < 8;
        for (auto [a, b] : joined) right = right && joined.count(std::minmax(turned[a], turned[b])) == 1;
        CHECK(right);
        ++checked;
      }
  });
  CHECK(checked > 0.8 * static_cast<double>(assembly.elements.size()));
}

TEST_CASE("rows end where sheets of elements have no node in common") {
  Assembly assembly = box({8, 16, 4});
  // The second half of each row gets nodes of its own.
  const auto count = static_cast<int>(assembly.nodes.size());
  const std::vector<Vec3> nodes = assembly.nodes;
  assembly.nodes.insert(assembly.nodes.end(), nodes.begin(), nodes.end());
  for (auto& element : assembly.elements) {
    double x = 0;
    for (int n : element) x += nodes[n][0] / 8;
    if (x > 4e-3)
      for (int& n : element) n += count;
  }
  const Rows rows = rows_of(assembly);
  CHECK(rows.left == static_cast<int>(assembly.elements.size()));  // along y there are rows still
  each_block(assembly, rows, [](const auto& /*elements*/, int nodes_of_one) { CHECK(nodes_of_one <= nodes_of_block); });
}

TEST_CASE("blocks keep to their level where rows are and where they are not worth it") {
  Assembly assembly = box({10, 10, 7});
  Assembly::PartRange& part = assembly.parts.emplace_back();
  part.element_count = static_cast<int>(assembly.elements.size());
  part.node_count = static_cast<int>(assembly.nodes.size());
  std::mt19937 generator(3);
  std::vector<int> levels;
  // Scattered elements share few nodes, whole layers have rows.
  for (std::size_t e = 0; e < assembly.elements.size(); ++e)
    levels.push_back(e < assembly.elements.size() / 2 ? 0 : 1 + static_cast<int>(generator() % 3 == 0));
  std::array<int, 3> expected{}, found{};
  for (int level : levels) ++expected[level];
  const BlockOrder order = order_in_blocks(assembly, levels, true);
  REQUIRE(order.level.size() + 1 == order.first_element.size());
  for (std::size_t p = 0; p < order.level.size(); ++p)
    found[order.level[p]] += order.first_element[p + 1] - order.first_element[p];
  CHECK(found == expected);
}
