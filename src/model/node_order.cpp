#include <algorithm>

#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/ties.hpp"
#include "model/build_steps.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

using SharedOnHost = Array<SharedNode*>::HostMirror;

/// Moves nodes that are not as wanted behind the others, all in the order in which they were: with room for those
/// alone, as they are few. @return the first of them
template <class Wanted>
int move_behind(const SharedOnHost& shared, int begin, const Wanted& wanted) {
  std::vector<SharedNode> others;
  int end = begin;
  for (int i = begin; i < static_cast<int>(shared.extent(0)); ++i)
    if (wanted(shared(i)))
      shared(end++) = shared(i);
    else
      others.push_back(shared(i));
  std::copy(others.begin(), others.end(), shared.data() + end);
  return end;
}

/// What special nodes are asked for, of the shared ones from nodal.shared.first_special on.
Array<SpecialNode*> special_nodes(const SharedOnHost& shared, const NodalState& nodal) {
  const auto external = to_host(nodal.nodes.external_row), constraint = to_host(nodal.nodes.constraint);
  const auto loaded_of_row = to_host(nodal.external.loaded_of_row);
  const auto loaded = to_host(nodal.external.loaded);
  std::vector<SpecialNode> special;
  for (std::size_t i = nodal.shared.first_special; i < shared.extent(0); ++i) {
    const int n = shared(i).node & ~special_bit, r = external(n);
    SpecialNode& one = special.emplace_back(SpecialNode{r, 0, 0, constraint(n)});
    if (r < 0 || loaded_of_row(r) < 0) continue;
    const LoadedRow& of_row = loaded(loaded_of_row(r));
    one.first_share = of_row.first;
    one.shares = of_row.last - of_row.first;
  }
  return to_device("special nodes", special);
}

/// So many plain nodes at most go with the special ones in one launch. They have room on a GPU at a time as threads of
/// that launch, which takes less than two; threads of a host spend as long on them as a second launch takes.
constexpr int most_with_others = on_device ? 1 << 16 : 1 << 10;

}  // namespace

void order_shared_nodes(const std::vector<ElementGroup>& groups, const std::vector<ContactPair>& contacts,
                        const std::vector<PrescribedSet>& prescribed, const Ties& ties, const NonReflectingEnds& ends,
                        bool in_parts, NodalState& nodal) {
  nodal.early_shared = 0;
  nodal.first_late = static_cast<int>(nodal.shared.nodes.extent(0));
  nodal.plain_apart = false;
  nodal.parts = {};
  if (nodal.subcycling.levels > 1) return;  // they are in order of levels, and take no notice of special ones
  std::vector<char> late(nodal.nodes.count, 0);
  bool any = false;
  const auto mark = [&](const std::vector<int>& nodes) {
    for (int n : nodes) late[n] = 1;
    any = any || !nodes.empty();
  };
  for (const ContactPair& pair : contacts) {
    if (pair.has_springs()) continue;
    mark(pair.slave_nodes);
    mark(pair.master_nodes);
  }
  for (const PrescribedSet& set : prescribed) mark(to_vector(set.nodes));
  mark(ties.masters);
  for (const TiedPlace& tied : ties.places) mark({tied.slave});
  const bool any_but_ends = any;
  mark(ends.nodes);
  const SharedOnHost shared = to_host(nodal.shared.nodes);
  nodal.shared.first_special = move_behind(shared, 0, [](const SharedNode& one) { return one.node >= 0; });
  nodal.first_late = move_behind(shared, nodal.shared.first_special,
                                 [&](const SharedNode& one) { return late[one.node & ~special_bit] == 0; });
  if (on_device && any_but_ends) nodal.early_shared = nodal.first_late;
  nodal.plain_apart = nodal.shared.first_special > most_with_others;
  if (in_parts) {
    std::vector<char> special(nodal.nodes.count, 0);
    for (std::size_t i = nodal.shared.first_special; i < shared.extent(0); ++i)
      special[shared(i).node & ~special_bit] = 1;
    nodal.parts = divide_elements(groups, special, any_but_ends);
  }
  Kokkos::deep_copy(nodal.shared.nodes, shared);
  nodal.shared.special = special_nodes(shared, nodal);
}

}  // namespace railwave
