#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "model/build_steps.hpp"
#include "model/elements/hourglass_scale.hpp"
#include "model/elements/materials.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Elements whose Jacobian is not positive at the eight Gauss points cannot be integrated; a mere concave corner can
/// (the inner nodes of MacNeal and Harder's block have one), and `railwave check` reports it.
void check_element(const AssembledScene& assembled, const Assembly::PartRange& part, int element,
                   const HexahedronCorners& corners) {
  const double g = 1 / std::sqrt(3.0);
  for (const auto& s : hexahedron_corner_signs) {
    if (hexahedron_jacobian(corners, g * s[0], g * s[1], g * s[2]) > 0) continue;
    throw InputError(fmt::format(
        "{}: part '{}': element {} (counted from 0 in its mesh) near {} is inverted or flat; "
        "mend the mesh there, or number the element's corners bottom face first, then the top face, both turning the "
        "same way",
        assembled.scene.path, part.name, element - part.first_element, place_text(corners[0])));
  }
}

/// What elements of a group have in common beside hourglass control and level.
struct GroupKind {
  int material;  ///< its number among Materials
  bool damped;
  bool operator==(const GroupKind& other) const { return material == other.material && damped == other.damped; }
};

int group_of(std::vector<ElementGroup>& groups, std::vector<GroupKind>& kinds, const scene::Part& part,
             const GroupKind& kind, int level) {
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].hourglass == part.hourglass && kinds[g] == kind && groups[g].level == level) {
      groups[g].parts += ", " + part.name;
      return static_cast<int>(g);
    }
  groups.emplace_back();
  groups.back().hourglass = part.hourglass;
  groups.back().level = level;
  groups.back().parts = part.name;
  kinds.push_back(kind);
  return static_cast<int>(groups.size()) - 1;
}

/// Masses and lengths of a part's elements, and their hourglass scales by element.
void element_values(AssembledScene& assembled, const Assembly::PartRange& range, const scene::Part& part,
                    std::vector<float>& scale, std::vector<float>& settling) {
  const Assembly& assembly = assembled.assembly;
  const scene::Material& material = assembled.scene.materials[range.material];
  const double own = part.hourglass_coefficient;
  const double while_settling = settling_hourglass_coefficient(part);
  for (int e = range.first_element; e < range.first_element + range.element_count; ++e) {
    const HexahedronCorners x = corners_of(assembly.nodes, assembly.elements[e]);
    const auto integrals = hexahedron_shape_integrals(x);
    double volume = 0;
    for (double part_of_it : integrals) volume += part_of_it;
    scale[e] = static_cast<float>(hourglass_scale(part.hourglass, own, material, volume));
    settling[e] =
        static_cast<float>(hourglass_scale(scene::HourglassType::stiffness, while_settling, material, volume));
    assembled.element_length[e] = hexahedron_length(x);
    // Lumped mass by row sums (thesis 2.2.2).
    for (int N = 0; N < 8; ++N) assembled.mass[assembly.elements[e][N]] += material.density * integrals[N];
  }
}

/// The host side of a group's blocks.
struct BlockLists {
  std::vector<int> element_count, material;
  std::vector<std::vector<int>> node;                          ///< by block
  std::vector<std::vector<std::uint16_t>> first_place, place;  ///< by block
  std::vector<std::array<int, 3>> frame_node;
  std::vector<std::uint8_t> corner;
  std::vector<float> scale, settling;
};

double squared_distance(const Vec3& a, const Vec3& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

/// Three of the block's nodes far from each other and from one line.
std::array<int, 3> frame_nodes(const std::vector<Vec3>& x, const std::vector<int>& nodes) {
  const int a = nodes[0];
  int b = a, c = a;
  double farthest = -1, widest = -1;
  for (int n : nodes)
    if (squared_distance(x[n], x[a]) > farthest) {
      farthest = squared_distance(x[n], x[a]);
      b = n;
    }
  for (int n : nodes) {
    Vec3 u{}, w{};
    for (int i = 0; i < 3; ++i) {
      u[i] = x[b][i] - x[a][i];
      w[i] = x[n][i] - x[a][i];
    }
    const Vec3 area{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
    const double wide = area[0] * area[0] + area[1] * area[1] + area[2] * area[2];
    if (wide > widest) {
      widest = wide;
      c = n;
    }
  }
  return {a, b, c};
}

/// A block's nodes by how many of its corners meet there, so that sums over corners run equally long side by side, and
/// in the mesh's own order among those, which lies well in memory.
std::vector<int> local_nodes(const Assembly& assembly, const BlockOrder& order, int first, int end,
                             std::vector<int>& corners) {
  std::vector<int> all;
  for (int e = first; e < end; ++e) all.insert(all.end(), assembly.elements[e].begin(), assembly.elements[e].end());
  std::sort(all.begin(), all.end());
  std::vector<std::array<int, 3>> nodes;  // corners, number in the mesh, number
  for (std::size_t k = 0; k < all.size();) {
    std::size_t same = k;
    while (same < all.size() && all[same] == all[k]) ++same;
    nodes.push_back({static_cast<int>(same - k), order.mesh_number[all[k]], all[k]});
    k = same;
  }
  std::sort(nodes.begin(), nodes.end());
  std::vector<int> result;
  for (const auto& node : nodes) {
    corners.push_back(node[0]);
    result.push_back(node[2]);
  }
  return result;
}

/// The sums over corners, a pack of nodes at a time.
void append_packs(const std::vector<std::vector<std::uint16_t>>& places, int lanes, BlockLists& lists) {
  std::vector<std::uint16_t> first{0}, all;
  for (std::size_t begin = 0; begin < places.size(); begin += lanes) {
    const std::size_t end = std::min(places.size(), begin + lanes);
    std::size_t longest = 0;
    for (std::size_t l = begin; l < end; ++l) longest = std::max(longest, places[l].size());
    for (std::size_t c = 0; c < longest; ++c)
      for (std::size_t l = begin; l < begin + lanes; ++l)
        all.push_back(l < end && c < places[l].size() ? places[l][c] : static_cast<std::uint16_t>(zero_place));
    first.push_back(static_cast<std::uint16_t>(all.size()));
  }
  lists.first_place.push_back(std::move(first));
  lists.place.push_back(std::move(all));
}

/// Appends the block of elements [first, end).
void append_block(const Assembly& assembly, const BlockOrder& order, int first, int end, int lanes, BlockLists& lists) {
  const int count = end - first;
  std::vector<int> corners;
  const std::vector<int> nodes = local_nodes(assembly, order, first, end, corners);
  std::unordered_map<int, int> local;
  for (std::size_t l = 0; l < nodes.size(); ++l) local[nodes[l]] = static_cast<int>(l);
  std::vector<std::vector<std::uint16_t>> places(nodes.size());
  const std::size_t base = lists.corner.size();
  lists.corner.resize(base + 8u * elements_of_block);
  for (int slot = 0; slot < elements_of_block; ++slot)
    for (int N = 0; N < 8; ++N) {
      const int l = local[assembly.elements[first + std::min(slot, count - 1)][N]];
      lists.corner[base + (static_cast<std::size_t>(slot / lanes) * 8 + N) * lanes + slot % lanes] =
          static_cast<std::uint8_t>(l);
      if (slot < count) places[l].push_back(static_cast<std::uint16_t>(N * elements_of_block + slot));
    }
  append_packs(places, lanes, lists);
  lists.element_count.push_back(count);
  lists.frame_node.push_back(frame_nodes(assembly.nodes, nodes));
  lists.node.push_back(nodes);
}

/// Rows of equal length, a multiple of `multiple`, filled up with each row's first value.
template <class T>
Array<T*> even_rows(const char* label, const std::vector<std::vector<T>>& rows, int multiple, int& stride) {
  std::size_t longest = 0;
  for (const auto& row : rows) longest = std::max(longest, row.size());
  stride = static_cast<int>((longest + multiple - 1) / multiple * multiple);
  std::vector<T> all;
  all.reserve(rows.size() * stride);
  for (const auto& row : rows) {
    all.insert(all.end(), row.begin(), row.end());
    all.resize(all.size() + stride - row.size(), row.front());
  }
  return to_device(label, all);
}

ElementBlocks arrays_of(const BlockLists& lists, bool single_precision) {
  ElementBlocks blocks;
  blocks.count = static_cast<int>(lists.element_count.size());
  std::vector<int> node_count;
  for (const auto& nodes : lists.node) node_count.push_back(static_cast<int>(nodes.size()));
  blocks.element_count = to_device("block element count", lists.element_count);
  blocks.node_count = to_device("block node count", node_count);
  blocks.material = to_device("block material", lists.material);
  blocks.node = even_rows("block nodes", lists.node, node_room, blocks.node_stride);
  blocks.frame_node = to_device("block frame nodes", lists.frame_node);
  if (single_precision) blocks.frame = Array<double * [BlockFrame::values]>("block frames", blocks.count);
  blocks.corner = to_device("block corners", lists.corner);
  blocks.first_place = even_rows("first corner places", lists.first_place, places_at_once, blocks.pack_stride);
  blocks.place = even_rows("corner places", lists.place, places_at_once, blocks.place_stride);
  blocks.hourglass_scale = to_device("hourglass scale", lists.scale);
  blocks.settling_hourglass = to_device("hourglass scale while settling", lists.settling);
  blocks.hourglass_energy = Array<double*>("hourglass energy", static_cast<std::size_t>(blocks.count) * power_sums);
  return blocks;
}

/// m3, of a group's elements in the reference, by slot; zero in slots that only fill up.
std::vector<double> reference_volumes(const Assembly& assembly, const ElementGroup& group) {
  std::vector<double> volume(group.first_element.size() * elements_of_block, 0.0);
  for (std::size_t p = 0; p < group.first_element.size(); ++p)
    for (int slot = 0; slot < group.element_count[p]; ++slot)
      volume[p * elements_of_block + slot] =
          hexahedron_volume(corners_of(assembly.nodes, assembly.elements[group.first_element[p] + slot]));
  return volume;
}

/// Constants of damped parts, and the drag of their blocks' nodes.
DampingArrays damping_arrays(const Assembly& assembly, const AbsorbingLayers& absorbing, const ElementGroup& group,
                             const std::vector<std::vector<int>>& nodes, const std::vector<const scene::Part*>& parts,
                             const std::vector<const scene::Material*>& materials) {
  std::vector<DampingConstants> constants;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    const scene::Part& part = *parts[r];
    const ElasticConstants elastic = elastic_constants(*materials[r]);
    const double density = materials[r]->density;
    constants.push_back({part.stiffness_damping * elastic.lambda, part.stiffness_damping * elastic.mu,
                         part.linear_bulk_viscosity * density * materials[r]->dilatational_speed(),
                         part.quadratic_bulk_viscosity * density});
  }
  const auto row = to_host(group.blocks.material);
  std::vector<double> mass(static_cast<std::size_t>(group.blocks.count) * group.blocks.node_stride, 0.0);
  for (int p = 0; p < group.blocks.count; ++p) {
    std::unordered_map<int, std::size_t> place;
    for (std::size_t l = 0; l < nodes[p].size(); ++l)
      place[nodes[p][l]] = static_cast<std::size_t>(p) * group.blocks.node_stride + l;
    for (int e = group.first_element[p]; e < group.first_element[p] + group.element_count[p]; ++e) {
      const auto& corners = assembly.elements[e];
      const auto integrals = hexahedron_shape_integrals(corners_of(assembly.nodes, corners));
      for (int N = 0; N < 8; ++N) mass[place[corners[N]]] += materials[row(p)]->density * integrals[N];
    }
  }
  std::vector<double> drag(mass.size(), 0.0);
  const auto& layers = absorbing.rate;
  for (int p = 0; p < group.blocks.count; ++p)
    for (std::size_t l = 0; l < nodes[p].size(); ++l) {
      const std::size_t at = static_cast<std::size_t>(p) * group.blocks.node_stride + l;
      drag[at] = (parts[row(p)]->mass_damping + (layers.empty() ? 0.0 : layers[nodes[p][l]])) * mass[at];
    }
  return {to_device("damping constants", constants), to_device("drag of blocks' nodes", drag),
          Array<double*>("damping energy", group.blocks.count),
          group.first_partial + group.blocks.count * group.blocks.node_stride};
}

/// Whether elements [first, end) have a node that an absorbing layer damps.
bool in_absorbing_layer(const Assembly& assembly, const AbsorbingLayers& absorbing, int first, int end) {
  const auto& rate = absorbing.rate;
  if (rate.empty()) return false;
  return std::any_of(assembly.elements.begin() + first, assembly.elements.begin() + end, [&](const auto& corners) {
    return std::any_of(corners.begin(), corners.end(), [&](int n) { return rate[n] > 0; });
  });
}

/// The blocks' numbers, level by level, so that groups ascend by it.
std::vector<int> blocks_by_level(const BlockOrder& order) {
  std::vector<int> numbers(order.level.size());
  for (std::size_t p = 0; p < numbers.size(); ++p) numbers[p] = static_cast<int>(p);
  std::stable_sort(numbers.begin(), numbers.end(), [&](int a, int b) { return order.level[a] < order.level[b]; });
  return numbers;
}

}  // namespace

void check_elements(const AssembledScene& assembled) {
  for (const auto& part : assembled.assembly.parts)
    for (int e = part.first_element; e < part.first_element + part.element_count; ++e)
      check_element(assembled, part, e, corners_of(assembled.assembly.nodes, assembled.assembly.elements[e]));
}

void build_elements(AssembledScene& assembled, const AbsorbingLayers& absorbing, ElementModel& elements,
                    PartialForces& partial) {
  const Assembly& assembly = assembled.assembly;
  assembled.mass.assign(assembly.nodes.size(), 0);
  assembled.element_length.resize(assembly.elements.size());
  std::vector<float> scale(assembly.elements.size()), settling(scale.size());
  for (std::size_t p = 0; p < assembly.parts.size(); ++p)
    element_values(assembled, assembly.parts[p], assembled.scene.parts[p], scale, settling);
  for (std::size_t i = 0; i < assembled.scene.points.size(); ++i)
    assembled.mass[assembly.point_nodes[i]] = assembled.scene.points[i].mass;

  std::vector<ElementGroup>& groups = elements.elements;
  const bool single = elements.in_single = assembled.scene.solver.elements_in_single();
  const int lanes = single ? lane_count<float> : lane_count<double>;
  std::vector<BlockLists> lists;
  std::vector<std::vector<const scene::Material*>> materials;
  std::vector<std::vector<const scene::Part*>> parts;
  std::vector<GroupKind> kinds;
  std::size_t part = 0;
  std::map<std::array<int, 3>, std::array<int, 2>>
      rows_of;  // by level, part and damping: group, and row of constants in it
  for (const int p : blocks_by_level(elements.order)) {
    const int first = elements.order.first_element[p], end = elements.order.first_element[p + 1];
    part = 0;
    while (first >= assembly.parts[part].first_element + assembly.parts[part].element_count) ++part;
    const auto& range = assembly.parts[part];
    const scene::Part& of_scene = assembled.scene.parts[part];
    const bool damped = of_scene.damped() || in_absorbing_layer(assembly, absorbing, first, end);
    const auto [found, is_new] = rows_of.try_emplace({elements.order.level[p], static_cast<int>(part), damped ? 1 : 0});
    int& group = found->second[0];
    if (is_new) {
      const scene::Material& material = assembled.scene.materials[range.material];
      group = group_of(groups, kinds, of_scene, {material_number(material), damped}, elements.order.level[p]);
      lists.resize(groups.size());
      materials.resize(groups.size());
      parts.resize(groups.size());
      materials[group].push_back(&material);
      parts[group].push_back(&of_scene);
      found->second[1] = static_cast<int>(materials[group].size()) - 1;
    }
    append_block(assembly, elements.order, first, end, lanes, lists[group]);
    lists[group].material.push_back(found->second[1]);
    for (int slot = 0; slot < elements_of_block; ++slot) {
      // Slots that only fill up must not dissipate.
      lists[group].scale.push_back(slot < end - first ? scale[first + slot] : 0.0f);
      lists[group].settling.push_back(slot < end - first ? settling[first + slot] : 0.0f);
    }
    groups[group].first_element.push_back(first);
    groups[group].element_count.push_back(end - first);
  }
  int rows = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    ElementGroup& built = groups[g];
    built.blocks = arrays_of(lists[g], single);
    built.block_energy = unset_array<double* [2]>("block energy", built.blocks.count);
    built.block_sums = unset_array<double* [energies_of_block]>("energies of blocks", built.blocks.count);
    built.block_sums_fetched =
        PinnedArray<double* [energies_of_block]>("energies of blocks, fetched", built.blocks.count);
    built.material = material_arrays(kinds[g].material, materials[g], built.first_element.size() * elements_of_block);
    if (built.material.flows()) {
      built.material.volume = to_device("reference volume", reference_volumes(assembly, built));
      built.slot_sums =
          unset_array<double*>("work of flow", static_cast<std::size_t>(built.blocks.count) * flow_threads);
    }
    built.first_partial = rows;
    if (kinds[g].damped)
      built.damping = damping_arrays(assembly, absorbing, built, lists[g].node, parts[g], materials[g]);
    rows = built.rows_end();
  }
  partial.single_precision = single;
  if (single)
    partial.in_single = Array<PartialForce<float>*>("partial forces", rows);
  else
    partial.in_double = Array<PartialForce<double>*>("partial forces", rows);
}

void renew_frames(const NodeArrays& nodes, const ElementGroup& group) {
  if (group.blocks.frame.extent(0) == 0) return;
  Kokkos::parallel_for("renew_frames", Range(0, group.blocks.count),
                       RenewFrames{group.blocks, nodes.position, nodes.reference});
}

}  // namespace railwave
