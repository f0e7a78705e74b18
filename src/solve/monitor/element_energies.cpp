#include "kernels/monitor/monitor_terms.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/materials.hpp"
#include "solve/monitor/energies.hpp"

namespace railwave {
namespace {

/// What the account adds of a block, without work of flow.
struct BlockEnergies {
  Array<const int*> listed;         ///< blocks; empty: all
  Array<const double* [2]> energy;  ///< in the order of the list
  Array<const double*> dissipated, damping;
  Array<double* [energies_of_block]> sums;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int p = listed.extent(0) == 0 ? i : listed(i);
    double hourglass = energy(i, 1);
    for (int k = 0; k < power_sums; ++k) hourglass += dissipated(p * power_sums + k);
    sums(p, 0) = energy(i, 0);
    sums(p, 1) = hourglass;
    sums(p, 2) = damping.extent(0) == 0 ? 0 : damping(p);
    sums(p, 3) = 0;
  }
};

/// Work of plastic flow, a function of each element's history: of every so many slots of a block.
template <class S, class Material>
struct FlowWork {
  Array<const int*> listed;  ///< blocks; empty: all
  Material material;
  Array<const int*> row;  ///< of the blocks' materials
  Array<const double*> volume;
  Array<double*> slot_sums;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    constexpr int kept = Material::history_values;
    const int p = listed.extent(0) == 0 ? i / flow_threads : listed(i / flow_threads), thread = i % flow_threads;
    double sum = 0;
    for (int slot = p * elements_of_block + thread; slot < (p + 1) * elements_of_block; slot += flow_threads) {
      double history[kept];
      for (int c = 0; c < kept; ++c) history[c] = material.history[tiled_slot<S>(slot, kept, c)];
      sum += volume(slot) * Material::work(material.constants[row(p)], history);
    }
    slot_sums(p * flow_threads + thread) = sum;
  }
};

/// Work of flow of a block.
struct AddFlowWork {
  Array<const int*> listed;  ///< blocks; empty: all
  Array<const double*> slot_sums;
  Array<double* [energies_of_block]> sums;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int p = listed.extent(0) == 0 ? i : listed(i);
    for (int k = 0; k < flow_threads; ++k) sums(p, 3) += slot_sums(p * flow_threads + k);
  }
};

/// Shares a group's energies, fetched, out among its parts: a block lies in one.
void share_out(const std::vector<Assembly::PartRange>& parts, const ElementGroup& group,
               std::vector<PartEnergy>& by_part) {
  const auto& energy = group.block_sums_fetched;
  std::size_t p = 0;
  for (int block = 0; block < group.blocks.count; ++block) {
    const auto holds = [&](std::size_t part) {
      const int within = group.first_element[block] - parts[part].first_element;
      return within >= 0 && within < parts[part].element_count;
    };
    if (!holds(p))
      for (p = 0; p + 1 < parts.size() && !holds(p);) ++p;
    by_part[p].internal += energy(block, 0) + energy(block, 3);
    by_part[p].hourglass += energy(block, 1);
  }
}

template <class S, class Hourglass>
void sum_group(const NodeArrays& nodes, const ElementGroup& group, const ExecutionSpace& order) {
  const int count = group.whole ? group.blocks.count : static_cast<int>(group.own_blocks.extent(0));
  if (count == 0) return;
  const Array<int*>& listed = group.own_blocks;
  with_material(group, [&](const auto& material) {
    using Material = std::decay_t<decltype(material)>;
    launch_blocks(group.blocks, group.whole ? nullptr : &listed,
                  ElementState<S, Material, Hourglass>{
                      material, group.blocks, group.blocks.hourglass_scale, nodes, {}, group.block_energy},
                  order);
    Kokkos::parallel_for("block_energies", Range(order, 0, count),
                         BlockEnergies{listed, group.block_energy, group.blocks.hourglass_energy, group.damping.energy,
                                       group.block_sums});
    if constexpr (Material::history_values > 0) {
      Kokkos::parallel_for(
          "flow_work", Range(order, 0, count * flow_threads),
          FlowWork<S, Material>{listed, material, group.blocks.material, group.material.volume, group.slot_sums});
      Kokkos::parallel_for("add_flow_work", Range(order, 0, count),
                           AddFlowWork{listed, group.slot_sums, group.block_sums});
    }
  });
}

template <class S>
void sum_groups(const std::vector<ElementGroup>& groups, const NodeArrays& nodes, const ExecutionSpace& order) {
  for (const ElementGroup& group : groups)
    if (group.hourglass == scene::HourglassType::viscous)
      sum_group<S, ViscousHourglass>(nodes, group, order);
    else
      sum_group<S, StiffnessHourglass>(nodes, group, order);
}

}  // namespace

void sum_block_energies(const ElementModel& model, const NodeArrays& nodes, const ExecutionSpace& order) {
  with_element_precision(model, [&](auto number) { sum_groups<decltype(number)>(model.elements, nodes, order); });
}

void queue_element_energies(const ElementModel& model, EnergyAccount& energy, bool by_part, SampleSums& sums) {
  for (const ElementGroup& group : model.elements) {
    static_assert(BlockTotals::values == energies_of_block);
    sums.sum(BlockTotals{group.block_sums}, group.blocks.count, [&energy](const double* sum) {
      energy.internal += sum[0];
      energy.hourglass += sum[1];
      energy.damping += sum[2];
      energy.plastic += sum[3];
    });
    if (by_part) Kokkos::deep_copy(sums.order(), group.block_sums_fetched, group.block_sums);
  }
}

void share_out_energies(const Assembly& assembly, const std::vector<ElementGroup>& groups,
                        std::vector<PartEnergy>& by_part) {
  by_part.assign(assembly.parts.size(), {});
  for (const ElementGroup& group : groups) share_out(assembly.parts, group, by_part);
}

}  // namespace railwave
