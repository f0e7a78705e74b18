#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <vector>

#include "kernels/nodes/nodes.hpp"
#include "model/host_copy.hpp"

using namespace railwave;

namespace {

/// Node n has n rows of partial forces, which lie anywhere.
struct NodesOfManyBlocks {
  static constexpr int count = 14;
  NodeArrays nodes;
  PartialForces partial;
  std::vector<SharedNode> shared;
  std::vector<int> first{0}, place;
  std::vector<PartialForce<double>> rows;

  NodesOfManyBlocks() {
    std::vector<MorePlaces> more;
    for (int n = 0; n < count; ++n) {
      for (int k = 0; k < n; ++k) place.push_back((n * 37 + k * 11) % 101);
      first.push_back(static_cast<int>(place.size()));
      const auto at = [&](int k) { return k < n ? place[first[n] + k] : -1; };
      if (n > 2) {
        MorePlaces& others = more.emplace_back();
        for (int k = 0; k < MorePlaces::count; ++k) others.place[k] = at(2 + k);
        others.last = first[n + 1];
        others.first = std::min(others.last, first[n] + 2 + MorePlaces::count);
      }
      shared.push_back({n, {at(0), at(1)}, n > 2 ? static_cast<int>(more.size()) : 0});
    }
    for (int r = 0; r < 101; ++r) rows.push_back({{std::sin(r) * std::pow(10, r % 7), std::cos(r), 1e-3 * r, 0}});
    nodes.count = count;
    nodes.external_row = to_device("external row", std::vector<int>(count, -1));
    nodes.first_partial = to_device("first partial", first);
    nodes.partial_place = to_device("partial place", place);
    partial.in_double = to_device("rows", rows);
    partial.more = to_device("further places", more);
  }

  std::vector<double> sum_of(int n) const {
    std::vector<double> sum(3, 0.0);
    for (int c = first[n]; c < first[n + 1]; ++c)
      for (int i = 0; i < 3; ++i) sum[i] += rows[place[c]].x[i];
    return sum;
  }
};

struct SumBothWays {
  NodalForce force;
  Array<const SharedNode*> shared;
  Array<double* [6]> sums;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const Vector3 by_number = force(n);
    const Vector3 by_record = force.with_rows({{0, 0, 0}}, shared(n), force.first_rows(shared(n)));
    for (int i = 0; i < 3; ++i) {
      sums(n, i) = by_number[i];
      sums(n, 3 + i) = by_record[i];
    }
  }
};

}  // namespace

TEST_CASE("forces of any number of blocks are added in the blocks' order, by a node's number and by its record") {
  const NodesOfManyBlocks all;
  const Array<double* [6]> sums("sums", NodesOfManyBlocks::count);
  const Array<const SharedNode*> shared = to_device("shared nodes", all.shared);
  Kokkos::parallel_for("sum_both_ways", Range(0, NodesOfManyBlocks::count),
                       SumBothWays{{all.nodes, all.partial, {}}, shared, sums});
  const auto found = to_host(sums);
  for (int n = 0; n < NodesOfManyBlocks::count; ++n) {
    INFO("node of " << n << " blocks");
    const auto expected = all.sum_of(n);
    for (int i = 0; i < 3; ++i) {
      CHECK(found(n, i) == expected[i]);
      CHECK(found(n, 3 + i) == expected[i]);
    }
  }
}
