#pragma once

#include <string>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"

namespace railwave {

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
