#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <numeric>

#include "kernels/elements/element_blocks.hpp"
#include "mesh/build_mesh.hpp"
#include "model/elements/block_order.hpp"

using namespace railwave;

namespace {

Assembly wheel() {
  scene::MeshSource source;
  source.name = "wheel";
  source.type = scene::MeshType::wheel;
  const Mesh mesh = build_mesh(source);
  Assembly assembly;
  assembly.nodes = mesh.nodes;
  assembly.elements = mesh.elements;
  return assembly;
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
