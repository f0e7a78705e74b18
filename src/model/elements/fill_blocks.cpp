#include <algorithm>
#include <unordered_map>

#include "kernels/support/set_zero.hpp"
#include "mesh/hexahedron.hpp"
#include "model/build_steps.hpp"
#include "model/elements/edge_groups.hpp"
#include "model/elements/hourglass_scale.hpp"
#include "model/elements/materials.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

using Places = std::vector<std::uint16_t>;

/// Where corner forces of a block meet, see CornerSums.
struct BlockPlaces {
  Places first, place;
};

/// For a device: in rounds of so many corners of a node. @param places by node, in order of how many rounds they take
BlockPlaces rounds_of(const std::vector<Places>& places) {
  BlockPlaces rounds;
  std::size_t first = 0;
  for (std::size_t begin = 0; first < places.size(); begin += corners_at_once) {
    if (begin > 0) rounds.first.push_back(static_cast<std::uint16_t>(first));
    for (std::size_t l = first; l < places.size(); ++l)
      for (std::size_t c = begin; c < begin + corners_at_once; ++c)
        rounds.place.push_back(c < places[l].size() ? places[l][c] : static_cast<std::uint16_t>(zero_place));
    while (first < places.size() && places[first].size() <= begin + corners_at_once) ++first;
  }
  return rounds;
}

/// For a host: a pack of nodes at a time.
BlockPlaces packs_of(const std::vector<Places>& places, int lanes) {
  BlockPlaces packs{{0}, {}};
  for (std::size_t begin = 0; begin < places.size(); begin += lanes) {
    const std::size_t end = std::min(places.size(), begin + lanes);
    std::size_t longest = 0;
    for (std::size_t l = begin; l < end; ++l) longest = std::max(longest, places[l].size());
    for (std::size_t c = 0; c < longest; ++c)
      for (std::size_t l = begin; l < begin + lanes; ++l)
        packs.place.push_back(l < end && c < places[l].size() ? places[l][c] : static_cast<std::uint16_t>(zero_place));
    packs.first.push_back(static_cast<std::uint16_t>(packs.place.size()));
  }
  return packs;
}

/// Rows of equal length, a multiple of `multiple`, filled up with `filling(p)`. Rows of blocks without places are left
/// as they are.
template <class Filling>
Array<std::uint16_t*> even_rows(const char* label, const std::vector<BlockPlaces>& blocks, Places BlockPlaces::*row,
                                int multiple, const Filling& filling, int& stride) {
  std::size_t longest = 0;
  for (const BlockPlaces& block : blocks) longest = std::max(longest, (block.*row).size());
  stride = static_cast<int>((longest + multiple - 1) / multiple * multiple);
  const auto rows = unset_array<std::uint16_t*>(label, blocks.size() * stride);
  const auto host = Kokkos::create_mirror_view(rows);
  for (std::size_t p = 0; p < blocks.size(); ++p) {
    const Places& values = blocks[p].*row;
    if (blocks[p].place.empty()) continue;
    for (int k = 0; k < stride; ++k)
      host(p * stride + k) = k < static_cast<int>(values.size()) ? values[k] : static_cast<std::uint16_t>(filling(p));
  }
  Kokkos::deep_copy(rows, host);
  return rows;
}

/// A group with the scene that it is of. Values of elements are by slot.
class BlockFiller {
 public:
  BlockFiller(const AssembledScene& assembled, const AbsorbingLayers& absorbing, bool single, int rank,
              ElementGroup& group)
      : assembled_(assembled),
        absorbing_(absorbing),
        in_rows_(wants_rows(single)),
        lanes_(single ? lane_count<float> : lane_count<double>),
        group_(group),
        node_(to_host(group.blocks.node)),
        node_count_(to_host(group.blocks.node_count)),
        row_(to_host(group.blocks.material)) {
    for (int p = 0; p < group.blocks.count; ++p)
      if (rank < 0 || group.owner.empty() || group.owner[p] == rank) wanted_.push_back(p);
  }

  void fill() {
    fill_corners();
    if (in_rows_) fill_edges();
    fill_scales();
    if (group_.material.flows()) fill_volumes();
    if (group_.damping.active()) fill_drag();
  }

 private:
  const CornerNodes& corners(int p, int slot) const {
    return assembled_.assembly.elements[group_.first_element[p] + std::min(slot, group_.element_count[p] - 1)];
  }
  HexahedronCorners places(int p, int slot) const { return corners_of(assembled_.assembly.nodes, corners(p, slot)); }
  const scene::Part& part(int p) const { return assembled_.scene.parts[group_.part_of_row[row_(p)]]; }
  const scene::Material& material(int p) const {
    return assembled_.scene.materials[assembled_.assembly.parts[group_.part_of_row[row_(p)]].material];
  }
  /// Of an element's corner in ElementBlocks::corner.
  std::size_t corner_place(int p, int slot, int N) const {
    const std::size_t batch = (static_cast<std::size_t>(p) * elements_of_block + slot) / lanes_;
    return (8 * batch + N) * lanes_ + slot % lanes_;
  }
  std::size_t slots() const { return static_cast<std::size_t>(group_.blocks.count) * elements_of_block; }

  /// On all threads: blocks have values of their own.
  template <class Act>
  void each_block(const Act& act) const {
    on_host_threads(static_cast<int>(wanted_.size()), [&](int k) { act(wanted_[k]); });
  }

  std::unordered_map<int, int> local_numbers(int p) const {
    std::unordered_map<int, int> local;
    for (int l = 0; l < node_count_(p); ++l)
      local[node_(static_cast<std::size_t>(p) * group_.blocks.node_stride + l) & ~advance_bit] = l;
    return local;
  }

  void fill_corners() {
    ElementBlocks& blocks = group_.blocks;
    blocks.corner = unset_array<std::uint8_t*>("block corners", 8 * slots());
    const auto corner = Kokkos::create_mirror_view(blocks.corner);
    std::vector<BlockPlaces> meetings(blocks.count);
    each_block([&](int p) {
      auto local = local_numbers(p);
      std::vector<Places> meeting(node_count_(p));
      for (int slot = 0; slot < elements_of_block; ++slot)
        for (int N = 0; N < 8; ++N) {
          const int l = local[corners(p, slot)[N]];
          corner(corner_place(p, slot, N)) = static_cast<std::uint8_t>(l);
          if (slot < group_.element_count[p])
            meeting[l].push_back(static_cast<std::uint16_t>(N * elements_of_block + slot));
        }
      meetings[p] = on_device ? rounds_of(meeting) : packs_of(meeting, lanes_);
    });
    Kokkos::deep_copy(blocks.corner, corner);
    // A round without nodes begins behind the last.
    blocks.first_place = even_rows(
        "first corner places", meetings, &BlockPlaces::first, on_device ? 1 : places_at_once,
        [&](std::size_t p) { return on_device ? node_count_(p) : 0; }, blocks.first_stride);
    blocks.place = even_rows(
        "corner places", meetings, &BlockPlaces::place, places_at_once, [](std::size_t /*p*/) { return zero_place; },
        blocks.place_stride);
  }

  void fill_edges() {
    ElementBlocks& blocks = group_.blocks;
    const auto corner = to_host(blocks.corner);
    std::vector<EdgeGroups> found(blocks.count);
    each_block([&](int p) {
      std::vector<CornerNodes> elements(group_.element_count[p]);
      for (int slot = 0; slot < group_.element_count[p]; ++slot)
        for (int N = 0; N < 8; ++N) elements[slot][N] = corner(corner_place(p, slot, N));
      found[p] = edge_groups(elements);
    });
    std::vector<int> count;
    blocks.edge_stride = 0;
    for (const EdgeGroups& groups : found) {
      count.push_back(static_cast<int>(groups.node.size()));
      blocks.edge_stride = std::max(blocks.edge_stride, count.back());
    }
    blocks.edge_count = to_device("block edge groups", count);
    constexpr std::size_t of_edge = 2 * elements_of_group, of_block = elements_of_block / elements_of_group * 4;
    const std::size_t of_edges = of_edge * blocks.edge_stride;
    blocks.edge = unset_array<std::uint8_t*>("edge groups", of_edges * blocks.count);
    blocks.edge_of_group = unset_array<std::uint8_t*>("edge groups of elements", of_block * blocks.count);
    const auto edge = Kokkos::create_mirror_view(blocks.edge),
               of_group = Kokkos::create_mirror_view(blocks.edge_of_group);
    each_block([&](int p) {
      const EdgeGroups& groups = found[p];
      for (std::size_t k = 0; k < groups.node.size(); ++k)
        for (std::size_t n = 0; n < of_edge; ++n) edge(of_edges * p + of_edge * k + n) = groups.node[k][n];
      for (std::size_t g = 0; g < groups.of_group.size(); ++g)
        for (std::size_t k = 0; k < 4; ++k) of_group(of_block * p + 4 * g + k) = groups.of_group[g][k];
    });
    Kokkos::deep_copy(blocks.edge, edge);
    Kokkos::deep_copy(blocks.edge_of_group, of_group);
  }

  void fill_scales() {
    ElementBlocks& blocks = group_.blocks;
    blocks.hourglass_scale = unset_array<float*>("hourglass scale", slots());
    blocks.settling_hourglass = unset_array<float*>("hourglass scale while settling", slots());
    const auto scale = Kokkos::create_mirror_view(blocks.hourglass_scale),
               settling = Kokkos::create_mirror_view(blocks.settling_hourglass);
    each_block([&](int p) {
      const scene::Part& of = part(p);
      const double while_settling = settling_hourglass_coefficient(of);
      for (int slot = 0; slot < elements_of_block; ++slot) {
        const std::size_t at = static_cast<std::size_t>(p) * elements_of_block + slot;
        // Slots that only fill up must not dissipate.
        scale(at) = settling(at) = 0;
        if (slot >= group_.element_count[p]) continue;
        double volume = 0;
        for (double part_of_it : hexahedron_shape_integrals(places(p, slot))) volume += part_of_it;
        scale(at) = static_cast<float>(hourglass_scale(of.hourglass, of.hourglass_coefficient, material(p), volume));
        settling(at) =
            static_cast<float>(hourglass_scale(scene::HourglassType::stiffness, while_settling, material(p), volume));
      }
    });
    Kokkos::deep_copy(blocks.hourglass_scale, scale);
    Kokkos::deep_copy(blocks.settling_hourglass, settling);
  }

  /// m3, of the elements in the reference; zero in slots that only fill up.
  void fill_volumes() {
    group_.material.volume = unset_array<double*>("reference volume", slots());
    const auto volume = Kokkos::create_mirror_view(group_.material.volume);
    each_block([&](int p) {
      for (int slot = 0; slot < elements_of_block; ++slot)
        volume(static_cast<std::size_t>(p) * elements_of_block + slot) =
            slot < group_.element_count[p] ? hexahedron_volume(places(p, slot)) : 0.0;
    });
    Kokkos::deep_copy(group_.material.volume, volume);
  }

  /// Mass damping and absorbing layers, times the mass that the block's elements give its nodes.
  void fill_drag() {
    const int stride = group_.blocks.node_stride;
    group_.damping.node_drag =
        unset_array<double*>("drag of blocks' nodes", static_cast<std::size_t>(group_.blocks.count) * stride);
    const auto drag = Kokkos::create_mirror_view(group_.damping.node_drag);
    const auto& layers = absorbing_.rate;
    each_block([&](int p) {
      auto local = local_numbers(p);
      std::vector<double> mass(stride, 0.0);
      for (int slot = 0; slot < group_.element_count[p]; ++slot) {
        const auto integrals = hexahedron_shape_integrals(places(p, slot));
        for (int N = 0; N < 8; ++N) mass[local[corners(p, slot)[N]]] += material(p).density * integrals[N];
      }
      for (int l = 0; l < stride; ++l) {
        const std::size_t at = static_cast<std::size_t>(p) * stride + l;
        const double layer = layers.empty() ? 0.0 : layers[node_(at) & ~advance_bit];
        drag(at) = l < node_count_(p) ? (part(p).mass_damping + layer) * mass[l] : 0.0;
      }
    });
    Kokkos::deep_copy(group_.damping.node_drag, drag);
  }

  const AssembledScene& assembled_;
  const AbsorbingLayers& absorbing_;
  const bool in_rows_;
  const int lanes_;
  ElementGroup& group_;
  const Array<int*>::HostMirror node_, node_count_, row_;
  std::vector<int> wanted_;
};

template <class T>
Array<T*> zero_array(const char* label, std::size_t count) {
  const auto array = unset_array<T*>(label, count);
  set_zero(array);
  return array;
}

}  // namespace

void fill_blocks(const AssembledScene& assembled, const AbsorbingLayers& absorbing, int rank, ElementModel& elements) {
  for (ElementGroup& group : elements.elements)
    BlockFiller(assembled, absorbing, elements.in_single, rank, group).fill();
}

void build_block_state(ElementModel& elements, PartialForces& partial) {
  int rows = 0;
  for (ElementGroup& built : elements.elements) {
    const int count = built.blocks.count;
    built.block_energy = unset_array<double* [2]>("block energy", count);
    built.block_sums = unset_array<double* [energies_of_block]>("energies of blocks", count);
    built.block_sums_fetched = PinnedArray<double* [energies_of_block]>("energies of blocks, fetched", count);
    if (elements.in_single) built.blocks.frame = Array<double * [BlockFrame::values]>("block frames", count);
    built.blocks.hourglass_energy =
        zero_array<double>("hourglass energy", static_cast<std::size_t>(count) * power_sums);
    if (built.material.flows()) {
      built.material.history = zero_array<double>(
          "material history", static_cast<std::size_t>(count) * elements_of_block * built.material.history_values);
      built.slot_sums = unset_array<double*>("work of flow", static_cast<std::size_t>(count) * flow_threads);
    }
    rows = built.rows_end();
  }
  partial.single_precision = elements.in_single;
  if (elements.in_single)
    partial.in_single = zero_array<PartialForce<float>>("partial forces", rows);
  else
    partial.in_double = zero_array<PartialForce<double>>("partial forces", rows);
}

}  // namespace railwave
