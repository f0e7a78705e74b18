#include "mesh/mesh_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "case/error.hpp"
#include "mesh/abaqus_file.hpp"
#include "mesh/gmsh_file.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/set_names.hpp"
#include "mesh/text_file.hpp"

namespace railwave {

Mesh read_mesh_file(const scene::MeshSource& source, std::vector<std::string>* notes) {
  const scene::FileMesh& file = source.file;
  const auto where = place_of(source);
  if (!(file.scale > 0) || !std::isfinite(file.scale))
    throw InputError(
        fmt::format("{}scale is {}; give a number above 0, for example 0.001 for a mesh in mm", where, file.scale));
  std::error_code ignored;
  if (!std::filesystem::exists(file.path, ignored))
    throw InputError(
        fmt::format("{}there is no file {}; check path, which counts from the case file's folder", where, file.path));

  const auto ending = lower_case(std::filesystem::path(file.path).extension().string());
  Mesh mesh;
  if (ending == ".inp") {
    mesh = read_abaqus_file(file.path, notes);
  } else if (ending == ".msh") {
    mesh = read_gmsh_file(file.path, notes);
  } else {
    throw InputError(fmt::format("{}{} ends in '{}'; mesh files are .inp (Abaqus, CalculiX) or .msh (Gmsh, MSH 4.1)",
                                 where, file.path, ending));
  }

  fit_set_names(mesh, file.path, notes);
  for (Vec3& node : mesh.nodes)
    for (double& coordinate : node) {
      coordinate *= file.scale;
      if (!std::isfinite(coordinate))
        throw InputError(fmt::format("{}scale {} makes coordinates too large for a number", where, file.scale));
    }
  return mesh;
}

}  // namespace railwave
