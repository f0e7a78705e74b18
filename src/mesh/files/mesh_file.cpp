#include "mesh/files/mesh_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/files/text_file.hpp"
#include "mesh/mesh_checks.hpp"

/// A mesh read from the file `source.file.path`, by its ending: .inp (Abaqus, CalculiX) or .msh (Gmsh MSH 4.1), its
/// coordinates multiplied by `source.file.scale`. `notes`, when given, receives one line about each thing that was left
/// out. Throws InputError naming the entry of the case file, or file and line (byte, in a binary file) of the mesh
/// file.
namespace railwave {
namespace {

/// A text line of an element and one of a node, as Gmsh and Abaqus write them.
constexpr double bytes_of_element_in_file = 110;

Mesh read(const scene::MeshSource& source, MeshNotes* notes) {
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

double elements(const scene::MeshSource& source) {
  std::error_code failed;
  const auto size = std::filesystem::file_size(source.file.path, failed);
  return failed ? 0 : static_cast<double>(size) / bytes_of_element_in_file;
}

}  // namespace

MeshGenerator file_generator() { return {read, elements}; }

}  // namespace railwave
