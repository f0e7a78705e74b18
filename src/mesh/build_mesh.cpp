#include "mesh/build_mesh.hpp"

#include "case/error.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_room.hpp"

namespace railwave {

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
    throw InputError(place_of(source) + problem.what());
  }
}

}  // namespace railwave
