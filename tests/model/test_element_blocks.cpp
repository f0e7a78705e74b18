#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <numeric>

#include "kernels/elements/element_blocks.hpp"
#include "mesh/build_mesh.hpp"
#include "model/elements/block_order.hpp"

using namespace railwave;

namespace {

/// A mesh as the only part.
Assembly part_of(scene::MeshSource source) {
  source.name = "mesh";
  const Mesh mesh = build_mesh(source);
  Assembly assembly;
  assembly.nodes = mesh.nodes;
  assembly.elements = mesh.elements;
  Assembly::PartRange& part = assembly.parts.emplace_back();
  part.node_count = static_cast<int>(mesh.nodes.size());
  part.element_count = static_cast<int>(mesh.elements.size());
  return assembly;
}

/// @param zone_size m
Assembly wheel(double zone_size = scene::WheelMesh().zone_size) {
  scene::MeshSource source;
  source.type = scene::MeshType::wheel;
  source.wheel.zone_size = zone_size;
  return part_of(source);
}

/// Of as many cubes along each edge.
Assembly cube(int divisions) {
  scene::MeshSource source;
  source.type = scene::MeshType::box;
  source.box.divisions = {divisions, divisions, divisions};
  source.box.size = {1, 1, 1};
  return part_of(source);
}

/// Two assemblies of one part, one after the other.
Assembly together(Assembly first, const Assembly& second) {
  Assembly::PartRange part = second.parts[0];
  part.first_node = static_cast<int>(first.nodes.size());
  part.first_element = static_cast<int>(first.elements.size());
  first.parts.push_back(part);
  first.nodes.insert(first.nodes.end(), second.nodes.begin(), second.nodes.end());
  for (auto corners : second.elements) {
    for (int& n : corners) n += part.first_node;
    first.elements.push_back(corners);
  }
  return first;
}

using Way = void (*)(const Assembly&, std::vector<int>&, int, int, std::vector<int>&, const BlockLimits&);

struct Division {
  std::vector<int> elements, first;
};

Division divide(const Assembly& assembly, Way way, int begin, int end) {
  Division result;
  result.elements.resize(assembly.elements.size());
  std::iota(result.elements.begin(), result.elements.end(), 0);
  way(assembly, result.elements, begin, end, result.first, {});
  return result;
}

/// Every element of the range in one block, every block within its limits, nothing else touched.
void check(const Assembly& assembly, Division division, int begin, int end) {
  auto& [elements, first] = division;
  REQUIRE(!first.empty());
  CHECK(first.front() == begin);
  first.push_back(end);
  for (std::size_t p = 0; p + 1 < first.size(); ++p) {
    CHECK(first[p] < first[p + 1]);
    CHECK(first[p + 1] - first[p] <= elements_of_block);
    std::vector<int> nodes;
    for (int k = first[p]; k < first[p + 1]; ++k)
      nodes.insert(nodes.end(), assembly.elements[elements[k]].begin(), assembly.elements[elements[k]].end());
    std::sort(nodes.begin(), nodes.end());
    CHECK(std::unique(nodes.begin(), nodes.end()) - nodes.begin() <= nodes_of_block);
  }
  for (int k = 0; k < static_cast<int>(elements.size()); ++k)
    if (k < begin || k >= end) CHECK(elements[k] == k);
  std::sort(elements.begin() + begin, elements.begin() + end);
  for (int k = begin; k < end; ++k) CHECK(elements[k] == k);
}

}  // namespace

TEST_CASE("blocks hold each element once and keep to their limits") {
  const Assembly assembly = wheel();
  const int count = static_cast<int>(assembly.elements.size());
  for (Way way : {&halve_into_blocks, &grow_blocks}) {
    check(assembly, divide(assembly, way, 0, count), 0, count);
    check(assembly, divide(assembly, way, count / 3, count / 2), count / 3, count / 2);
    check(assembly, divide(assembly, way, 7, 8), 7, 8);
  }
}

TEST_CASE("grown blocks are fuller than halved ones where rows of elements bend") {
  const Assembly assembly = wheel();
  const int count = static_cast<int>(assembly.elements.size());
  const auto grown = divide(assembly, &grow_blocks, 0, count), halved = divide(assembly, &halve_into_blocks, 0, count);
  INFO(grown.first.size() << " and " << halved.first.size() << " blocks of " << count << " elements");
  CHECK(grown.first.size() < 0.85 * halved.first.size());
  CHECK(count > 0.9 * elements_of_block * grown.first.size());
}

TEST_CASE("a part has the blocks that it would have alone, however many the parts before it have") {
  // Growing saves the wheel a third of its blocks, which is little of all.
  const Assembly alone = wheel(4e-3), before = cube(64);
  const int elements = static_cast<int>(before.elements.size()), nodes = static_cast<int>(before.nodes.size());
  const auto halved = divide(alone, &halve_into_blocks, 0, static_cast<int>(alone.elements.size()));
  for (const bool in_rows : {false, true}) {
    Assembly first = before, second = alone, both = together(before, alone);
    const BlockOrder of_first = order_in_blocks(first, {}, in_rows), of_second = order_in_blocks(second, {}, in_rows),
                     of_both = order_in_blocks(both, {}, in_rows);
    if (!in_rows) CHECK(of_second.first_element.size() - 1 < 0.95 * halved.first.size());
    std::vector<int> wanted(of_first.first_element.begin(), of_first.first_element.end() - 1);
    for (int e : of_second.first_element) wanted.push_back(elements + e);
    CHECK((of_both.first_element == wanted));
    auto corners = second.elements;
    for (auto& element : corners)
      for (int& n : element) n += nodes;
    CHECK(std::equal(corners.begin(), corners.end(), both.elements.begin() + elements, both.elements.end()));
  }
}
