#include "kernels/monitor/monitor_terms.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/materials.hpp"
#include "solve/monitor/energies.hpp"

namespace railwave {
namespace {

/// Elastic energy of the blocks, and what their hourglass control has stored or dissipated.
struct BlockEnergy {
  static constexpr int values = 2;
  Array<const double* [2]> energy;
  Array<const double*> dissipated;
  KOKKOS_INLINE_FUNCTION void operator()(int p, double* sum) const {
    sum[0] += energy(p, 0);
    sum[1] += energy(p, 1);
    for (int k = 0; k < power_sums; ++k) sum[1] += dissipated(p * power_sums + k);
  }
};

/// Work of plastic flow: a function of each element's history.
template <class S, class Material>
struct FlowWork {
  static constexpr int values = 1;
  Material material;
  Array<const int*> row;  ///< of the blocks' materials
  Array<const double*> volume;
  KOKKOS_INLINE_FUNCTION void operator()(int slot, double* sum) const {
    constexpr int kept = Material::history_values;
    double history[kept];
    for (int c = 0; c < kept; ++c) history[c] = material.history[tiled_slot<S>(slot, kept, c)];
    sum[0] += volume(slot) * Material::work(material.constants[row(slot / elements_of_block)], history);
  }
};

/// Adds the work of plastic flow of a block's slots to what the block has stored.
template <class OfSlot>
struct AddFlowWork {
  OfSlot of_slot;
  Array<double* [2]> energy;
  KOKKOS_INLINE_FUNCTION void operator()(const int p) const {
    double sum = 0;
    for (int slot = p * elements_of_block; slot < (p + 1) * elements_of_block; ++slot) of_slot(slot, &sum);
    energy(p, 0) += sum;
  }
};

/// Shares a group's energies, fetched, out among its parts: a block lies in one.
void share_out(const std::vector<Assembly::PartRange>& parts, const ElementGroup& group,
               std::vector<PartEnergy>& by_part) {
  const auto& energy = group.block_energy_fetched;
  std::size_t p = 0;
  for (int block = 0; block < group.blocks.count; ++block) {
    const auto holds = [&](std::size_t part) {
      const int within = group.first_element[block] - parts[part].first_element;
      return within >= 0 && within < parts[part].element_count;
    };
    if (!holds(p))
      for (p = 0; p + 1 < parts.size() && !holds(p);) ++p;
    by_part[p].internal += energy(block, 0);
    by_part[p].hourglass += energy(block, 1);
  }
}

/// Calls `work` with the work of flow of a group's elements, where they flow.
template <class S, class Work>
void with_flow_work(const ElementGroup& group, const Work& work) {
  with_material(group, [&](const auto& material) {
    using Material = std::decay_t<decltype(material)>;
    if constexpr (Material::history_values > 0)
      work(FlowWork<S, Material>{material, group.blocks.material, group.material.volume});
  });
}

template <class S, class Hourglass>
void queue_element_energy(const NodeArrays& nodes, const ElementGroup& group, EnergyAccount& energy, bool by_part,
                          Reductions& sums) {
  const int count = group.blocks.count;
  with_material(group, [&](const auto& material) {
    using State = ElementState<S, std::decay_t<decltype(material)>, Hourglass>;
    launch_blocks(group.blocks,
                  State{material, group.blocks, group.blocks.hourglass_scale, nodes, {}, group.block_energy});
  });
  sums.sum(BlockEnergy{group.block_energy, group.blocks.hourglass_energy}, count, [&energy](const double* sum) {
    energy.internal += sum[0];
    energy.hourglass += sum[1];
  });
  if (by_part) {
    Kokkos::parallel_for("add_dissipated", Range(0, count),
                         AddDissipated{group.block_energy, group.blocks.hourglass_energy, power_sums});
    with_flow_work<S>(group, [&](const auto& flow_work) {
      Kokkos::parallel_for("add_flow_work", Range(0, count),
                           AddFlowWork<std::decay_t<decltype(flow_work)>>{flow_work, group.block_energy});
    });
    Kokkos::deep_copy(ExecutionSpace(), group.block_energy_fetched, group.block_energy);
  }
  if (group.damping.active())
    sums.sum(ArraySum{group.damping.energy}, count, [&energy](const double* sum) { energy.damping += *sum; });
  with_flow_work<S>(group, [&](const auto& flow_work) {
    sums.sum(flow_work, count * elements_of_block, [&energy](const double* sum) { energy.plastic += *sum; });
  });
}

template <class S>
void queue_group_energies(const std::vector<ElementGroup>& groups, const NodeArrays& nodes, EnergyAccount& energy,
                          bool by_part, Reductions& sums) {
  for (const ElementGroup& group : groups) {
    if (group.hourglass == scene::HourglassType::viscous)
      queue_element_energy<S, ViscousHourglass>(nodes, group, energy, by_part, sums);
    else
      queue_element_energy<S, StiffnessHourglass>(nodes, group, energy, by_part, sums);
  }
}

}  // namespace

void queue_element_energies(const ElementModel& model, const NodeArrays& nodes, EnergyAccount& energy, bool by_part,
                            Reductions& sums) {
  with_element_precision(model, [&](auto number) {
    queue_group_energies<decltype(number)>(model.elements, nodes, energy, by_part, sums);
  });
}

void share_out_energies(const Assembly& assembly, const std::vector<ElementGroup>& groups,
                        std::vector<PartEnergy>& by_part) {
  by_part.assign(assembly.parts.size(), {});
  for (const ElementGroup& group : groups) share_out(assembly.parts, group, by_part);
}

}  // namespace railwave
