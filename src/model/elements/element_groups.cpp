#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/error.hpp"
#include "mesh/hexahedron.hpp"
#include "model/build_steps.hpp"
#include "model/elements/block_nodes.hpp"
#include "model/elements/materials.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// Elements whose Jacobian is not positive at the eight Gauss points cannot be integrated; a mere concave corner can
/// (the inner nodes of MacNeal and Harder's block have one), and `railwave check` reports it.
bool can_be_integrated(const HexahedronCorners& corners) {
  const double g = 1 / std::sqrt(3.0);
  return std::all_of(std::begin(hexahedron_corner_signs), std::end(hexahedron_corner_signs),
                     [&](const auto& s) { return hexahedron_jacobian(corners, g * s[0], g * s[1], g * s[2]) > 0; });
}

void check_part(const AssembledScene& assembled, const Assembly::PartRange& part) {
  const Assembly& assembly = assembled.assembly;
  const auto corners = [&](int element) { return corners_of(assembly.nodes, assembly.elements[element]); };
  std::vector<char> good(part.element_count);
  on_host_threads(part.element_count, [&](int k) { good[k] = can_be_integrated(corners(part.first_element + k)); });
  for (int k = 0; k < part.element_count; ++k) {
    if (good[k] != 0) continue;
    throw InputError(fmt::format(
        "{}: part '{}': element {} (counted from 0 in its mesh) near {} is inverted or flat; "
        "mend the mesh there, or number the element's corners bottom face first, then the top face, both turning the "
        "same way",
        assembled.scene.path, part.name, k, place_text(corners(part.first_element + k)[0])));
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

void weigh_part(AssembledScene& assembled, const Assembly::PartRange& range) {
  const Assembly& assembly = assembled.assembly;
  const scene::Material& material = assembled.scene.materials[range.material];
  // Threads integrate so many elements at once, one adds them in their order.
  constexpr int at_once = 1 << 14;
  std::vector<std::array<double, 8>> integrals(std::min(at_once, range.element_count));
  for (int first = 0; first < range.element_count; first += at_once) {
    const int count = std::min(at_once, range.element_count - first), begin = range.first_element + first;
    on_host_threads(count, [&](int k) {
      const HexahedronCorners x = corners_of(assembly.nodes, assembly.elements[begin + k]);
      integrals[k] = hexahedron_shape_integrals(x);
      assembled.element_length[begin + k] = hexahedron_length(x);
    });
    // Lumped mass by row sums (thesis 2.2.2).
    for (int k = 0; k < count; ++k)
      for (int N = 0; N < 8; ++N) assembled.mass[assembly.elements[begin + k][N]] += material.density * integrals[k][N];
  }
}

/// The host side of a group's blocks.
struct BlockLists {
  std::vector<int> material, node_count;
  std::vector<int> node;  ///< block after block
  std::vector<std::array<int, 3>> frame_node;
  int longest = 0;  ///< list of nodes
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

/// The nodes of elements [first, end), in the order in which their block has them.
/// @param banks see order_for_warps
std::vector<int> local_nodes(const Assembly& assembly, const BlockOrder& order, int first, int end, int banks) {
  std::vector<int> all;
  for (int e = first; e < end; ++e) all.insert(all.end(), assembly.elements[e].begin(), assembly.elements[e].end());
  std::sort(all.begin(), all.end());
  std::vector<BlockNode> nodes;
  for (int n : all) {
    if (nodes.empty() || nodes.back().number != n) nodes.push_back({0, order.mesh_number[n], n});
    ++nodes.back().corners;
  }
  if (on_device) {
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<CornerNodes> elements(assembly.elements.begin() + first, assembly.elements.begin() + end);
    for (auto& corners : elements)
      for (int& n : corners) n = static_cast<int>(std::lower_bound(all.begin(), all.end(), n) - all.begin());
    order_for_warps(elements, banks, nodes);
  } else {
    order_for_packs(nodes);
  }
  std::vector<int> result;
  for (const BlockNode& node : nodes) result.push_back(node.number);
  return result;
}

/// Nodes of blocks one after the other: threads find those of so many blocks at a time.
class NodesOfBlocks {
 public:
  NodesOfBlocks(const Assembly& assembly, const BlockOrder& order, const std::vector<int>& blocks, bool single)
      : assembly_(assembly), order_(order), blocks_(blocks), banks_(single ? 32 : 16) {}

  std::vector<int> next() {
    constexpr std::size_t at_once = 1 << 10;
    if (next_ == found_.size()) {
      found_.resize(std::min(at_once, blocks_.size() - first_));
      on_host_threads(static_cast<int>(found_.size()), [&](int k) {
        const int p = blocks_[first_ + k];
        found_[k] = local_nodes(assembly_, order_, order_.first_element[p], order_.first_element[p + 1], banks_);
      });
      first_ += found_.size();
      next_ = 0;
    }
    return std::move(found_[next_++]);
  }

 private:
  const Assembly& assembly_;
  const BlockOrder& order_;
  const std::vector<int>& blocks_;
  const int banks_;
  std::vector<std::vector<int>> found_;
  std::size_t first_ = 0, next_ = 0;
};

void append_block(const Assembly& assembly, const std::vector<int>& nodes, BlockLists& lists) {
  lists.frame_node.push_back(frame_nodes(assembly.nodes, nodes));
  lists.node_count.push_back(static_cast<int>(nodes.size()));
  lists.node.insert(lists.node.end(), nodes.begin(), nodes.end());
  lists.longest = std::max(lists.longest, lists.node_count.back());
}

/// Nodes of each block in rows of equal length, filled up with each row's first.
Array<int*> node_rows(const BlockLists& lists, int& stride) {
  stride = (lists.longest + node_room - 1) / node_room * node_room;
  const auto rows = unset_array<int*>("block nodes", lists.node_count.size() * stride);
  const auto host = Kokkos::create_mirror_view(rows);
  std::size_t first = 0;
  for (std::size_t p = 0; p < lists.node_count.size(); ++p) {
    for (int l = 0; l < stride; ++l) host(p * stride + l) = lists.node[first + (l < lists.node_count[p] ? l : 0)];
    first += lists.node_count[p];
  }
  Kokkos::deep_copy(rows, host);
  return rows;
}

ElementBlocks blocks_of(const BlockLists& lists, const std::vector<int>& element_count) {
  ElementBlocks blocks;
  blocks.count = static_cast<int>(element_count.size());
  blocks.element_count = to_device("block element count", element_count);
  blocks.node_count = to_device("block node count", lists.node_count);
  blocks.material = to_device("block material", lists.material);
  blocks.node = node_rows(lists, blocks.node_stride);
  blocks.frame_node = to_device("block frame nodes", lists.frame_node);
  return blocks;
}

DampingArrays damping_arrays(const ElementGroup& group, const std::vector<const scene::Part*>& parts,
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
  return {to_device("damping constants", constants),
          {},
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
  for (const auto& part : assembled.assembly.parts) check_part(assembled, part);
}

void weigh_elements(AssembledScene& assembled) {
  const Assembly& assembly = assembled.assembly;
  assembled.mass.assign(assembly.nodes.size(), 0);
  assembled.element_length.resize(assembly.elements.size());
  for (const auto& part : assembly.parts) weigh_part(assembled, part);
  for (std::size_t i = 0; i < assembled.scene.points.size(); ++i)
    assembled.mass[assembly.point_nodes[i]] = assembled.scene.points[i].mass;
}

void build_blocks(const AssembledScene& assembled, const AbsorbingLayers& absorbing, ElementModel& elements) {
  const Assembly& assembly = assembled.assembly;
  std::vector<ElementGroup>& groups = elements.elements;
  elements.in_single = assembled.scene.solver.elements_in_single();
  std::vector<BlockLists> lists;
  std::vector<std::vector<const scene::Material*>> materials;
  std::vector<std::vector<const scene::Part*>> parts;
  std::vector<GroupKind> kinds;
  std::size_t part = 0;
  std::map<std::array<int, 3>, std::array<int, 2>>
      rows_of;  // by level, part and damping: group, and row of constants in it
  const std::vector<int> blocks = blocks_by_level(elements.order);
  NodesOfBlocks nodes(assembly, elements.order, blocks, elements.in_single);
  for (const int p : blocks) {
    const int first = elements.order.first_element[p], end = elements.order.first_element[p + 1];
    part = 0;
    while (first >= assembly.parts[part].first_element + assembly.parts[part].element_count) ++part;
    const scene::Part& of_scene = assembled.scene.parts[part];
    const bool damped = of_scene.damped() || in_absorbing_layer(assembly, absorbing, first, end);
    const auto [found, is_new] = rows_of.try_emplace({elements.order.level[p], static_cast<int>(part), damped ? 1 : 0});
    int& group = found->second[0];
    if (is_new) {
      const scene::Material& material = assembled.scene.materials[assembly.parts[part].material];
      group = group_of(groups, kinds, of_scene, {material_number(material), damped}, elements.order.level[p]);
      lists.resize(groups.size());
      materials.resize(groups.size());
      parts.resize(groups.size());
      materials[group].push_back(&material);
      parts[group].push_back(&of_scene);
      groups[group].part_of_row.push_back(static_cast<int>(part));
      found->second[1] = static_cast<int>(materials[group].size()) - 1;
    }
    append_block(assembly, nodes.next(), lists[group]);
    lists[group].material.push_back(found->second[1]);
    groups[group].first_element.push_back(first);
    groups[group].element_count.push_back(end - first);
  }
  int rows = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    ElementGroup& built = groups[g];
    built.blocks = blocks_of(lists[g], built.element_count);
    built.material = material_arrays(kinds[g].material, materials[g]);
    built.first_partial = rows;
    if (kinds[g].damped) built.damping = damping_arrays(built, parts[g], materials[g]);
    rows = built.rows_end();
  }
}

void renew_frames(const NodeArrays& nodes, const ElementGroup& group, const ExecutionSpace& order) {
  if (group.blocks.frame.extent(0) == 0) return;
  Kokkos::parallel_for("renew_frames", Range(order, 0, group.blocks.count),
                       RenewFrames{group.blocks, nodes.position, nodes.reference});
}

}  // namespace railwave
