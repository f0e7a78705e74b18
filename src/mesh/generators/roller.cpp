#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/body_balance.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/curve.hpp"
#include "mesh/grid.hpp"
#include "mesh/mesh_checks.hpp"

/// A roller, a whole ring or a sector of one, exact at every node of its tread, which may be crowned. The axle lies
/// along y through the origin; arcs are measured at the tread from the lowest point, positive towards +x. Cells have
/// zone_size in the zone under the tread and grow away from it round the roller, along the axle and inwards. The centre
/// of mass of a ring lies on the axle; to achieve that, nodes of the bore are moved a little off its circle where cells
/// are wide. Node sets and surfaces: tread, bore, y_min, y_max; of a sector also arc_min, arc_max; surface zone, the
/// tread over the solution zone, for contacts: it has small facets only, and large thin ones would reduce the stable
/// time step. Throws InputError if the parameters don't fit.
namespace railwave {
namespace {

void check(const scene::MeshSource& source) {
  const scene::RollerMesh& r = source.roller;
  MeshChecks checks(source);
  const double around = 2 * M_PI * r.radius;
  checks.expect(r.radius > 0, "radius", r.radius, "above 0");
  checks.expect(r.bore_radius > 0 && r.bore_radius < r.radius, "bore_radius", r.bore_radius,
                fmt::format("above 0 and below radius = {:g} m", r.radius));
  checks.expect(r.side_end > r.side_start, "side_end", r.side_end,
                fmt::format("more than side_start = {:g} m", r.side_start));
  checks.expect(r.zone_size > 0, "zone_size", r.zone_size, "above 0");
  checks.expect(r.zone_end > r.zone_start, "zone_end", r.zone_end,
                fmt::format("more than zone_start = {:g} m", r.zone_start));
  if (r.ring) {
    checks.expect(r.zone_end - r.zone_start < 0.9 * around, "zone_end", r.zone_end,
                  fmt::format("at most 0.9 of the way round, {:g} m, from zone_start", 0.9 * around));
  } else {
    checks.expect(r.arc_end > r.arc_start, "arc_end", r.arc_end,
                  fmt::format("more than arc_start = {:g} m", r.arc_start));
    checks.expect(r.arc_end - r.arc_start < 0.99 * around, "arc_end", r.arc_end,
                  fmt::format("less than once round, {:g} m, from arc_start; a whole roller is ring = true", around));
    checks.expect(r.zone_start < r.arc_end && r.zone_end > r.arc_start, "zone_start", r.zone_start,
                  fmt::format("a zone that meets the sector, from {:g} to {:g} m", r.arc_start, r.arc_end));
  }
  checks.expect(r.zone_centre + r.zone_width / 2 > r.side_start && r.zone_centre - r.zone_width / 2 < r.side_end,
                "zone_centre", r.zone_centre,
                fmt::format("a zone that meets the roller, from y = {:g} to {:g} m", r.side_start, r.side_end));
  const double reach = std::max(std::fabs(r.side_start), std::fabs(r.side_end));
  checks.expect(r.crown_radius == 0 || r.crown_radius > 1.01 * reach, "crown_radius", r.crown_radius,
                fmt::format("0 (straight) or more than the roller's reach along y, {:g} m", reach));
  checks.report();
  const double drop = fall(r.crown_radius, reach), wall = r.radius - r.bore_radius;
  checks.expect(
      drop < 0.5 * wall, "crown_radius", r.crown_radius,
      fmt::format("a crown that falls by less than half of radius - bore_radius, {:g} m; this one falls {:g} m",
                  wall / 2, drop));
  checks.report();
}

/// Round a ring the zone lies between two stretches of equal length.
GradedLine line_around(const scene::RollerMesh& r) {
  if (!r.ring) return {r.arc_start, r.arc_end, r.zone_start, r.zone_end, r.zone_size, r.growth, r.coarse_size};
  const double rest = 2 * M_PI * r.radius - (r.zone_end - r.zone_start);
  return {
      r.zone_start - rest / 2, r.zone_end + rest / 2, r.zone_start, r.zone_end, r.zone_size, r.growth, r.coarse_size};
}

/// Round the roller, along y and from the tread inwards.
GridLines lines_of(const scene::RollerMesh& r) {
  const double layer = r.layer_height.value_or(r.zone_size), half = r.zone_width / 2;
  return {line_around(r),
          GradedLine{r.side_start, r.side_end, r.zone_centre - half, r.zone_centre + half, r.zone_size, r.growth,
                     r.coarse_size},
          GradedLine{0, r.radius - r.bore_radius, 0, r.zone_layers * layer, layer, r.growth, r.coarse_size}};
}

/// Moves the nodes of a ring radially, by a share that grows linearly from 0 at the tread to 1 at the bore, so that its
/// centre of mass lies on the axle and its volume is that of the body of revolution: the chords of wide cells cut
/// volume off at the tread and add volume at the bore.
void balance(Mesh& mesh, const std::vector<double>& arc, const std::vector<double>& depth, const scene::RollerMesh& r) {
  std::vector<double> angles;
  double sines = 0;  // volume of a cell of angle a over that of its sector: sin(a) / a
  for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
    angles.push_back(arc[i] / r.radius);
    sines += std::sin((arc[i + 1] - arc[i]) / r.radius);
  }
  const auto radii = balanced_radii(angles);
  const std::size_t around = angles.size(), sheet = mesh.nodes.size() / depth.size();
  RadialMotion motion;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    motion.share.push_back(depth[n / sheet] / depth.back());
    motion.shape.push_back(radii[n % around] - 1);
  }
  balance_body(mesh, motion, mesh_volume(mesh) * 2 * M_PI / sines);
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  check(source);
  const scene::RollerMesh& r = source.roller;
  const double wall = r.radius - r.bore_radius;
  const GridLines lines = lines_of(r);
  const auto arc = nodes_of(lines[0]), y = nodes_of(lines[1]), depth = nodes_of(lines[2]);
  const Grid grid{
      {static_cast<int>(arc.size()) - 1, static_cast<int>(y.size()) - 1, static_cast<int>(depth.size()) - 1},
      r.ring,
      {"arc_min", "y_min", "tread"},
      {"arc_max", "y_max", "bore"}};
  Mesh mesh = grid_mesh(grid, [&](int i, int j, int k) {
    const double radius = r.bore_radius + (wall - fall(r.crown_radius, y[j])) * (1 - depth[k] / wall);
    const double angle = arc[i] / r.radius;
    return Vec3{radius * std::sin(angle), y[j], -radius * std::cos(angle)};
  });
  if (r.ring) balance(mesh, arc, depth, r);
  mesh.surfaces["zone"] = zone_faces(mesh.surfaces["tread"], lines[0], lines[1]);
  return mesh;
}

double elements(const scene::MeshSource& source) { return cells_of(lines_of(source.roller)); }

double fine_size(const scene::MeshSource& source) { return source.roller.zone_size; }

}  // namespace

MeshGenerator roller_generator() { return {build, elements, fine_size}; }

}  // namespace railwave
