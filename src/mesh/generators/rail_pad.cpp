#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/grid.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_memory.hpp"

/// A pad under a rail's foot from `start` to `end` along x: as wide as the foot's underside, leaning with it,
/// `thickness` thick everywhere. Its lines along and across the rail are those of the foot's elements, so that it can
/// be tied to the foot node on node and is nowhere the coarser mesh; `size` subdivides them further. Node sets and
/// surfaces x_min, x_max, y_min, y_max, z_min, z_max as a box has them. Throws InputError if it is not within the
/// rail's length, and if the rail's parameters do not fit each other.
namespace railwave {
namespace {

/// A line of the foot this near to the pad's end, as a share of the foot's cell, makes no sliver there.
constexpr double least_cell = 0.3;

void check(const scene::MeshSource& source) {
  const scene::RailPadMesh& pad = source.rail_pad;
  const scene::RailMesh& rail = pad.rail_mesh;
  MeshChecks checks(source);
  checks.expect(pad.start >= rail.start - 1e-9, "start", pad.start,
                fmt::format("{:g} m, the rail's start, or more", rail.start));
  checks.expect(pad.end <= rail.end + 1e-9, "end", pad.end, fmt::format("{:g} m, the rail's end, or less", rail.end));
  checks.expect(pad.end > pad.start, "end", pad.end, fmt::format("more than start = {:g} m", pad.start));
  checks.report();
}

/// The pad's ends and the foot's lines between them.
std::vector<double> lines_along(const scene::RailPadMesh& pad, const Stations& stations) {
  std::vector<double> foot;
  for (int kept : stations.levels.back()) foot.push_back(stations.position[kept]);
  std::vector<double> lines{pad.start};
  for (std::size_t i = 1; i + 1 < foot.size(); ++i) {
    const double cell = std::min(foot[i] - foot[i - 1], foot[i + 1] - foot[i]);
    if (foot[i] > pad.start + least_cell * cell && foot[i] < pad.end - least_cell * cell) lines.push_back(foot[i]);
  }
  lines.push_back(pad.end);
  return lines;
}

/// Lines with equal cells between, none longer than `size`.
std::vector<double> parted(const std::vector<double>& lines, double size) {
  std::vector<double> all{lines.front()};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double length = lines[i] - lines[i - 1];
    const int cells = std::max(1, cell_count(std::ceil(length / size - 1e-6)));
    for (int k = 1; k < cells; ++k) all.push_back(lines[i - 1] + length * k / cells);
    all.push_back(lines[i]);
  }
  return all;
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  const scene::RailPadMesh& pad = source.rail_pad;
  scene::MeshSource rail = source;
  rail.name = pad.rail;
  rail.rail = pad.rail_mesh;
  check_rail_mesh(rail);
  check(source);
  std::vector<double> across;
  try {
    const SectionMesh section = rail_section(section_plan(rail.rail));
    for (int n : section.node_sets.at("foot")) across.push_back(section.position(n).y);
  } catch (const std::invalid_argument& problem) {
    throw InputError(place_of(rail) + problem.what());
  }
  std::sort(across.begin(), across.end());
  auto along = lines_along(pad, rail_stations(rail.rail));
  if (pad.size) {
    along = parted(along, *pad.size);
    across = parted(across, *pad.size);
  }
  const Placement leaning = inclined(rail.rail.inclination);
  const Grid grid{{static_cast<int>(along.size()) - 1, static_cast<int>(across.size()) - 1, pad.layers},
                  false,
                  {"x_min", "y_min", "z_min"},
                  {"x_max", "y_max", "z_max"}};
  return grid_mesh(grid, [&](int i, int j, int k) {
    return leaning({across[j], pad.thickness * (k - pad.layers) / pad.layers}, along[i]);
  });
}

double elements(const scene::MeshSource& source) {
  const scene::RailPadMesh& pad = source.rail_pad;
  const scene::RailMesh& rail = pad.rail_mesh;
  const double foot = rail.section == "60E1" ? 0.15 : 0.14;  // m, width
  const double across = foot / std::min(pad.size.value_or(1), 1.5 * rail.section_size);
  const double along = (pad.end - pad.start) / std::min({pad.size.value_or(1), rail.coarse_size, rail.core_size});
  const double in_zone =
      std::clamp(std::min(pad.end, rail.zone_end) - std::max(pad.start, rail.zone_start), 0.0, pad.end - pad.start);
  return pad.layers * std::max(1.0, across) *
         (std::max(1.0, along) + in_zone / std::min(rail.core_size, 9 * rail.zone_size));
}

}  // namespace

MeshGenerator rail_pad_generator() { return {build, elements}; }

}  // namespace railwave
