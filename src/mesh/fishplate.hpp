#pragma once

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// A fishplate: a bar along x that fills the fishing chamber of a rail's mesh at one side, inclined as the rail is. Its
/// inner side follows the facets of the rail's mesh, with their nodes: under the head, along the web (`clearance` away
/// from it), on the foot; its outer side is plane. Surfaces upper, inner and lower (towards head, web and foot), outer,
/// start_face, end_face; `fishing` is the first three together, where it bridges a gap those before the gap, and
/// `fishing_2` those behind it. Throws InputError when it doesn't fit the chamber.
Mesh fishplate_mesh(const scene::MeshSource& source);

}  // namespace railwave
