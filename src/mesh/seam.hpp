#pragma once

#include <string>

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// Opens a seam (crack) in a mesh whose layers lie across x: nodes near it move along x until one layer's faces lie on the
/// seam's plane, those faces within its length and depth come apart, and become the surfaces NAME_before and NAME_behind.
/// It follows whole faces; nodes of its front inside the mesh stay common. A body that is a prism along x keeps its shape.
/// @param place "FILE:LINE: [seams.NAME]", said before a complaint
/// Throws InputError where no layer of faces is there, or the mesh ends too near.
void open_seam(const scene::Seam& seam, const std::string& place, Mesh& mesh);

}  // namespace railwave
