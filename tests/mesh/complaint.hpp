#pragma once

#include <string>

#include "case/error.hpp"
#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// What a generator says of a mesh's parameters; nothing if they suit it.
inline std::string complaint_of(Mesh (*generator)(const scene::MeshSource&), const scene::MeshSource& source) {
  try {
    generator(source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace railwave
