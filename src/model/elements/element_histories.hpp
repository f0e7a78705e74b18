#pragma once

#include <vector>

#include "kernels/nodes/nodes.hpp"
#include "model/elements/element_model.hpp"
#include "model/elements/history_sets.hpp"
#include "model/sample_sums.hpp"

namespace railwave {

/// Elements of one group whose histories are written. Blocks that hold some of them are evaluated, no others.
struct ListedElements {
  Array<int*> blocks;      ///< of the group, ascending
  Array<int* [3]> places;  ///< of each element: number in the list, slot among the listed blocks, slot in the group
  Array<double*> stress_double;  ///< Pa, tiled, of the listed blocks, where elements are in double precision
  Array<float*> stress_single;   ///< the same in single precision
  Array<double* [2]> energy;     ///< J, by listed block; nobody reads it
};

/// Sets of scene.output.history_sets whose stress or strain is written.
struct ElementHistories {
  std::vector<int> elements;           ///< the list: numbers of the assembly, ascending
  std::vector<int> first_of_set;       ///< in `item`, one more than sets
  Array<int*> item;                    ///< number in the list of elements, set after set
  Array<double*> weight;               ///< of each item
  std::vector<ListedElements> listed;  ///< by group of the model's elements
  Array<int* [8]> corner;              ///< model node numbers, by element of the list
  Array<double* [6]> stress;           ///< Pa, by element of the list, at the instant sampled last
  Array<double* [6]> strain;
  Array<double*> plastic_strain;
  PartedLists parts;  ///< of items: one list for each set
  bool wants_stress = false, wants_strain = false, wants_plastic_strain = false;
};

/// From now on this process evaluates the listed elements of its own blocks alone, see ElementGroup.
void keep_listed_elements(ElementModel& elements);

/// Evaluates the listed elements at the present instant, and sums the process's parts of each set.
/// @param order in which the launches come
void sum_element_parts(const ElementModel& elements, const NodeArrays& nodes, const ExecutionSpace& order);

/// Queues the means of each of these sets from the sums of their parts: one for each set that resolve_history_sets()
/// gives elements to. Quantities that no set asks for stay zero.
void queue_element_means(const ElementModel& elements, std::vector<ElementMeans>& means, SampleSums& sums);

}  // namespace railwave
