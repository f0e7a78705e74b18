#include "model/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "kernels/contact/contact_force.hpp"
#include "mesh/hexahedron.hpp"
#include "mesh/vectors.hpp"
#include "model/boundaries/ties.hpp"
#include "model/contact/contact_law.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/materials.hpp"
#include "model/host_copy.hpp"
#include "model/nodal_state.hpp"

namespace railwave {
namespace {

struct FetchNodes {
  SubcycledAcceleration acceleration;
  double lag;
  NodeField field;
  Array<const int*> wanted;
  Array<double*> result;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const int n = wanted(i);
    Vector3 value = row(nodes.position, n);
    if (field == NodeField::displacement) value = value - row(nodes.reference, n);
    if (field == NodeField::velocity)
      value = row(nodes.velocity, n) + (acceleration.levels.steps(n) * lag) * acceleration(n);
    if (field == NodeField::acceleration) value = acceleration.plain(n);
    for (int k = 0; k < 3; ++k) result(3 * i + k) = value[k];
  }
};

/// Areas and unit normals at the nodes of one side, from its facets as they lie now.
void surface_geometry(ContactSide& side) {
  const std::size_t count = side.nodes.size();
  side.area.assign(count, 0);
  side.normal.assign(3 * count, 0);
  const auto point = [&](int k) {
    return Vec3{side.position[3 * k], side.position[3 * k + 1], side.position[3 * k + 2]};
  };
  for (const auto& facet : side.facets) {
    const Vec3 a = point(facet[0]), b = point(facet[1]), c = point(facet[2]), d = point(facet[3]);
    const double area = facet_area(a, b, c, d);
    const Vec3 normal = cross(difference(c, a), difference(d, b));
    for (int k : facet) {
      side.area[k] += 0.25 * area;
      for (int i = 0; i < 3; ++i) side.normal[3 * k + i] += normal[i];
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    double* n = &side.normal[3 * k];
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i) n[i] /= size;
  }
}

ContactSide bare_side(const NodalState& nodal, const Ties& ties, const std::vector<int>& nodes,
                      const std::vector<std::array<int, 4>>& facets) {
  ContactSide side;
  side.nodes = nodes;
  side.facets = facets;
  side.position = node_field(nodal, ties, NodeField::position, nodes).values;
  side.velocity = node_field(nodal, ties, NodeField::velocity, nodes).values;
  side.normal_force.assign(3 * nodes.size(), 0);
  side.tangential_force.assign(3 * nodes.size(), 0);
  surface_geometry(side);
  return side;
}

/// Of the wanted elements those that are the group's: their places among the wanted, and their slots in the group's
/// tiles.
Array<int* [2]> wanted_slots(const ElementGroup& group, const std::vector<int>& elements) {
  std::vector<std::array<int, 2>> slots;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto after = std::upper_bound(group.first_element.begin(), group.first_element.end(), elements[i]);
    if (after == group.first_element.begin()) continue;
    const int p = static_cast<int>(after - group.first_element.begin()) - 1,
              place = elements[i] - group.first_element[p];
    if (place < group.element_count[p]) slots.push_back({static_cast<int>(i), p * elements_of_block + place});
  }
  return to_device("wanted slots", slots);
}

/// Takes `components` of a group's tiles of `stored` values, from value `first`, to where they are wanted. S: the
/// elements' precision, by which the tiles are laid out.
template <class S, class Value>
struct FetchElements {
  Array<int* [2]> slots;
  Array<Value*> tiles;
  int stored, first, components;
  Array<double*> result;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int c = 0; c < components; ++c)
      result(static_cast<std::size_t>(components) * slots(i, 0) + c) =
          tiles(tiled_slot<S>(slots(i, 1), stored, first + c));
  }
};

template <class S, class Value>
void fetch_elements(const FetchElements<S, Value>& fetch) {
  Kokkos::parallel_for("fetch_elements", Range(0, static_cast<int>(fetch.slots.extent(0))), fetch);
}

template <class S>
HostField stress_in(const ElementModel& elements, const NodeArrays& nodes, const std::vector<int>& wanted) {
  const auto result = unset_array<double*>("stress field", 6 * wanted.size());
  Kokkos::deep_copy(result, 0.0);
  for (const ElementGroup& group : elements.elements) {
    const auto slots = wanted_slots(group, wanted);
    if (slots.extent(0) == 0) continue;
    const auto stress = unset_array<S*>("stress", 6 * static_cast<std::size_t>(group.blocks.count) * elements_of_block);
    const auto unused = unset_array<double* [2]>("block energy", group.blocks.count);
    with_material(group, [&](const auto& material) {
      using State = ElementState<S, std::decay_t<decltype(material)>, ViscousHourglass>;
      launch_blocks(group.blocks, State{material, group.blocks, group.blocks.hourglass_scale, nodes, stress, unused});
    });
    fetch_elements(FetchElements<S, S>{slots, stress, 6, 0, 6, result});
  }
  return {6, to_vector(result)};
}

template <class S>
HostField plastic_strain_in(const ElementModel& elements, const std::vector<int>& wanted) {
  const auto result = unset_array<double*>("plastic strain field", wanted.size());
  Kokkos::deep_copy(result, 0.0);
  for (const ElementGroup& group : elements.elements)
    with_material_type(group.material, [&](auto type) {
      using Material = typename decltype(type)::type;
      if constexpr (Material::history_values > 0)
        fetch_elements(FetchElements<S, double>{wanted_slots(group, wanted), group.material.history,
                                                Material::history_values, Material::plastic_strain, 1, result});
    });
  return {1, to_vector(result)};
}

/// Present gap of the far nodes in the window: a step projects the near ones only.
struct PresentGap {
  ContactSearch search;
  ContactWindow window;
  Array<double*> gap;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const WindowEntry entry = window.entries(i);
    if (entry.near != 0) return;
    const ContactArrays& contact = search.contact;
    const int s = entry.slave;
    const Vector3 slave = row(search.position, entry.node);
    if (gap(s) == turned_away) return;
    const Projection found = search.locate(slave, contact.tracked(s));
    gap(s) = found.segment < 0 ? beside_surface : found.gap;
  }
};

Array<double*>::HostMirror present_gaps(const NodeArrays& nodes, const ContactPair& pair) {
  const auto gap = unset_array<double*>("present gap", pair.arrays.slave_count);
  Kokkos::deep_copy(gap, pair.arrays.gap);
  Kokkos::parallel_for("present_gap", Range(0, pair.window.count),
                       PresentGap{ContactSearch{{pair.arrays, nodes.position}}, pair.window, gap});
  return to_host(gap);
}

/// Present contact state of a pair's slave nodes, on the host.
struct SlavesNow {
  Array<double*[3]>::HostMirror normal, tangential;
  Array<double* [2]>::HostMirror place;
  Array<int*>::HostMirror status, segment;

  explicit SlavesNow(const ContactArrays& contact)
      : normal(to_host(contact.normal_force)),
        tangential(to_host(contact.tangential_force)),
        place(to_host(contact.place)),
        status(to_host(contact.status)),
        segment(to_host(contact.tracked)) {}

  double share(int s, int corner) const { return segment_shape(corner, place(s, 0), place(s, 1)); }
};

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
                       std::vector<double>& on_master) {
  std::vector<int> place(nodal.nodes.count, -1);
  for (std::size_t m = 0; m < pair.master_nodes.size(); ++m) place[pair.master_nodes[m]] = static_cast<int>(m);
  ExternalForceSum sum;
  sum.quantum = nodal.external.sum.quantum;
  sum.contact = Array<std::uint64_t* [3]>("shares of master nodes", pair.master_nodes.size());
  Kokkos::parallel_for(
      "curved_shares", Range(0, pair.arrays.slave_count),
      CurvedShares{ContactSearch{{pair.arrays, nodal.nodes.position}}, sum, to_device("place of node", place), force});
  const auto quanta = to_host(sum.contact);
  for (std::size_t m = 0; m < pair.master_nodes.size(); ++m)
    for (int i = 0; i < 3; ++i)
      on_master[3 * m + i] += sum.quantum * static_cast<double>(static_cast<std::int64_t>(quanta(m, i)));
}

void add_forces(const NodalState& nodal, const ContactPair& pair, const SlavesNow& now, ContactSide& slave,
                ContactSide& master) {
  if (curved(pair)) {
    add_curved_forces(nodal, pair, pair.arrays.normal_force, master.normal_force);
    add_curved_forces(nodal, pair, pair.arrays.tangential_force, master.tangential_force);
  }
  for (int s = 0; s < pair.arrays.slave_count; ++s) {
    if (now.status(s) == status_apart) continue;
    for (int i = 0; i < 3; ++i) {
      slave.normal_force[3 * s + i] += now.normal(s, i);
      slave.tangential_force[3 * s + i] += now.tangential(s, i);
    }
    for (int k = 0; k < 4 && !curved(pair); ++k) {
      const int m = pair.master_segments[now.segment(s)][k];
      for (int i = 0; i < 3; ++i) {
        master.normal_force[3 * m + i] -= now.share(s, k) * now.normal(s, i);
        master.tangential_force[3 * m + i] -= now.share(s, k) * now.tangential(s, i);
      }
    }
  }
}

HostField own_node_field(const NodalState& nodal, NodeField field, const std::vector<int>& nodes) {
  const auto result = unset_array<double*>("node field", 3 * nodes.size());
  Kokkos::parallel_for(
      "fetch_nodes", Range(0, static_cast<int>(nodes.size())),
      FetchNodes{nodal.subcycled_acceleration(), nodal.velocity_lag, field, to_device("wanted", nodes), result});
  return {3, to_vector(result)};
}

/// Gives tied nodes the velocity or acceleration of the face they lie on: the scheme has none for them.
void follow_masters(const NodalState& nodal, const Ties& ties, NodeField field, const std::vector<int>& nodes,
                    std::vector<double>& values) {
  std::vector<int> place_of(nodal.nodes.count, -1), masters;
  for (std::size_t s = 0; s < ties.places.size(); ++s) place_of[ties.places[s].slave] = static_cast<int>(s);
  for (int n : nodes)
    if (place_of[n] >= 0)
      masters.insert(masters.end(), ties.places[place_of[n]].face, ties.places[place_of[n]].face + 4);
  if (masters.empty()) return;
  const auto of_masters = own_node_field(nodal, field, masters).values;
  std::size_t next = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (place_of[nodes[i]] < 0) continue;
    const TiedPlace& tied = ties.places[place_of[nodes[i]]];
    for (int c = 0; c < 3; ++c) values[3 * i + c] = 0;
    for (int k = 0; k < 4; ++k, ++next)
      for (int c = 0; c < 3; ++c) values[3 * i + c] += tied.weight[k] * of_masters[3 * next + c];
  }
}

/// Slip velocity of a slave node over its segment: relative velocity in the plane normal to its normal force.
Vec3 slip_velocity(const ContactPair& pair, const SlavesNow& now, const ContactState& state, int s) {
  Vec3 slip{};
  double along = 0, squared = 0;
  for (int i = 0; i < 3; ++i) {
    slip[i] = state.slave.velocity[3 * s + i];
    for (int k = 0; k < 4; ++k)
      slip[i] -= now.share(s, k) * state.master.velocity[3 * pair.master_segments[now.segment(s)][k] + i];
    along += slip[i] * now.normal(s, i);
    squared += now.normal(s, i) * now.normal(s, i);
  }
  if (squared > 0)
    for (int i = 0; i < 3; ++i) slip[i] -= along / squared * now.normal(s, i);
  return slip;
}

}  // namespace

HostField node_field(const NodalState& nodal, const Ties& ties, NodeField field, const std::vector<int>& nodes) {
  HostField values = own_node_field(nodal, field, nodes);
  const bool follows = field == NodeField::velocity || field == NodeField::acceleration;
  if (follows && ties.arrays.active()) follow_masters(nodal, ties, field, nodes, values.values);
  return values;
}

HostField element_stress(const ElementModel& elements, const NodeArrays& nodes, const std::vector<int>& wanted) {
  return with_element_precision(elements,
                                [&](auto number) { return stress_in<decltype(number)>(elements, nodes, wanted); });
}

HostField element_plastic_strain(const ElementModel& elements, const std::vector<int>& wanted) {
  return with_element_precision(elements,
                                [&](auto number) { return plastic_strain_in<decltype(number)>(elements, wanted); });
}

ContactState contact_state(const NodalState& nodal, const Ties& ties, const std::vector<ContactPair>& contacts,
                           int contact) {
  const ContactPair& pair = contacts[contact];
  ContactState state;
  state.name = pair.contact->name;
  state.friction = pair.arrays.friction;
  state.friction_now = friction_now(*pair.contact, pair.law);
  state.slave = bare_side(nodal, ties, pair.slave_nodes, pair.slave_facets);
  state.master = bare_side(nodal, ties, pair.master_nodes, pair.master_segments);

  const SlavesNow now(pair.arrays);
  add_forces(nodal, pair, now, state.slave, state.master);
  if (pair.partner >= 0) {
    // Both halves of a symmetric contact number the nodes of each surface alike.
    const ContactPair& other = contacts[pair.partner];
    add_forces(nodal, other, SlavesNow(other.arrays), state.master, state.slave);
  }
  const auto gap = present_gaps(nodal.nodes, pair);
  const int count = pair.arrays.slave_count;
  state.gap.assign(count, std::numeric_limits<double>::quiet_NaN());
  state.slip_velocity.assign(3 * static_cast<std::size_t>(count), 0);
  state.slipping.assign(count, 0);
  for (int s = 0; s < count; ++s) {
    if (is_distance(gap(s))) state.gap[s] = gap(s);
    state.slipping[s] = now.status(s);
    if (now.status(s) == status_apart) continue;
    const Vec3 slip = slip_velocity(pair, now, state, s);
    for (int i = 0; i < 3; ++i) state.slip_velocity[3 * s + i] = slip[i];
  }
  return state;
}

}  // namespace railwave
