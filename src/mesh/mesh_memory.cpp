#include "mesh/mesh_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "mesh/build_mesh.hpp"

namespace railwave {

void expect_mesh_memory(double elements, double nodes) {
  if (nodes > std::numeric_limits<int>::max())
    throw MeshTooLarge(fmt::format("makes {:.3g} nodes, more than {} can be numbered; {}", nodes,
                                   std::numeric_limits<int>::max(), smaller_mesh));
  try {
    expect_memory(bytes_of_mesh_element * elements, fmt::format("makes {:.3g} elements, which need", elements),
                  smaller_mesh);
  } catch (const MemoryShortage& problem) {
    throw MeshTooLarge(problem.what(), true);
  }
}

int cell_count(double cells) {
  constexpr double most = 1e6;
  if (!(cells <= most))
    throw MeshTooLarge(fmt::format("makes more than {:.0f} elements along one line; {}", most, smaller_mesh));
  return static_cast<int>(cells);
}

namespace {

/// By the scene's parts.
std::vector<double> elements_of_parts(const scene::Scene& scene) {
  std::map<std::string, double> of_mesh;
  for (const scene::MeshSource& mesh : scene.meshes)
    if (std::any_of(scene.parts.begin(), scene.parts.end(),
                    [&](const scene::Part& part) { return part.mesh == mesh.name; }))
      of_mesh[mesh.name] = expected_elements(mesh);
  std::vector<double> elements;
  for (const scene::Part& part : scene.parts) {
    const auto found = of_mesh.find(part.mesh);
    elements.push_back(found == of_mesh.end() || !part.element_set.empty() ? 0 : found->second);
  }
  return elements;
}

}  // namespace

double expected_elements(const scene::Scene& scene) {
  const std::vector<double> elements = elements_of_parts(scene);
  return std::accumulate(elements.begin(), elements.end(), 0.0);
}

void expect_memory_for_parts(const scene::Scene& scene, double available) {
  const std::vector<double> elements = elements_of_parts(scene);
  double total = 0, most = 0;
  const scene::Part* largest = nullptr;
  for (std::size_t p = 0; p < elements.size(); ++p) {
    total += elements[p];
    if (elements[p] > most) most = elements[p], largest = &scene.parts[p];
  }
  // The estimate may be too high, so a scene is refused only if this share of it does not fit.
  constexpr double certain = 0.7;
  const double bytes = (bytes_of_mesh_element + bytes_of_model_element) * total;
  if (!largest || certain * bytes <= available) return;
  throw MemoryShortage(
      fmt::format("{}: the meshes of all parts have about {:.2g} elements, which need about {} of memory, but this "
                  "machine has {} left; most of them "
                  "has [parts.{}] (line {}) by mesh '{}', about {:.2g}: {}, and see whether its lengths are in m",
                  scene.path, total, bytes_text(bytes), bytes_text(available), largest->name, largest->line,
                  largest->mesh, most, smaller_mesh));
}

void expect_memory_for_parts(const scene::Scene& scene) { expect_memory_for_parts(scene, available_memory()); }

}  // namespace railwave
