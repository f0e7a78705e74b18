#include "model/elements/element_histories.hpp"

#include <algorithm>

#include "kernels/elements/logarithmic_strain.hpp"
#include "model/build_steps.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/history_sets.hpp"
#include "model/elements/materials.hpp"
#include "model/host_copy.hpp"
#include "model/sample_sums.hpp"

namespace railwave {
namespace {

/// Takes a group's listed stresses from their tiles.
template <class S>
struct TakeStress {
  Array<const int* [3]> places;
  Array<const S*> tiles;
  Array<double* [6]> stress;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    for (int c = 0; c < 6; ++c) stress(places(i, 0), c) = tiles(tiled_slot<S>(places(i, 1), 6, c));
  }
};

template <class S>
struct TakePlasticStrain {
  Array<const int* [3]> places;
  Array<const double*> history;
  int values, value;  ///< of an element's history, and which of them it is
  Array<double*> plastic_strain;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    plastic_strain(places(i, 0)) = history(tiled_slot<S>(places(i, 2), values, value));
  }
};

/// Weighted stress, strain and plastic strain of a set's elements.
struct ElementMeanSum {
  static constexpr int values = values_of_element_parts;
  Array<const int*> item;
  Array<const double*> weight;
  Array<const double*[6]> stress, strain;
  Array<const double*> plastic_strain;
  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const int e = item(k);
    const double w = weight(k);
    for (int c = 0; c < 6; ++c) {
      sum[c] += w * stress(e, c);
      sum[6 + c] += w * strain(e, c);
    }
    sum[12] += w * plastic_strain(e);
  }
};

template <class S>
auto& stress_tiles(const ListedElements& listed) {
  if constexpr (sizeof(S) == sizeof(double))
    return listed.stress_double;
  else
    return listed.stress_single;
}

template <class S>
void evaluate(const ElementModel& elements, const NodeArrays& nodes, const ExecutionSpace& order) {
  const ElementHistories& histories = *elements.element_histories;
  for (std::size_t g = 0; g < elements.elements.size(); ++g) {
    const ElementGroup& group = elements.elements[g];
    const ListedElements& listed = histories.listed[g];
    const int blocks = static_cast<int>(listed.blocks.extent(0)), count = static_cast<int>(listed.places.extent(0));
    if (count == 0) continue;
    if (histories.wants_stress) {
      with_material(group, [&](const auto& material) {
        using State = ElementState<S, std::decay_t<decltype(material)>, ViscousHourglass>;
        launch_teams(blocks, State::scratch_size(group.blocks),
                     State{material, group.blocks, group.blocks.hourglass_scale, nodes, stress_tiles<S>(listed),
                           listed.energy, listed.blocks},
                     order);
      });
      Kokkos::parallel_for("take_stress", Range(order, 0, count),
                           TakeStress<S>{listed.places, stress_tiles<S>(listed), histories.stress});
    }
    if (!histories.wants_plastic_strain) continue;
    with_material_type(group.material, [&](auto type) {
      using Material = typename decltype(type)::type;
      if constexpr (Material::history_values > 0)
        Kokkos::parallel_for("take_plastic_strain", Range(order, 0, count),
                             TakePlasticStrain<S>{listed.places, group.material.history, Material::history_values,
                                                  Material::plastic_strain, histories.plastic_strain});
    });
  }
  if (histories.wants_strain)
    Kokkos::parallel_for("listed_strain", Range(order, 0, static_cast<int>(histories.corner.extent(0))),
                         ListedStrain{nodes, histories.corner, histories.strain});
}

/// The listed elements of one group's blocks.
ListedElements list_of(bool in_single, const ElementGroup& group, const std::vector<int>& elements) {
  std::vector<char> has(group.blocks.count, group.whole ? 1 : 0);
  if (!group.whole)
    for (int p : to_vector(group.own_blocks)) has[p] = 1;
  std::vector<int> blocks;
  std::vector<std::array<int, 3>> places;
  for (int p = 0; p < group.blocks.count; ++p) {
    const int first = group.first_element[p], end = first + group.element_count[p];
    const auto from = std::lower_bound(elements.begin(), elements.end(), first),
               to = std::lower_bound(from, elements.end(), end);
    if (from == to || has[p] == 0) continue;
    for (auto e = from; e != to; ++e)
      places.push_back({static_cast<int>(e - elements.begin()),
                        static_cast<int>(blocks.size()) * elements_of_block + *e - first,
                        p * elements_of_block + *e - first});
    blocks.push_back(p);
  }
  ListedElements listed;
  if (blocks.empty()) return listed;
  listed.blocks = to_device("listed blocks", blocks);
  listed.places = to_device("places of listed elements", places);
  const std::size_t slots = 6 * blocks.size() * elements_of_block;
  if (in_single)
    listed.stress_single = unset_array<float*>("listed stress", slots);
  else
    listed.stress_double = unset_array<double*>("listed stress", slots);
  listed.energy = unset_array<double* [2]>("energy of listed blocks", blocks.size());
  return listed;
}

}  // namespace

void build_element_histories(const AssembledScene& assembled, ElementModel& elements) {
  std::vector<int> listed, item, first{0};
  std::vector<double> weight;
  ElementHistories histories;
  const auto sets = resolve_history_sets(assembled.scene, assembled.assembly);
  for (const HistorySet& set : sets) {
    if (!set.inside()) continue;
    listed.insert(listed.end(), set.elements.begin(), set.elements.end());
    histories.wants_stress |= set.has("stress");
    histories.wants_strain |= set.has("strain");
    histories.wants_plastic_strain |= set.has("plastic_strain");
  }
  if (listed.empty()) return;
  std::sort(listed.begin(), listed.end());
  listed.erase(std::unique(listed.begin(), listed.end()), listed.end());
  for (const HistorySet& set : sets) {
    if (!set.inside()) continue;
    for (int e : set.elements)
      item.push_back(static_cast<int>(std::lower_bound(listed.begin(), listed.end(), e) - listed.begin()));
    for (double share : volume_shares(assembled.assembly, set.elements)) weight.push_back(share);
    first.push_back(static_cast<int>(item.size()));
  }
  std::vector<CornerNodes> corner;
  for (int e : listed) corner.push_back(assembled.assembly.elements[e]);
  histories.elements = listed;
  histories.first_of_set = first;
  histories.item = to_device("items of element histories", item);
  histories.weight = to_device("weights of element histories", weight);
  histories.corner = to_device("corners of listed elements", corner);
  for (const ElementGroup& group : elements.elements)
    histories.listed.push_back(list_of(elements.in_single, group, listed));
  histories.stress = Array<double* [6]>("stress of listed elements", listed.size());
  histories.strain = Array<double* [6]>("strain of listed elements", listed.size());
  histories.plastic_strain = Array<double*>("plastic strain of listed elements", listed.size());
  elements.element_histories = std::make_shared<ElementHistories>(std::move(histories));
}

void keep_listed_elements(ElementModel& elements) {
  if (!elements.element_histories) return;
  ElementHistories& histories = *elements.element_histories;
  histories.listed.clear();
  for (const ElementGroup& group : elements.elements)
    histories.listed.push_back(list_of(elements.in_single, group, histories.elements));
}

void sum_element_parts(const ElementModel& elements, const NodeArrays& nodes, const ExecutionSpace& order) {
  if (!elements.element_histories) return;
  const ElementHistories& histories = *elements.element_histories;
  with_element_precision(elements, [&](auto number) { evaluate<decltype(number)>(elements, nodes, order); });
  sum_parts(
      histories.parts,
      ElementMeanSum{histories.item, histories.weight, histories.stress, histories.strain, histories.plastic_strain},
      order);
}

void queue_element_means(const ElementModel& elements, std::vector<ElementMeans>& means, SampleSums& sums) {
  if (!elements.element_histories) return;
  const PartedLists& parts = elements.element_histories->parts;
  means.resize(parts.list_count());
  queue_lists<ElementMeanSum::values>(parts, sums, [&means](int set, const double* sum) {
    ElementMeans& mean = means[set];
    for (int c = 0; c < 6; ++c) {
      mean.stress[c] = sum[c];
      mean.strain[c] = sum[6 + c];
    }
    mean.plastic_strain = sum[12];
  });
}

}  // namespace railwave
