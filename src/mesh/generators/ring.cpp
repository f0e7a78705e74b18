#include <fmt/format.h>

#include <cmath>

#include "mesh/build_mesh.hpp"
#include "mesh/grid.hpp"
#include "mesh/mesh_checks.hpp"

/// A hollow cylinder of equal cells, or a plane annulus where it is one cell wide: a tyre, a test body whose solution
/// is known. Its axis lies along y through the origin, its middle in y = 0; every node of its round sides is exact. The
/// first nodes lie at the lowest point, the next ones towards +x, and the last cells end on the first nodes. Node sets
/// and surfaces: inner, outer, y_min, y_max. Throws InputError if the parameters don't fit.
namespace railwave {
namespace {

void check(const scene::MeshSource& source) {
  const scene::RingMesh& r = source.ring;
  MeshChecks checks(source);
  checks.expect(r.outer_radius > 0, "outer_radius", r.outer_radius, "above 0");
  checks.expect(r.inner_radius > 0 && r.inner_radius < r.outer_radius, "inner_radius", r.inner_radius,
                fmt::format("above 0 and below outer_radius = {:g} m", r.outer_radius));
  checks.expect(r.width > 0, "width", r.width, "above 0");
  checks.expect(r.round_divisions >= 8, "round_divisions", r.round_divisions, "at least 8");
  checks.expect(r.wall_divisions >= 1, "wall_divisions", r.wall_divisions, "at least 1");
  checks.expect(r.width_divisions >= 1, "width_divisions", r.width_divisions, "at least 1");
  checks.report();
}

/// Cells lie round the ring, along y and from the outer side inwards.
Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  check(source);
  const scene::RingMesh& r = source.ring;
  const Grid grid{
      {r.round_divisions, r.width_divisions, r.wall_divisions}, true, {"", "y_min", "outer"}, {"", "y_max", "inner"}};
  return grid_mesh(grid, [&](int i, int j, int k) {
    const double angle = 2 * M_PI * i / r.round_divisions, depth = static_cast<double>(k) / r.wall_divisions;
    const double radius = (1 - depth) * r.outer_radius + depth * r.inner_radius;
    const double y = r.width * (static_cast<double>(j) / r.width_divisions - 0.5);
    return Vec3{radius * std::sin(angle), y, -radius * std::cos(angle)};
  });
}

double elements(const scene::MeshSource& source) {
  const scene::RingMesh& r = source.ring;
  return static_cast<double>(r.round_divisions) * r.wall_divisions * r.width_divisions;
}

}  // namespace

MeshGenerator ring_generator() { return {build, elements}; }

}  // namespace railwave
