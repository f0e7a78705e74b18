#pragma once

#include <string>

#include "case/scene.hpp"
#include "mesh/mesh.hpp"

namespace railwave {

/// What a seam became: it consists of whole element faces, so that it is met to an element's size.
struct OpenedSeam {
  int nodes = 0;      ///< that came apart
  int faces = 0;      ///< on each side
  double length = 0;  ///< m, along y, its whole front included
  double depth = 0;   ///< m, from the mesh's upper surface along its plane
};

/// Opens a seam (crack) in a mesh whose layers lie across x: nodes near it move along x until one layer's faces lie on
/// the seam's plane, those faces within its length and depth come apart, and become the surfaces NAME_before and
/// NAME_behind. It follows whole faces; nodes of its front inside the mesh stay common. A body that is a prism along x
/// keeps its shape. With a width both sides' nodes lie that far apart, but for the front's. The depth is measured from
/// the mesh's upper surface at the seam's place, which may be off it by an element's height.
/// @param place "FILE:LINE: [seams.NAME]", said before a complaint
/// Throws InputError for a place that is not on the mesh's upper surface (it names the nearest one that is), where no
/// layer of faces is there, where no node opens, where the seam cuts the body in two, where the mesh ends too near, or
/// a width for which the elements beside it are too short.
OpenedSeam open_seam(const scene::Seam& seam, const std::string& place, Mesh& mesh);

/// A line about it: nodes, and length and depth in m beside those that were asked for.
std::string describe(const scene::Seam& seam, const OpenedSeam& opened);

}  // namespace railwave
