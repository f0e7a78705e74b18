#include "model/contact/contact_state.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>

#include "kernels/contact/contact_force.hpp"
#include "kernels/contact/team_search.hpp"
#include "model/boundaries/ties.hpp"
#include "model/contact/contact_law.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/fields.hpp"
#include "model/host_copy.hpp"
#include "model/lent_array.hpp"
#include "model/nodal_state.hpp"
#include "model/sets/point_search.hpp"

namespace railwave {
namespace {

/// What a pair does at a slave node that touches.
struct TouchingSlave {
  int slave, status, segment, unused;
  double place[2];
  double low[3], high[3];  ///< box around the slave and its segment
  double normal[3], tangential[3];

  double share(int corner) const { return segment_shape(corner, place[0], place[1]); }
};

/// A list whose entries a device looks for among 0 ... count - 1: has(i), and entry(i) where it has.
template <class List>
struct CountEntries {
  List list;
  KOKKOS_INLINE_FUNCTION void operator()(const int i, int& found) const {
    if (list.has(i)) ++found;
  }
};

template <class List>
struct GatherEntries {
  List list;
  Array<int*> next;  ///< one
  Array<typename List::Entry*> gathered;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    if (list.has(i)) gathered(Kokkos::atomic_fetch_add(&next(0), 1)) = list.entry(i);
  }
};

/// Its entries, in any order. Counted first, as few of many are its own.
template <class List>
std::vector<typename List::Entry> gathered(const char* name, int count, const List& list) {
  int found = 0;
  Kokkos::parallel_reduce(name, Range(0, count), CountEntries<List>{list}, found);
  if (found == 0) return {};
  const LentArray<typename List::Entry*> entries(found);
  const LentArray<int*> next(1);
  Kokkos::deep_copy(ExecutionSpace(), *next, 0);
  Kokkos::parallel_for(name, Range(0, count), GatherEntries<List>{list, *next, *entries});
  return to_vector(*entries);
}

/// The slave nodes that touch.
struct TouchingSlaves {
  using Entry = TouchingSlave;
  ContactArrays contact;
  Array<const double* [3]> position;

  KOKKOS_INLINE_FUNCTION bool has(const int s) const { return contact.status(s) != status_apart; }
  KOKKOS_INLINE_FUNCTION Entry entry(const int s) const {
    Entry one;
    one.slave = s;
    one.status = contact.status(s);
    one.segment = contact.tracked(s);
    one.unused = 0;
    for (int i = 0; i < 2; ++i) one.place[i] = contact.place(s, i);
    const Segment segment = contact.surface(one.segment);
    for (int i = 0; i < 3; ++i) {
      one.low[i] = one.high[i] = position(contact.slave_nodes(s), i);
      for (int k = 0; k < 4; ++k) {
        const double x = position(contact.node_of(segment.node[k]), i);
        one.low[i] = x < one.low[i] ? x : one.low[i];
        one.high[i] = x > one.high[i] ? x : one.high[i];
      }
      one.normal[i] = contact.normal_force(s, i);
      one.tangential[i] = contact.tangential_force(s, i);
    }
    return one;
  }
};

/// By slave, ascending.
std::vector<TouchingSlave> touching_slaves(const NodeArrays& nodes, const ContactPair& pair) {
  std::vector<TouchingSlave> touching =
      gathered("touching_slaves", pair.arrays.slave_count, TouchingSlaves{pair.arrays, nodes.position});
  std::sort(touching.begin(), touching.end(), [](const auto& a, const auto& b) { return a.slave < b.slave; });
  return touching;
}

/// The nodes of a surface that are in a box: positions among the surface's nodes.
struct NodesInBox {
  using Entry = int;
  Array<const double* [3]> position;
  Array<const int*> nodes;
  double low[3], high[3];

  KOKKOS_INLINE_FUNCTION bool has(const int k) const {
    for (int i = 0; i < 3; ++i) {
      const double x = position(nodes(k), i);
      if (x < low[i] || x > high[i]) return false;
    }
    return true;
  }
  KOKKOS_INLINE_FUNCTION Entry entry(const int k) const { return k; }
};

/// Ascending.
std::vector<int> nodes_in_box(const NodeArrays& nodes, const Array<int*>& surface, const Bounds& box) {
  if (box[0][0] > box[1][0]) return {};
  NodesInBox list{nodes.position, surface, {}, {}};
  for (int i = 0; i < 3; ++i) {
    list.low[i] = box[0][i];
    list.high[i] = box[1][i];
  }
  std::vector<int> inside = gathered("nodes_in_box", static_cast<int>(surface.extent(0)), list);
  std::sort(inside.begin(), inside.end());
  return inside;
}

/// Those nodes of a surface that take part: slaves of `own` that touch, and corners of the segments under the slaves of
/// `other`, whose masters they are.
std::vector<int> nodes_in_contact(const std::vector<TouchingSlave>& own, const std::vector<TouchingSlave>& other,
                                  const std::vector<std::array<int, 4>>& segments) {
  std::set<int> places;
  for (const TouchingSlave& one : own) places.insert(one.slave);
  for (const TouchingSlave& one : other) places.insert(segments[one.segment].begin(), segments[one.segment].end());
  return {places.begin(), places.end()};
}

/// What is wanted of one surface.
struct WantedNodes {
  std::vector<int> places;    ///< positions among the surface's nodes, ascending
  std::vector<int> place_of;  ///< of each of the surface's nodes: position in `places`; -1: not wanted
};

WantedNodes wanted_nodes(std::vector<int> places, std::size_t count) {
  WantedNodes wanted{std::move(places), std::vector<int>(count, -1)};
  for (std::size_t k = 0; k < wanted.places.size(); ++k) wanted.place_of[wanted.places[k]] = static_cast<int>(k);
  return wanted;
}

WantedNodes all_nodes(std::size_t count) {
  std::vector<int> places(count);
  std::iota(places.begin(), places.end(), 0);
  return wanted_nodes(std::move(places), count);
}

/// Widens a box to hold the touching slave nodes and the segments under them.
void widen_by(Bounds& box, const std::vector<TouchingSlave>& touching) {
  for (const TouchingSlave& one : touching) {
    widen(box, {one.low[0], one.low[1], one.low[2]});
    widen(box, {one.high[0], one.high[1], one.high[2]});
  }
}

/// One side's wanted nodes, and those of the facets around them where its shape is asked for.
struct NodesAround {
  bool shape;
  std::vector<int> nodes;                         ///< model node numbers, the wanted ones first
  std::vector<std::array<int, 4>> facets;         ///< around wanted nodes: positions in `nodes`
  std::vector<std::array<int, 4>> wanted_facets;  ///< of which all corners are wanted
};

/// @param nodes the wanted ones
NodesAround nodes_around(const std::vector<int>& nodes, const std::vector<int>& surface,
                         const std::vector<std::array<int, 4>>& facets, const WantedNodes& wanted, bool shape) {
  NodesAround around{shape, nodes, {}, {}};
  if (!shape) return around;
  std::vector<int> place_of = wanted.place_of;
  for (const auto& facet : facets) {
    const auto is_wanted = [&](int k) { return wanted.place_of[k] >= 0; };
    if (std::none_of(facet.begin(), facet.end(), is_wanted)) continue;
    std::array<int, 4> corners{};
    for (int c = 0; c < 4; ++c) {
      int& place = place_of[facet[c]];
      if (place < 0) {
        place = static_cast<int>(around.nodes.size());
        around.nodes.push_back(surface[facet[c]]);
      }
      corners[c] = place;
    }
    around.facets.push_back(corners);
    if (std::all_of(facet.begin(), facet.end(), is_wanted)) around.wanted_facets.push_back(corners);
  }
  return around;
}

ContactSide bare_side(const std::vector<int>& surface, const WantedNodes& wanted) {
  ContactSide side;
  side.places = wanted.places;
  for (const int place : wanted.places) side.nodes.push_back(surface[place]);
  side.normal_force.assign(3 * side.nodes.size(), 0);
  side.tangential_force.assign(3 * side.nodes.size(), 0);
  return side;
}

/// Area and normal of the wanted nodes, by all facets around them.
/// @param position m, of all nodes around
void add_geometry(NodesAround around, std::vector<double> position, ContactSide& side) {
  SurfaceGeometry geometry = surface_geometry(position, around.facets);
  const std::size_t count = side.nodes.size();
  geometry.area.resize(count);
  geometry.normal.resize(3 * count);
  position.resize(3 * count);
  side.area = std::move(geometry.area);
  side.normal = std::move(geometry.normal);
  side.position = std::move(position);
  side.facets = std::move(around.wanted_facets);
}

/// Where both sides' nodes are and how they move, by one copy from the device, and the shape of those asked for.
void add_motion(const NodalState& nodal, const Ties& ties, NodesAround of_slave, NodesAround of_master,
                ContactSide& slave, ContactSide& master) {
  std::vector<int> nodes = of_slave.nodes;
  nodes.insert(nodes.end(), of_master.nodes.begin(), of_master.nodes.end());
  std::vector<NodeField> wanted{NodeField::displacement, NodeField::velocity};
  if (of_slave.shape || of_master.shape) wanted.push_back(NodeField::position);
  const std::vector<HostField> fields = node_fields(nodal, ties, wanted, nodes);
  const auto values = [](const HostField& field, std::size_t first, std::size_t count) {
    const auto begin = field.values.begin() + static_cast<std::ptrdiff_t>(3 * first);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(3 * count));
  };
  const auto add = [&](NodesAround&& around, std::size_t first, ContactSide& side) {
    side.displacement = values(fields[0], first, side.nodes.size());
    side.velocity = values(fields[1], first, side.nodes.size());
    if (!around.shape) return;
    const std::size_t all = around.nodes.size();
    add_geometry(std::move(around), values(fields[2], first, all), side);
  };
  const std::size_t first_of_master = of_slave.nodes.size();
  add(std::move(of_slave), 0, slave);
  add(std::move(of_master), first_of_master, master);
}

/// Present gap of the nodes in the window that a step doesn't project.
struct PresentGap {
  ContactSearch search;
  ContactWindow window;
  Array<double*> gap;
  /// @param by the search, of a thread or a team
  /// @param writes of a team's threads one
  template <class Search>
  KOKKOS_INLINE_FUNCTION void item(const Search& by, const int i, bool writes) const {
    const WindowEntry entry = window.entries(i);
    if (entry.projected()) return;
    const int s = entry.slave;
    if (search.contact.gap(s) == turned_away) return;
    const Projection found = by.locate(row(search.position, entry.node), search.contact.tracked(s));
    if (writes) gap(s) = found.segment < 0 ? beside_surface : found.gap;
  }
};

struct PickGaps {
  Array<const double*> gap;
  Array<const int*> wanted;
  Array<double*> result;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { result(i) = gap(wanted(i)); }
};

/// Of the slave's wanted nodes.
std::vector<double> present_gaps(const NodeArrays& nodes, const ContactPair& pair, const std::vector<int>& places) {
  const LentArray<double*> gap(pair.arrays.slave_count);
  Kokkos::deep_copy(ExecutionSpace(), *gap, pair.arrays.gap);
  search_parallel_for(ExecutionSpace(), "present_gap", pair.window.count,
                      PresentGap{ContactSearch{{pair.arrays, nodes.position}}, pair.window, *gap});
  if (places.size() == pair.slave_nodes.size()) return to_vector(*gap);
  const LentArray<double*> result(places.size());
  Kokkos::parallel_for("pick_gaps", Range(0, static_cast<int>(places.size())),
                       PickGaps{*gap, *lent_copy(places), *result});
  return to_vector(*result);
}

/// Shares of the master's nodes in a force on the slaves, where segments are curved.
struct CurvedShares {
  ContactSearch search;
  ExternalForceSum sum;
  Array<const int*> place_of_node;
  Array<const double* [3]> force;
  KOKKOS_INLINE_FUNCTION void operator()(const int s) const {
    const ContactArrays& contact = search.contact;
    if (contact.status(s) == status_apart) return;
    const int segment = contact.tracked(s);
    const Vector3 f = row(force, s);
    SmoothNormals::reaction(search, segment, {contact.place(s, 0), contact.place(s, 1)}, f,
                            CurvedReaction({search, sum, place_of_node}, contact.surface(segment), f));
  }
};

/// A contact spring on a curved segment also loads nodes around the segment, see SmoothNormals::reaction.
bool curved(const ContactPair& pair) {
  return pair.contact->normals == scene::ContactNormals::smooth && pair.has_springs();
}

void add_curved_forces(const NodalState& nodal, const ContactPair& pair, const Array<double* [3]>& force,
                       const WantedNodes& master, std::vector<double>& on_master) {
  std::vector<int> place(nodal.nodes.count, -1);
  for (std::size_t m = 0; m < pair.master_nodes.size(); ++m) place[pair.master_nodes[m]] = static_cast<int>(m);
  ExternalForceSum sum;
  sum.quantum = nodal.external.sum.quantum;
  sum.contact = Array<std::uint64_t* [3]>("shares of master nodes", pair.master_nodes.size());
  Kokkos::parallel_for("curved_shares", Range(0, pair.arrays.slave_count),
                       CurvedShares{ContactSearch{{pair.arrays, nodal.nodes.position}}, sum, *lent_copy(place), force});
  const auto quanta = to_host(sum.contact);
  for (std::size_t k = 0; k < master.places.size(); ++k)
    for (int i = 0; i < 3; ++i)
      on_master[3 * k + i] += sum.quantum * static_cast<double>(static_cast<std::int64_t>(quanta(master.places[k], i)));
}

void add_forces(const NodalState& nodal, const ContactPair& pair, const std::vector<TouchingSlave>& touching,
                const WantedNodes& slave_nodes, const WantedNodes& master_nodes, ContactSide& slave,
                ContactSide& master) {
  if (curved(pair)) {
    add_curved_forces(nodal, pair, pair.arrays.normal_force, master_nodes, master.normal_force);
    add_curved_forces(nodal, pair, pair.arrays.tangential_force, master_nodes, master.tangential_force);
  }
  for (const TouchingSlave& one : touching) {
    const int s = slave_nodes.place_of[one.slave];
    for (int i = 0; i < 3; ++i) {
      slave.normal_force[3 * s + i] += one.normal[i];
      slave.tangential_force[3 * s + i] += one.tangential[i];
    }
    for (int k = 0; k < 4 && !curved(pair); ++k) {
      const int m = master_nodes.place_of[pair.master_segments[one.segment][k]];
      for (int i = 0; i < 3; ++i) {
        master.normal_force[3 * m + i] -= one.share(k) * one.normal[i];
        master.tangential_force[3 * m + i] -= one.share(k) * one.tangential[i];
      }
    }
  }
}

/// Slip velocity of a slave node over its segment: relative velocity in the plane normal to its normal force.
Vec3 slip_velocity(const ContactPair& pair, const TouchingSlave& one, const WantedNodes& slave_nodes,
                   const WantedNodes& master_nodes, const ContactState& state) {
  const int s = slave_nodes.place_of[one.slave];
  Vec3 slip{};
  double along = 0, squared = 0;
  for (int i = 0; i < 3; ++i) {
    slip[i] = state.slave.velocity[3 * s + i];
    for (int k = 0; k < 4; ++k)
      slip[i] -=
          one.share(k) * state.master.velocity[3 * master_nodes.place_of[pair.master_segments[one.segment][k]] + i];
    along += slip[i] * one.normal[i];
    squared += one.normal[i] * one.normal[i];
  }
  if (squared > 0)
    for (int i = 0; i < 3; ++i) slip[i] -= along / squared * one.normal[i];
  return slip;
}

}  // namespace

ContactState contact_state(const NodalState& nodal, const Ties& ties, const std::vector<ContactPair>& contacts,
                           int contact, const ContactWish& wish) {
  const ContactPair& pair = contacts[contact];
  // Both halves of a symmetric contact number the nodes of each surface alike.
  const ContactPair* half = pair.partner >= 0 ? &contacts[pair.partner] : nullptr;
  const std::vector<TouchingSlave> touching = touching_slaves(nodal.nodes, pair);
  const std::vector<TouchingSlave> touching_half =
      half ? touching_slaves(nodal.nodes, *half) : std::vector<TouchingSlave>{};
  Bounds box = no_bounds;
  if (wish.margin) {
    widen_by(box, touching);
    widen_by(box, touching_half);
    for (int i = 0; i < 3; ++i) {
      box[0][i] -= *wish.margin;
      box[1][i] += *wish.margin;
    }
  }
  const auto wanted = [&](bool side, const Array<int*>& surface, const std::vector<int>& in_contact) {
    const std::size_t count = surface.extent(0);
    if (!side) return wanted_nodes(in_contact, count);
    return wish.margin ? wanted_nodes(nodes_in_box(nodal.nodes, surface, box), count) : all_nodes(count);
  };
  const WantedNodes slave =
      wanted(wish.slave, pair.arrays.slave_nodes,
             nodes_in_contact(touching, touching_half, half ? half->master_segments : pair.slave_facets));
  const WantedNodes master =
      wanted(wish.master, pair.arrays.master_nodes, nodes_in_contact(touching_half, touching, pair.master_segments));

  ContactState state;
  state.name = pair.contact->name;
  state.friction = pair.arrays.friction;
  state.slave = bare_side(pair.slave_nodes, slave);
  state.master = bare_side(pair.master_nodes, master);
  add_motion(
      nodal, ties,
      nodes_around(state.slave.nodes, pair.slave_nodes, pair.slave_facets, slave, wish.shape && wish.slave),
      nodes_around(state.master.nodes, pair.master_nodes, pair.master_segments, master, wish.shape && wish.master),
      state.slave, state.master);
  add_forces(nodal, pair, touching, slave, master, state.slave, state.master);
  if (half) add_forces(nodal, *half, touching_half, master, slave, state.master, state.slave);

  if (wish.slave && wish.gap) state.gap = present_gaps(nodal.nodes, pair, slave.places);
  for (double& gap : state.gap)
    if (!is_distance(gap)) gap = std::numeric_limits<double>::quiet_NaN();
  const std::size_t count = slave.places.size();
  if (const std::vector<double> friction = friction_now(*pair.contact, pair.law); !friction.empty())
    for (const int place : slave.places) state.friction_now.push_back(friction[place]);
  state.slip_velocity.assign(3 * count, 0);
  state.slipping.assign(count, 0);
  for (const TouchingSlave& one : touching) {
    const int s = slave.place_of[one.slave];
    state.slipping[s] = one.status;
    const Vec3 slip = slip_velocity(pair, one, slave, master, state);
    for (int i = 0; i < 3; ++i) state.slip_velocity[3 * s + i] = slip[i];
  }
  if (!wish.slave) {
    state.slave = {};
    for (auto* values : {&state.gap, &state.slip_velocity, &state.friction_now}) values->clear();
    state.slipping.clear();
  }
  if (!wish.master) state.master = {};
  return state;
}

}  // namespace railwave
