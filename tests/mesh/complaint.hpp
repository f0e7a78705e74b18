#pragma once

#include <string>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"

namespace railwave {

/// A mesh of that type at its default values, called "body" in line 7.
inline scene::MeshSource named(scene::MeshType type) {
  scene::MeshSource source;
  source.name = "body";
  source.line = 7;
  source.type = type;
  return source;
}

/// What a mesh's generator says of its parameters; nothing if they suit it.
inline std::string complaint_of(const scene::MeshSource& source) {
  try {
    build_mesh(source);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace railwave
