#include "model/fields.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mesh/hexahedron.hpp"
#include "model/boundaries/ties.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/materials.hpp"
#include "model/lent_array.hpp"
#include "model/nodal_state.hpp"

namespace railwave {
namespace {

/// Fields of nodes, one field after the other.
struct FetchNodes {
  static constexpr int most_fields = 4;
  SubcycledAcceleration acceleration;
  double lag;
  NodeField field[most_fields];
  int field_count, wanted_count;
  Array<const int*> wanted;
  Array<double*> result;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const NodeArrays& nodes = acceleration.plain.force.nodes;
    const int n = wanted(i);
    for (int f = 0; f < field_count; ++f) {
      Vector3 value = row(nodes.position, n);
      if (field[f] == NodeField::displacement) value = value - row(nodes.reference, n);
      if (field[f] == NodeField::velocity)
        value = row(nodes.velocity, n) + (acceleration.levels.steps(n) * lag) * acceleration(n);
      if (field[f] == NodeField::acceleration) value = acceleration.plain(n);
      for (int k = 0; k < 3; ++k) result(3 * (static_cast<std::size_t>(f) * wanted_count + i) + k) = value[k];
    }
  }
};

/// An element's place among the wanted, and its slot in its group's tiles.
struct WantedSlot {
  int place, slot;
};

/// Of the wanted elements those that are the group's.
std::vector<WantedSlot> wanted_slots(const ElementGroup& group, const std::vector<int>& elements) {
  std::vector<WantedSlot> slots;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto after = std::upper_bound(group.first_element.begin(), group.first_element.end(), elements[i]);
    if (after == group.first_element.begin()) continue;
    const int p = static_cast<int>(after - group.first_element.begin()) - 1,
              place = elements[i] - group.first_element[p];
    if (place < group.element_count[p]) slots.push_back({static_cast<int>(i), p * elements_of_block + place});
  }
  return slots;
}

/// Takes `components` of a group's tiles of `stored` values, from value `first`, to where they are wanted. S: the
/// elements' precision, by which the tiles are laid out.
template <class S, class Value>
struct FetchElements {
  Array<const WantedSlot*> slots;
  Array<Value*> tiles;
  int stored, first, components;
  Array<double*> result;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int c = 0; c < components; ++c)
      result(static_cast<std::size_t>(components) * slots(i).place + c) =
          tiles(tiled_slot<S>(slots(i).slot, stored, first + c));
  }
};

template <class S, class Value>
void fetch_elements(const FetchElements<S, Value>& fetch) {
  Kokkos::parallel_for("fetch_elements", Range(0, static_cast<int>(fetch.slots.extent(0))), fetch);
}

template <class S>
HostField stress_in(const ElementModel& elements, const NodeArrays& nodes, const std::vector<int>& wanted) {
  const LentArray<double*> result(6 * wanted.size());
  Kokkos::deep_copy(ExecutionSpace(), *result, 0.0);
  for (const ElementGroup& group : elements.elements) {
    const std::vector<WantedSlot> slots = wanted_slots(group, wanted);
    if (slots.empty()) continue;
    const LentArray<S*> stress(6 * static_cast<std::size_t>(group.blocks.count) * elements_of_block);
    const LentArray<double* [2]> unused(group.blocks.count);
    with_material(group, [&](const auto& material) {
      using State = ElementState<S, std::decay_t<decltype(material)>, ViscousHourglass>;
      launch_blocks(group.blocks, State{material, group.blocks, group.blocks.hourglass_scale, nodes, *stress, *unused});
    });
    fetch_elements(FetchElements<S, S>{*lent_copy(slots), *stress, 6, 0, 6, *result});
  }
  return {6, to_vector(*result)};
}

template <class S>
HostField plastic_strain_in(const ElementModel& elements, const std::vector<int>& wanted) {
  const LentArray<double*> result(wanted.size());
  Kokkos::deep_copy(ExecutionSpace(), *result, 0.0);
  for (const ElementGroup& group : elements.elements)
    with_material_type(group.material, [&](auto type) {
      using Material = typename decltype(type)::type;
      if constexpr (Material::history_values > 0)
        fetch_elements(FetchElements<S, double>{*lent_copy(wanted_slots(group, wanted)), group.material.history,
                                                Material::history_values, Material::plastic_strain, 1, *result});
    });
  return {1, to_vector(*result)};
}

/// Entries of a list of nodes that a prescribed motion moves.
std::vector<FieldEntry> driven_entries(const PrescribedSet& set, const std::vector<int>& nodes) {
  std::vector<FieldEntry> entries;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (std::binary_search(set.host_nodes.begin(), set.host_nodes.end(), nodes[i]))
      entries.push_back({static_cast<int>(i), nodes[i]});
  return entries;
}

bool of_motion(NodeField field) { return field == NodeField::velocity || field == NodeField::acceleration; }

/// Driven nodes move as their motion says, of which the scheme has no acceleration.
void follow_prescribed(const NodalState& nodal, const std::vector<NodeField>& fields, const std::vector<int>& nodes,
                       const Array<double*>& values) {
  if (std::none_of(fields.begin(), fields.end(), of_motion)) return;
  for (const PrescribedSet& set : nodal.prescribed) {
    const std::vector<FieldEntry> driven = driven_entries(set, nodes);
    const LentArray<FieldEntry*> entries = lent_copy(driven);
    const int count = static_cast<int>(driven.size());
    for (std::size_t f = 0; f < fields.size() && count > 0; ++f) {
      if (!of_motion(fields[f])) continue;
      const std::size_t first = 3 * f * nodes.size();
      Kokkos::parallel_for("follow_prescribed", Range(0, count),
                           PrescribedField{prescribed_instant(nodal, set), *entries, fields[f] == NodeField::velocity,
                                           Kokkos::subview(values, std::make_pair(first, first + 3 * nodes.size()))});
    }
  }
}

/// Of the fields one after the other.
std::vector<double> own_node_fields(const NodalState& nodal, const std::vector<NodeField>& fields,
                                    const std::vector<int>& nodes) {
  const int count = static_cast<int>(nodes.size());
  const LentArray<int*> wanted = lent_copy(nodes);
  const LentArray<double*> result(3 * fields.size() * nodes.size());
  FetchNodes fetch{
      nodal.subcycled_acceleration(), nodal.velocity_lag, {}, static_cast<int>(fields.size()), count, *wanted, *result};
  std::copy(fields.begin(), fields.end(), fetch.field);
  Kokkos::parallel_for("fetch_nodes", Range(0, count), fetch);
  follow_prescribed(nodal, fields, nodes, *result);
  return to_vector(*result);
}

/// Gives tied nodes the velocity or acceleration of the face they lie on: the scheme has none for them.
void follow_masters(const NodalState& nodal, const Ties& ties, NodeField field, const std::vector<int>& nodes,
                    std::vector<double>& values) {
  std::vector<std::size_t> of_slaves;  // positions in `nodes`
  std::vector<int> masters;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const TiedPlace* tied = ties.place_of(nodes[i])) {
      of_slaves.push_back(i);
      masters.insert(masters.end(), tied->face, tied->face + 4);
    }
  if (masters.empty()) return;
  const std::vector<double> of_masters = own_node_fields(nodal, {field}, masters);
  std::size_t next = 0;
  for (const std::size_t i : of_slaves) {
    const TiedPlace& tied = *ties.place_of(nodes[i]);
    for (int c = 0; c < 3; ++c) values[3 * i + c] = 0;
    for (int k = 0; k < 4; ++k, ++next)
      for (int c = 0; c < 3; ++c) values[3 * i + c] += tied.weight[k] * of_masters[3 * next + c];
  }
}

}  // namespace

std::vector<HostField> node_fields(const NodalState& nodal, const Ties& ties, const std::vector<NodeField>& fields,
                                   const std::vector<int>& nodes) {
  if (fields.size() > FetchNodes::most_fields) throw std::logic_error("more fields of nodes than there are");
  const std::vector<double> all = own_node_fields(nodal, fields, nodes);
  std::vector<HostField> result;
  auto next = all.begin();
  for (const NodeField field : fields) {
    const auto end = next + static_cast<std::ptrdiff_t>(3 * nodes.size());
    std::vector<double> values(next, end);
    if (of_motion(field) && ties.arrays.active()) follow_masters(nodal, ties, field, nodes, values);
    result.push_back({3, std::move(values)});
    next = end;
  }
  return result;
}

HostField node_field(const NodalState& nodal, const Ties& ties, NodeField field, const std::vector<int>& nodes) {
  return std::move(node_fields(nodal, ties, {field}, nodes).front());
}

HostField element_stress(const ElementModel& elements, const NodeArrays& nodes, const std::vector<int>& wanted) {
  return with_element_precision(elements,
                                [&](auto number) { return stress_in<decltype(number)>(elements, nodes, wanted); });
}

HostField element_plastic_strain(const ElementModel& elements, const std::vector<int>& wanted) {
  return with_element_precision(elements,
                                [&](auto number) { return plastic_strain_in<decltype(number)>(elements, wanted); });
}

}  // namespace railwave
