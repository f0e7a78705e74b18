#include "model/elements/element_histories.hpp"

#include <algorithm>

#include "kernels/elements/logarithmic_strain.hpp"
#include "model/build_steps.hpp"
#include "model/element_precision.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/history_sets.hpp"
#include "model/elements/materials.hpp"
#include "model/host_copy.hpp"

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
  static constexpr int values = 13;
  Array<const int*> item;
  Array<const double*> weight;
  Array<const double*[6]> stress, strain;
  Array<const double*> plastic_strain;
  int begin;
  KOKKOS_INLINE_FUNCTION void operator()(int k, double* sum) const {
    const int e = item(begin + k);
    const double w = weight(begin + k);
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
void evaluate(const Model& model, const ElementHistories& histories) {
  for (std::size_t g = 0; g < model.elements.size(); ++g) {
    const ElementGroup& group = model.elements[g];
    const ListedElements& listed = histories.listed[g];
    const int blocks = static_cast<int>(listed.blocks.extent(0)), count = static_cast<int>(listed.places.extent(0));
    if (count == 0) continue;
    if (histories.wants_stress) {
      with_material(group, [&](const auto& material) {
        using State = ElementState<S, std::decay_t<decltype(material)>, ViscousHourglass>;
        launch_teams(blocks, State::scratch_size(group.blocks),
                     State{material, group.blocks, group.blocks.hourglass_scale, model.nodes, stress_tiles<S>(listed),
                           listed.energy, listed.blocks});
      });
      Kokkos::parallel_for("take_stress", Range(0, count),
                           TakeStress<S>{listed.places, stress_tiles<S>(listed), histories.stress});
    }
    if (!histories.wants_plastic_strain) continue;
    with_material_type(group.material, [&](auto type) {
      using Material = typename decltype(type)::type;
      if constexpr (Material::history_values > 0)
        Kokkos::parallel_for("take_plastic_strain", Range(0, count),
                             TakePlasticStrain<S>{listed.places, group.material.history, Material::history_values,
                                                  Material::plastic_strain, histories.plastic_strain});
    });
  }
  if (histories.wants_strain)
    Kokkos::parallel_for("listed_strain", Range(0, static_cast<int>(histories.corner.extent(0))),
                         ListedStrain{model.nodes, histories.corner, histories.strain});
}

/// The listed elements of one group.
ListedElements list_of(const Model& model, const ElementGroup& group, const std::vector<int>& elements) {
  std::vector<int> blocks;
  std::vector<std::array<int, 3>> places;
  for (int p = 0; p < group.blocks.count; ++p) {
    const int first = group.first_element[p], end = first + group.element_count[p];
    const auto from = std::lower_bound(elements.begin(), elements.end(), first),
               to = std::lower_bound(from, elements.end(), end);
    if (from == to) continue;
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
  if (model.scene.solver.elements_in_single())
    listed.stress_single = unset_array<float*>("listed stress", slots);
  else
    listed.stress_double = unset_array<double*>("listed stress", slots);
  listed.energy = unset_array<double* [2]>("energy of listed blocks", blocks.size());
  return listed;
}

}  // namespace

void build_element_histories(Model& model) {
  std::vector<int> elements, item, first{0};
  std::vector<double> weight;
  ElementHistories histories;
  const auto sets = resolve_history_sets(model.scene, model.assembly);
  for (const HistorySet& set : sets) {
    if (!set.inside()) continue;
    elements.insert(elements.end(), set.elements.begin(), set.elements.end());
    histories.wants_stress |= set.has("stress");
    histories.wants_strain |= set.has("strain");
    histories.wants_plastic_strain |= set.has("plastic_strain");
  }
  if (elements.empty()) return;
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  for (const HistorySet& set : sets) {
    if (!set.inside()) continue;
    for (int e : set.elements)
      item.push_back(static_cast<int>(std::lower_bound(elements.begin(), elements.end(), e) - elements.begin()));
    for (double share : volume_shares(model.assembly, set.elements)) weight.push_back(share);
    first.push_back(static_cast<int>(item.size()));
  }
  std::vector<std::array<int, 8>> corner;
  for (int e : elements) corner.push_back(model.assembly.elements[e]);
  histories.first_of_set = first;
  histories.item = to_device("items of element histories", item);
  histories.weight = to_device("weights of element histories", weight);
  histories.corner = to_device("corners of listed elements", corner);
  for (const ElementGroup& group : model.elements) histories.listed.push_back(list_of(model, group, elements));
  histories.stress = Array<double* [6]>("stress of listed elements", elements.size());
  histories.strain = Array<double* [6]>("strain of listed elements", elements.size());
  histories.plastic_strain = Array<double*>("plastic strain of listed elements", elements.size());
  model.element_histories = std::make_shared<ElementHistories>(std::move(histories));
}

void queue_element_means(const Model& model, std::vector<ElementMeans>& means, Reductions& sums) {
  if (!model.element_histories) return;
  const ElementHistories& histories = *model.element_histories;
  with_element_precision(model.scene, [&](auto number) { evaluate<decltype(number)>(model, histories); });
  means.resize(histories.first_of_set.size() - 1);
  for (std::size_t s = 0; s < means.size(); ++s) {
    ElementMeans& mean = means[s];
    const int begin = histories.first_of_set[s], end = histories.first_of_set[s + 1];
    sums.sum(ElementMeanSum{histories.item, histories.weight, histories.stress, histories.strain,
                            histories.plastic_strain, begin},
             end - begin, [&mean](const double* sum) {
               for (int c = 0; c < 6; ++c) {
                 mean.stress[c] = sum[c];
                 mean.strain[c] = sum[6 + c];
               }
               mean.plastic_strain = sum[12];
             });
  }
}

}  // namespace railwave
