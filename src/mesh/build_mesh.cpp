#include "mesh/build_mesh.hpp"

#include <stdexcept>

#include "case/error.hpp"
#include "mesh/box.hpp"
#include "mesh/crowned_block.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/fishplate.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/mesh_room.hpp"
#include "mesh/rail.hpp"
#include "mesh/rail_pad.hpp"
#include "mesh/roller.hpp"
#include "mesh/wheel.hpp"
#include "mesh/wheelset.hpp"

namespace railwave {

namespace {

Mesh made(const scene::MeshSource& source, std::vector<std::string>* notes) {
  switch (source.type) {
    case scene::MeshType::box:
      return box_mesh(source);
    case scene::MeshType::wheel:
      return wheel_mesh(source);
    case scene::MeshType::rail:
      return rail_mesh(source);
    case scene::MeshType::file:
      return read_mesh_file(source, notes);
    case scene::MeshType::crowned_block:
      return crowned_block_mesh(source);
    case scene::MeshType::roller:
      return roller_mesh(source);
    case scene::MeshType::cylinder:
      return cylinder_mesh(source);
    case scene::MeshType::fishplate:
      return fishplate_mesh(source);
    case scene::MeshType::rail_pad:
      return rail_pad_mesh(source);
    case scene::MeshType::wheelset:
      return wheelset_mesh(source);
  }
  throw std::logic_error("unknown mesh type");
}

}  // namespace

Mesh build_mesh(const scene::MeshSource& source, std::vector<std::string>* notes) {
  try {
    return made(source, notes);
  } catch (const MeshTooLarge& problem) {
    throw InputError(place_of(source) + problem.what());
  }
}

}  // namespace railwave
