#include <algorithm>

#include "model/ranks/block_partition.hpp"
#include "model/time_step/deformed_elements.hpp"
#include "model/time_step/estimate_share.hpp"
#include "model/visit_arrays.hpp"

namespace railwave {
namespace {

/// Measured: the program with its libraries, without and with MPI.
constexpr double of_process = 25e6, of_process_with_mpi = 40e6;
/// Of a search of the highest frequency, see GlobalEstimate: forces and numbers of corners; vectors, masses, numbers.
constexpr double search_of_element = 24 * sizeof(double) + 16 * sizeof(int),
                 search_of_node = 4 * 3 * sizeof(double) + sizeof(int),
                 shared_search_of_node = search_of_node + 4 * sizeof(double) + sizeof(int);
/// Measured: of putting elements in blocks, for a moment.
constexpr double ordering_of_element = 55;
/// What the monitor keeps of an element.
constexpr double monitored_element = 8 * sizeof(int) + 7 * sizeof(float);
/// What the step keeps of an element to follow its deformation.
constexpr double followed_element = 8 * sizeof(int) + DeformedElements::values * sizeof(float);

template <class T>
double bytes_of(const std::vector<T>& values) {
  return static_cast<double>(sizeof(T)) * static_cast<double>(values.size());
}

template <class T>
double bytes_of(const std::map<std::string, std::vector<T>>& sets) {
  double bytes = 0;
  for (const auto& [name, values] : sets) bytes += bytes_of(values);
  return bytes;
}

double set_bytes(const Assembly& assembly) {
  return bytes_of(assembly.node_sets) + bytes_of(assembly.element_sets) + bytes_of(assembly.surfaces);
}

/// Nodes of blocks, in rows.
double block_node_bytes(const Model& model) {
  double bytes = 0;
  for (const ElementGroup& group : model.elements) bytes += sizeof(int) * static_cast<double>(group.blocks.node.span());
  return bytes;
}

/// Bytes of arrays of which a rank touches what its blocks need, and of all others.
struct ArrayBytes {
  double shared = 0, whole = 0;
  template <class View>
  void operator()(ArrayUse /*use*/, const std::string& name, View& view, ArrayShape /*shape*/) {
    const auto starts = [&](const char* word) { return name.rfind(word, 0) == 0; };
    const bool of_nodes =
        name == "nodes_reference" || name == "nodes_position" || name == "nodes_velocity" || name == "carried_node";
    const bool of_blocks = starts("elements_") && name.find("_node") == std::string::npos;
    const double bytes = static_cast<double>(view.span() * sizeof(typename View::value_type));
    if (starts("global_estimate_")) return;  // is rank 0's own, see of_search()
    (of_nodes || of_blocks || starts("model_partial") || starts("model_shared") ? shared : whole) += bytes;
  }
};

/// Bytes of the step's search, whole.
double of_search(const Model& model) {
  return search_of_element * static_cast<double>(model.element_count()) + search_of_node * model.nodes.count;
}

}  // namespace

bool rank_0_needs_all(const scene::Scene& scene) {
  const bool searches = scene.solver.step_estimate == scene::StepEstimate::global ||
                        scene.solver.step_estimate == scene::StepEstimate::automatic;
  const bool has_frames = scene.solver.precision == scene::Precision::single_precision;
  return on_device || scene.settle.active || searches || has_frames || !scene.initial_motions.empty() ||
         !scene.contacts.empty() || !EstimateShare::possible(scene);
}

std::vector<RankMemory> forecast_memory(const Model& model, const BlockPartition& partition) {
  ArrayBytes arrays;
  // A visit hands out references; this one changes nothing.
  visit_model_arrays(arrays, const_cast<Model&>(model));
  const double nodes = model.nodes.count, elements = static_cast<double>(model.element_count());
  const double sets = set_bytes(model.assembly),
               places_and_corners = bytes_of(model.assembly.nodes) + bytes_of(model.assembly.elements);
  const double values = bytes_of(model.mass) + bytes_of(model.element_length), own_steps = bytes_of(model.own_steps);
  const double numbers = nodes * (sizeof(double) + 2 * sizeof(int));  // masses, rows of constraints and of loads
  const double places = 6 * sizeof(double) * nodes, monitored = model.scene.monitor.active ? monitored_element : 0;
  const bool several = partition.ranks > 1, shared = several && EstimateShare::possible(model.scene);
  const double kept_search = model.global_estimate ? of_search(model) : 0;
  // One process has its blocks after the search, and numbers in the mesh until then.
  const double lists = several ? block_node_bytes(model) : nodes * sizeof(int);
  std::vector<RankMemory> all;
  for (int r = 0; r < partition.ranks; ++r) {
    const bool whole = !several || (r == 0 && rank_0_needs_all(model.scene));
    const double own = elements > 0 ? static_cast<double>(partition.elements[r]) / elements : 0;
    const double base = several ? of_process_with_mpi : of_process;
    const double search = shared ? (search_of_element * elements + shared_search_of_node * nodes) *
                                       EstimateShare::part_of(r, partition.ranks)
                                 : (r == 0 ? of_search(model) : 0);
    // Of the mesh, while the model is made and in steps; beside it what else is known of elements.
    const double mesh_made = sets + (r == 0 ? 1 : own) * places_and_corners,
                 mesh_in_steps = whole ? sets + places_and_corners : (r == 0 ? sets : 0);
    const double beside = r == 0 ? values + own_steps : own * own_steps, beside_in_steps = r == 0 ? beside : 0;
    const double of_arrays = arrays.whole + (whole ? 1 : own) * arrays.shared;
    RankMemory memory;
    memory.making = base + std::max({sets + places_and_corners + ordering_of_element * elements,
                                     mesh_made + beside + numbers + lists + (whole ? places : 0) + search,
                                     mesh_made + beside + of_arrays});
    memory.steps = base + mesh_in_steps + beside_in_steps + of_arrays +
                   own * elements * (monitored + followed_element) + (r == 0 ? kept_search : 0);
    all.push_back(memory);
  }
  return all;
}

}  // namespace railwave
