#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/build_mesh.hpp"
#include "mesh/curve.hpp"
#include "mesh/grid.hpp"
#include "mesh/mesh_checks.hpp"

/// A block whose top is curved: plane, cylinder, sphere, or an arc turned about an axis, exact at every node. Its crest
/// is above (0, 0), at the height of the top of the box between `origin` and `origin + size`. Cells have zone_size in
/// the zone under the top and grow away from it along x, y and downwards; the curve fades out towards the plane bottom.
/// Node sets and surfaces: top, bottom, x_min, x_max, y_min, y_max; surface zone, the top over the solution zone, for
/// contacts: it has small facets only, and large thin ones would reduce the stable time step. Throws InputError if the
/// parameters don't fit.
namespace railwave {
namespace {

double farthest(double origin, double size) { return std::max(std::fabs(origin), std::fabs(origin + size)); }

void check(const scene::MeshSource& source) {
  const scene::CrownedBlockMesh& b = source.crowned_block;
  MeshChecks checks(source);
  const double smallest = std::min({b.size[0], b.size[1], b.size[2]});
  checks.expect(smallest > 0, "size", smallest, "above 0 in each direction");
  checks.expect(b.zone_size > 0, "zone_size", b.zone_size, "above 0");
  checks.expect(b.zone_end > b.zone_start, "zone_end", b.zone_end,
                fmt::format("more than zone_start = {:g} m", b.zone_start));
  const double x_end = b.origin[0] + b.size[0], y_end = b.origin[1] + b.size[1];
  checks.expect(b.zone_start < x_end && b.zone_end > b.origin[0], "zone_start", b.zone_start,
                fmt::format("a zone that meets the block, from x = {:g} to {:g} m", b.origin[0], x_end));
  checks.expect(b.zone_centre + b.zone_width / 2 > b.origin[1] && b.zone_centre - b.zone_width / 2 < y_end,
                "zone_centre", b.zone_centre,
                fmt::format("a zone that meets the block, from y = {:g} to {:g} m", b.origin[1], y_end));
  const double x = farthest(b.origin[0], b.size[0]), y = farthest(b.origin[1], b.size[1]);
  checks.expect(b.radius_along == 0 || b.radius_along > 1.01 * x, "radius_along", b.radius_along,
                fmt::format("0 (straight) or more than the block's reach along x, {:g} m", x));
  checks.expect(b.radius_across == 0 || b.radius_across > 1.01 * y, "radius_across", b.radius_across,
                fmt::format("0 (straight) or more than the block's reach along y, {:g} m", y));
  checks.report();
  const double side = fall(b.radius_across, y);
  checks.expect(b.radius_along == 0 || b.radius_along - side > x, "radius_along", b.radius_along,
                fmt::format("more than {:g} m, so that the crown reaches the block's corners", side + x));
  checks.report();
  const double drop = crown_fall(b.radius_along, b.radius_across, x, y);
  checks.expect(drop < 0.5 * b.size[2], "size", b.size[2],
                fmt::format("a height of more than {:g} m, twice what the crown falls to the corners", 2 * drop));
  checks.report();
}

/// Along x, along y and from the top down.
GridLines lines_of(const scene::CrownedBlockMesh& b) {
  const double layer = b.layer_height.value_or(b.zone_size), half = b.zone_width / 2;
  return {
      GradedLine{b.origin[0], b.origin[0] + b.size[0], b.zone_start, b.zone_end, b.zone_size, b.growth, b.coarse_size},
      GradedLine{b.origin[1], b.origin[1] + b.size[1], b.zone_centre - half, b.zone_centre + half, b.zone_size,
                 b.growth, b.coarse_size},
      GradedLine{0, b.size[2], 0, b.zone_layers * layer, layer, b.growth, b.coarse_size}};
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  check(source);
  const scene::CrownedBlockMesh& b = source.crowned_block;
  const double height = b.size[2];
  const GridLines lines = lines_of(b);
  const auto x = nodes_of(lines[0]), y = nodes_of(lines[1]), depth = nodes_of(lines[2]);
  const int layers = static_cast<int>(depth.size()) - 1;
  const Grid grid{{static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1, layers},
                  false,
                  {"x_min", "y_min", "bottom"},
                  {"x_max", "y_max", "top"}};
  Mesh mesh = grid_mesh(grid, [&](int i, int j, int k) {
    const double drop = crown_fall(b.radius_along, b.radius_across, x[i], y[j]);
    return Vec3{x[i], y[j], b.origin[2] + (height - drop) * (1 - depth[layers - k] / height)};
  });
  mesh.surfaces["zone"] = zone_faces(mesh.surfaces["top"], lines[0], lines[1]);
  return mesh;
}

double elements(const scene::MeshSource& source) { return cells_of(lines_of(source.crowned_block)); }

double fine_size(const scene::MeshSource& source) { return source.crowned_block.zone_size; }

}  // namespace

MeshGenerator crowned_block_generator() { return {build, elements, fine_size}; }

}  // namespace railwave
