#include "mesh/mesh_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

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
  } catch (const InputError& problem) {
    throw MeshTooLarge(problem.what());
  }
}

int cell_count(double cells) {
  constexpr double most = 1e6;
  if (!(cells <= most))
    throw MeshTooLarge(fmt::format("makes more than {:.0f} elements along one line; {}", most, smaller_mesh));
  return static_cast<int>(cells);
}

void expect_memory_for_parts(const scene::Scene& scene, double available) {
  std::map<std::string, double> of_mesh;
  for (const scene::MeshSource& mesh : scene.meshes)
    if (std::any_of(scene.parts.begin(), scene.parts.end(),
                    [&](const scene::Part& part) { return part.mesh == mesh.name; }))
      of_mesh[mesh.name] = expected_elements(mesh);
  double total = 0, most = 0;
  const scene::Part* largest = nullptr;
  for (const scene::Part& part : scene.parts) {
    const auto found = of_mesh.find(part.mesh);
    const double own = found == of_mesh.end() || !part.element_set.empty() ? 0 : found->second;
    total += own;
    if (own > most) most = own, largest = &part;
  }
  // The estimate may be too high, so a scene is refused only if this share of it does not fit.
  constexpr double certain = 0.7;
  const double bytes = (bytes_of_mesh_element + bytes_of_model_element) * total;
  if (!largest || certain * bytes <= available) return;
  throw InputError(
      fmt::format("{}: the meshes of all parts have about {:.2g} elements, which need about {} of memory, but this "
                  "machine has {} left; most of them "
                  "has [parts.{}] (line {}) by mesh '{}', about {:.2g}: {}, and see whether its lengths are in m",
                  scene.path, total, bytes_text(bytes), bytes_text(available), largest->name, largest->line,
                  largest->mesh, most, smaller_mesh));
}

void expect_memory_for_parts(const scene::Scene& scene) { expect_memory_for_parts(scene, available_memory()); }

}  // namespace railwave
