#include "mesh/generators/rail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/extrusion.hpp"
#include "mesh/grading.hpp"
#include "mesh/height_map.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/sections/rail_section.hpp"

namespace railwave {

void check_rail_mesh(const scene::MeshSource& source) {
  const scene::RailMesh& r = source.rail;
  MeshChecks checks(source);
  checks.expect(r.section == "54E1" || r.section == "60E1", "section", r.section, "\"54E1\" or \"60E1\"");
  checks.expect(std::abs(r.inclination) <= 0.2, "inclination", r.inclination, "-0.2 to 0.2");
  checks.expect(r.end > r.start, "end", r.end, fmt::format("more than start = {:g} m", r.start));
  checks.expect(r.zone_end > r.zone_start, "zone_end", r.zone_end,
                fmt::format("more than zone_start = {:g} m", r.zone_start));
  checks.expect(r.zone_start >= r.start, "zone_start", r.zone_start, fmt::format("start = {:g} m or more", r.start));
  checks.expect(r.zone_end <= r.end, "zone_end", r.zone_end, fmt::format("end = {:g} m or less", r.end));
  if (r.path_start || r.path_end)
    checks.path(r.path_start.value_or(r.zone_start), r.path_end.value_or(r.zone_end), r.zone_start, r.zone_end, r.start,
                r.end, r.path_size, r.zone_size, r.coarse_size);
  checks.grading(r.zone_size, r.growth, r.coarse_size, r.core_size, r.section_size, r.zone_layers, r.web_columns);
  checks.expect(r.zone_width >= r.zone_size && r.zone_width <= 0.09, "zone_width", r.zone_width, "zone_size to 0.09 m");
  checks.expect(r.zone_size * (r.zone_layers + transition_height) <= 0.024, "zone_layers", r.zone_layers,
                fmt::format("up to {:.0f} layers of {:g} m: the head is not deeper",
                            std::floor(0.024 / r.zone_size - transition_height), r.zone_size));
  checks.report();
}

RailSectionPlan section_plan(const scene::RailMesh& r) {
  RailSectionPlan plan;
  plan.section = r.section;
  plan.inclination = r.inclination;
  plan.zone_centre = r.zone_centre;
  plan.zone_width = r.zone_width;
  plan.zone_size = r.zone_size;
  plan.growth = r.growth;
  plan.section_size = r.section_size;
  plan.zone_layers = r.zone_layers;
  plan.web_columns = r.web_columns;
  plan.lower_transition = 9 * r.zone_size <= r.core_size;
  return plan;
}

Stations rail_stations(const scene::RailMesh& r) {
  const StationPlan along{r.zone_start,
                          r.zone_end,
                          r.zone_size,
                          r.growth,
                          r.coarse_size,
                          r.core_size,
                          section_plan(r).lower_transition ? 3 : 2,
                          r.path_start.value_or(r.zone_start),
                          r.path_end.value_or(r.zone_end),
                          r.path_size};
  return open_stations(along, r.start, r.end);
}

Placement inclined(double inclination) {
  const double angle = std::atan(inclination), c = std::cos(angle), s = std::sin(angle);
  return [=](Point2 p, double x) { return Vec3{x, p.y * c - p.z * s, p.y * s + p.z * c}; };
}

double rail_elements(const scene::MeshSource& source) {
  check_rail_mesh(source);
  try {
    return extruded_elements(rail_section(section_plan(source.rail), false), rail_stations(source.rail));
  } catch (const std::invalid_argument& problem) {
    throw InputError(place_of(source) + problem.what());
  }
}

Mesh rail_mesh(const scene::MeshSource& source) {
  check_rail_mesh(source);
  const scene::RailMesh& r = source.rail;
  const RailSectionPlan plan = section_plan(r);
  SectionMesh section;
  try {
    section = rail_section(plan);
  } catch (const std::invalid_argument& problem) {
    throw InputError(place_of(source) + problem.what());
  }
  const Stations stations = rail_stations(r);

  Extrusion extrusion = extrude(section, stations, inclined(r.inclination), false);
  Mesh& mesh = extrusion.mesh;

  const int last = static_cast<int>(stations.position.size()) - 1;
  mesh.surfaces["running_surface"] = faces_on_edges(extrusion, section.edges["running_surface"], 0, last);
  mesh.surfaces["head"] =
      faces_on_edges(extrusion, section.edges["head"], stations.path_first - 2, stations.path_last + 2);
  for (const char* side : {"_left", "_right"}) {
    auto& fishing = mesh.surfaces[std::string("fishing") + side];
    for (const char* line : fishing_lines) {
      const auto faces =
          faces_on_edges(extrusion, section.edges_along(section.lines.at(std::string(line) + side)), 0, last);
      fishing.insert(fishing.end(), faces.begin(), faces.end());
    }
  }
  mesh.element_sets["zone"] = zone_elements(extrusion, section, stations.zone_first, stations.zone_last);
  mesh.node_sets["foot"] = nodes_on_section_nodes(extrusion, section.node_sets["foot"]);
  auto& start = mesh.node_sets["start"];
  auto& end = mesh.node_sets["end"];
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n) {
    if (extrusion.station[n] == 0) start.push_back(n);
    if (extrusion.station[n] == last) end.push_back(n);
  }
  const auto& foot = mesh.node_sets["foot"];
  std::vector<char> on_foot(mesh.nodes.size(), 0);
  for (int n : foot) on_foot[n] = 1;
  mesh.surfaces["start_face"] = faces_at_station(extrusion, 0);
  mesh.surfaces["end_face"] = faces_at_station(extrusion, last);
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int side = 0; side < 6; ++side) {
      const auto nodes = mesh.face_nodes({e, side});
      if (std::all_of(nodes.begin(), nodes.end(), [&](int n) { return on_foot[n] != 0; }))
        mesh.surfaces["foot"].push_back({e, side});
    }
  if (!r.height_map.empty())
    apply_height_map(HeightMap(r.height_map), r.height_map_depth, mesh.surfaces["running_surface"], place_of(source),
                     mesh);
  return std::move(extrusion.mesh);
}

MeshGenerator rail_generator() {
  return {[](const scene::MeshSource& source, MeshNotes*) { return rail_mesh(source); }, rail_elements,
          [](const scene::MeshSource& source) {
            const scene::RailMesh& r = source.rail;
            return r.path_start ? std::max(r.zone_size, r.path_size) : r.zone_size;
          }};
}

}  // namespace railwave
