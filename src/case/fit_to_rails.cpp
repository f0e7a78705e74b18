#include <fmt/format.h>

#include "case/expand.hpp"
#include "case/track_entries.hpp"

namespace railwave::case_file {
namespace {

template <class Mesh>
void fit(const scene::Scene& scene, const scene::MeshSource& source, Mesh& mesh, const char* what_it_needs,
         Complaints& complaints) {
  const scene::MeshSource* rail = find_entry(scene.meshes, mesh.rail);
  if (!rail) return;  // reported where names are checked
  if (rail->type != scene::MeshType::rail)
    complaints.add({source.line},
                   fmt::format("[meshes.{}] rail: '{}' is no mesh of type \"rail\", which alone has {}; name one",
                               source.name, mesh.rail, what_it_needs));
  mesh.rail_mesh = rail->rail;
}

}  // namespace

void fit_to_rails(scene::Scene& scene, Complaints& complaints) {
  for (scene::MeshSource& mesh : scene.meshes) {
    if (mesh.type == scene::MeshType::fishplate) fit(scene, mesh, mesh.fishplate, "a fishing chamber", complaints);
    if (mesh.type == scene::MeshType::rail_pad) fit(scene, mesh, mesh.rail_pad, "a foot", complaints);
  }
}

}  // namespace railwave::case_file
