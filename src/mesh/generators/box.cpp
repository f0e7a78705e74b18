#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/grid.hpp"
#include "mesh/mesh_checks.hpp"

/// A rectangular block of `box.divisions[0..2]` equal hexahedra along x, y, z between `box.origin` and
/// `box.origin + box.size` (m). Node and element numbers run fastest along x, then y, then z.
/// Node sets and surfaces x_min, x_max, y_min, y_max, z_min, z_max are its six sides.
/// Throws InputError when a size or division isn't positive, or the block has more nodes than an int counts.
namespace railwave {
namespace {

constexpr char axis_names[3] = {'x', 'y', 'z'};

void check(const scene::MeshSource& source) {
  const scene::BoxMesh& box = source.box;
  const auto where = place_of(source);
  double node_count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.origin[axis]))
      throw InputError(
          fmt::format("{}origin along {} is {}; give a finite number in m", where, axis_names[axis], box.origin[axis]));
    if (!(box.size[axis] > 0) || !std::isfinite(box.size[axis]))
      throw InputError(
          fmt::format("{}size along {} is {}; give a length above 0 in m", where, axis_names[axis], box.size[axis]));
    if (box.divisions[axis] < 1)
      throw InputError(fmt::format("{}divisions along {} is {}; give a whole number of 1 or more", where,
                                   axis_names[axis], box.divisions[axis]));
    node_count *= box.divisions[axis] + 1.0;
  }
  if (node_count > std::numeric_limits<int>::max())
    throw InputError(fmt::format("{}divisions {} x {} x {} make {:.3g} nodes, more than {} can be numbered; use fewer",
                                 where, box.divisions[0], box.divisions[1], box.divisions[2], node_count,
                                 std::numeric_limits<int>::max()));
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  check(source);
  const scene::BoxMesh& box = source.box;
  const auto& n = box.divisions;
  const Grid grid{n, false, {"x_min", "y_min", "z_min"}, {"x_max", "y_max", "z_max"}};
  return grid_mesh(grid, [&](int i, int j, int k) {
    const std::array<int, 3> position{i, j, k};
    Vec3 x;
    for (int axis = 0; axis < 3; ++axis) x[axis] = box.origin[axis] + box.size[axis] * position[axis] / n[axis];
    return x;
  });
}

double elements(const scene::MeshSource& source) {
  const auto& n = source.box.divisions;
  return static_cast<double>(n[0]) * n[1] * n[2];
}

}  // namespace

MeshGenerator box_generator() { return {build, elements}; }

}  // namespace railwave
