#include "mesh/mesh_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_room.hpp"

namespace railwave {
namespace {

/// Only where its parameters fit each other may a mesh be counted; where they don't, its maker says so.
bool counts(double number) { return number >= 0 && std::isfinite(number); }

}  // namespace

double expected_elements(const scene::MeshSource& source) {
  try {
    const double found = generator_of(source).elements(source);
    return counts(found) ? found : 0;
  } catch (const MeshTooLarge& problem) {
    throw InputError(place_of(source) + problem.what());
  }
}

double fine_element_size(const scene::MeshSource& source) {
  const auto fine_size = generator_of(source).fine_size;
  return fine_size ? fine_size(source) : 0;
}

void expect_room_for_parts(const scene::Scene& scene, double available) {
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
  // What is known beforehand is somewhat uncertain: what might just fit is tried.
  constexpr double certainly = 0.7;
  const double bytes = (bytes_of_mesh_element + bytes_of_model_element) * total;
  if (!largest || certainly * bytes <= available) return;
  throw InputError(
      fmt::format("{}: the meshes of all parts have about {:.2g} elements, which need about {} of memory, but this "
                  "machine has {} left; most of them "
                  "has [parts.{}] (line {}) by mesh '{}', about {:.2g}: {}, and see whether its lengths are in m",
                  scene.path, total, bytes_text(bytes), bytes_text(available), largest->name, largest->line,
                  largest->mesh, most, smaller_mesh));
}

void expect_room_for_parts(const scene::Scene& scene) { expect_room_for_parts(scene, available_memory()); }

}  // namespace railwave
