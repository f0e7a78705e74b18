#include "case/fit_fishplates.hpp"

#include <fmt/format.h>

#include "case/track_entries.hpp"

namespace railwave::case_file {

void fit_fishplates(scene::Scene& scene, Complaints& complaints) {
  for (scene::MeshSource& mesh : scene.meshes) {
    if (mesh.type != scene::MeshType::fishplate) continue;
    const scene::MeshSource* rail = find_entry(scene.meshes, mesh.fishplate.rail);
    if (!rail) continue;  // told where names are checked
    if (rail->type != scene::MeshType::rail)
      complaints.add({mesh.line}, fmt::format("[meshes.{}] rail: '{}' is no mesh of type \"rail\", which alone has a fishing chamber; name one",
                                              mesh.name, mesh.fishplate.rail));
    mesh.fishplate.rail_mesh = rail->rail;
  }
}

}  // namespace railwave::case_file
