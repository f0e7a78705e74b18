#include <fmt/format.h>

#include <algorithm>

#include "case/error.hpp"
#include "kernels/support/set_zero.hpp"
#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/held_directions.hpp"
#include "model/boundaries/ties.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Constraint row of each node, and the projections.
void build_constraints(const AssembledScene& assembled, const Ties& ties, NodalState& nodal,
                       std::vector<int>& row_of_node) {
  auto constrained = held_directions(assembled.scene, assembled.assembly);
  // A tied node goes where its master does: forces of its own must not move it.
  for (const TiedPlace& tied : ties.places) hold(constrained[tied.slave]);

  nodal.constraints = projections(constrained, row_of_node);
}

/// Calls act(node, row) for each row of the partial forces.
template <class Act>
void each_row(const std::vector<ElementGroup>& groups, const Act& act) {
  for (const ElementGroup& group : groups) {
    const auto node_of = to_host(group.blocks.node), node_count = to_host(group.blocks.node_count);
    for (int p = 0; p < group.blocks.count; ++p)
      for (int l = 0; l < node_count(p); ++l) {
        const int k = p * group.blocks.node_stride + l;
        act(node_of(k), group.first_partial + k);
        if (group.damping.active()) act(node_of(k), group.damping.first_partial + k);
      }
  }
}

/// For each node the rows of the partial forces that are its own, in the order of blocks.
void build_rows_of_nodes(const std::vector<ElementGroup>& groups, NodeArrays& nodes) {
  const int count = nodes.count;
  std::vector<int> first(count + 1, 0);
  each_row(groups, [&](int node, int /*row*/) { ++first[node + 1]; });
  for (int n = 0; n < count; ++n) first[n + 1] += first[n];
  std::vector<int> filled(first.begin(), first.end() - 1), place(first.back());
  each_row(groups, [&](int node, int row) { place[filled[node]++] = row; });
  nodes.first_partial = to_device("first partial force", first);
  nodes.partial_place = to_device("partial forces of nodes", place);
}

/// Rows of positive zeros are not written.
struct CopyNonzeroRow {
  Array<const double* [3]> from;
  Array<double* [3]> to;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    bool zero = true;
    for (int i = 0; i < 3; ++i) zero = zero && from(n, i) == 0 && 1 / from(n, i) > 0;
    for (int i = 0; !zero && i < 3; ++i) to(n, i) = from(n, i);
  }
};

/// The kernel of a block advances nodes that belong to this block only and on which nothing else acts. All others are
/// listed as shared nodes.
void share_out_nodes(const std::vector<ElementGroup>& groups, NodalState& nodal) {
  const auto first = to_host(nodal.nodes.first_partial);
  const auto external = to_host(nodal.nodes.external_row), constraint = to_host(nodal.nodes.constraint);
  const auto place = to_host(nodal.nodes.partial_place);
  std::vector<SharedNode> listed;
  std::vector<MorePlaces> more;
  std::vector<char> alone(nodal.nodes.count, 1);
  const auto of_rows = to_host(nodal.free_nodes.shared);
  for (int n = 0; n < nodal.nodes.count; ++n) {
    const int count = first(n + 1) - first(n);
    const bool special = external(n) >= 0 || constraint(n) >= 0;
    if (count == 1 && !special) continue;
    alone[n] = 0;
    const auto place_at = [&](int k) { return k < count ? place(first(n) + k) : -1; };
    if (count > 2) {
      MorePlaces& others = more.emplace_back();
      for (int k = 0; k < MorePlaces::count; ++k) others.place[k] = place_at(2 + k);
      others.last = first(n + 1);
      others.first = std::min(others.last, first(n) + 2 + MorePlaces::count);
    }
    const SharedNode& node = listed.emplace_back(SharedNode{
        special ? n | special_bit : n, {place_at(0), place_at(1)}, count > 2 ? static_cast<int>(more.size()) : 0});
    if (external(n) >= 0 && of_rows.extent(0) > 0) of_rows(external(n)) = node;
  }
  Kokkos::deep_copy(nodal.free_nodes.shared, of_rows);
  nodal.partial.more = to_device("further places of shared nodes", more);
  for (const ElementGroup& group : groups) {
    const auto nodes = to_host(group.blocks.node);
    // What fills up a row repeats its first node, and so may carry the bit too. When kernels advance nodes, they read
    // no further than the block's nodes.
    for (std::size_t k = 0; k < nodes.extent(0); ++k)
      if (alone[nodes(k)] != 0) nodes(k) |= advance_bit;
    Kokkos::deep_copy(group.blocks.node, nodes);
  }
  nodal.shared.nodes = to_device("shared nodes", listed);
  nodal.shared.first_special = static_cast<int>(listed.size());
}

}  // namespace

void build_node_masses(const AssembledScene& assembled, const Ties& ties, NodalState& nodal) {
  const Assembly& assembly = assembled.assembly;
  NodeArrays& nodes = nodal.nodes;
  nodes.count = static_cast<int>(assembly.nodes.size());
  for (int n = 0; n < nodes.count; ++n)
    if (!(assembled.mass[n] > 0))
      throw InputError(fmt::format("{}: node at {} belongs to no element and has no mass; remove it from the mesh",
                                   assembled.scene.path, place_text(assembly.nodes[n])));
  nodes.mass = to_device("mass", masses_with_ties(ties, assembled.mass));
  std::vector<int> constraint(nodes.count, -1);
  build_constraints(assembled, ties, nodal, constraint);
  nodes.constraint = to_device("constraint", constraint);
}

void build_gather(std::vector<ElementGroup>& groups, NodalState& nodal) {
  build_rows_of_nodes(groups, nodal.nodes);
  share_out_nodes(groups, nodal);
}

void build_node_places(const Assembly& assembly, const std::vector<char>& wanted, NodeArrays& nodes) {
  nodes.reference = unset_array<double* [3]>("reference", nodes.count);
  nodes.position = unset_array<double* [3]>("position", nodes.count);
  nodes.velocity = unset_array<double* [3]>("velocity", nodes.count);
  set_zero(nodes.reference);
  set_zero(nodes.velocity);
  set_reference(assembly, wanted, nodes);
  put_at_reference(nodes);
}

void set_reference(const Assembly& assembly, const std::vector<char>& wanted, const NodeArrays& nodes) {
  const auto reference = to_host(nodes.reference);
  for (int n = 0; n < nodes.count; ++n)
    if (wanted.empty() || wanted[n] != 0)
      for (int i = 0; i < 3; ++i) reference(n, i) = assembly.nodes[n][i];
  Kokkos::deep_copy(nodes.reference, reference);
}

void put_at_reference(const NodeArrays& nodes) {
  if constexpr (on_device) {
    Kokkos::deep_copy(nodes.position, nodes.reference);
  } else {
    set_zero(nodes.position);
    // Rows that other ranks have are zero in both, and stay without memory.
    Kokkos::parallel_for("put_at_reference", Range(0, nodes.count), CopyNonzeroRow{nodes.reference, nodes.position});
  }
}

}  // namespace railwave
