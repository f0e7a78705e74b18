#include "mesh/build_mesh.hpp"

#include <cmath>

#include "case/error.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_memory.hpp"

namespace railwave {

namespace {

[[noreturn]] void refuse(const scene::MeshSource& source, const MeshTooLarge& problem) {
  const std::string text = place_of(source) + problem.what();
  if (problem.of_memory) throw MemoryShortage(text);
  throw InputError(text);
}

}  // namespace

MeshGenerator generator_of(const scene::MeshSource& source) {
#define RAILWAVE_GENERATOR(type, Parameters) type##_generator,
  constexpr MeshGenerator (*of_type[])() = {RAILWAVE_MESHES(RAILWAVE_GENERATOR)};
#undef RAILWAVE_GENERATOR
  return of_type[static_cast<int>(source.type)]();
}

Mesh build_mesh(const scene::MeshSource& source, MeshNotes* notes) {
  try {
    return generator_of(source).build(source, notes);
  } catch (const MeshTooLarge& problem) {
    refuse(source, problem);
  }
}

double expected_elements(const scene::MeshSource& source) {
  try {
    const double estimate = generator_of(source).elements(source);
    // Parameters that don't fit each other may give any number; build() reports them.
    return estimate >= 0 && std::isfinite(estimate) ? estimate : 0;
  } catch (const MeshTooLarge& problem) {
    refuse(source, problem);
  }
}

double fine_element_size(const scene::MeshSource& source) {
  const auto fine_size = generator_of(source).fine_size;
  return fine_size ? fine_size(source) : 0;
}

}  // namespace railwave
