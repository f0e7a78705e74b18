#include "mesh/generators/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/extrusion.hpp"
#include "mesh/grading.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/sections/wheel_section.hpp"

namespace railwave {

namespace {

/// Levels of coarsening towards the bore.
int wheel_levels(const scene::WheelMesh& w) { return 9 * w.zone_size <= w.core_size ? 3 : 2; }

}  // namespace

void check_wheel_mesh(const scene::MeshSource& source, const scene::WheelMesh& w) {
  MeshChecks checks(source);
  const double depth = w.zone_size * (w.zone_layers + transition_height);
  checks.expect(w.profile == "S1002" || w.profile == "cone", "profile", w.profile, "\"S1002\" or \"cone\"");
  checks.expect(std::abs(w.conicity) <= 0.2, "conicity", w.conicity, "-0.2 to 0.2");
  checks.expect(w.bore_radius > 0.01, "bore_radius", w.bore_radius, "more than 0.01 m");
  checks.expect(w.hub_radius >= w.bore_radius + 0.005, "hub_radius", w.hub_radius,
                fmt::format("bore_radius + 0.005 = {:g} m or more", w.bore_radius + 0.005));
  checks.expect(w.web_inner_radius >= w.hub_radius, "web_inner_radius", w.web_inner_radius,
                fmt::format("hub_radius = {:g} m or more", w.hub_radius));
  checks.expect(w.web_outer_radius >= w.web_inner_radius + 0.02, "web_outer_radius", w.web_outer_radius,
                fmt::format("web_inner_radius + 0.02 = {:g} m or more", w.web_inner_radius + 0.02));
  checks.expect(w.rim_inner_radius >= w.web_outer_radius, "rim_inner_radius", w.rim_inner_radius,
                fmt::format("web_outer_radius = {:g} m or more", w.web_outer_radius));
  checks.expect(
      w.radius >= w.rim_inner_radius + depth + 0.015, "radius", w.radius,
      fmt::format("rim_inner_radius + the zone's layers + 0.015 = {:g} m or more", w.rim_inner_radius + depth + 0.015));
  checks.expect(w.web_inner_thickness > 0.003 && w.web_inner_thickness < w.hub_width, "web_inner_thickness",
                w.web_inner_thickness, "0.003 m to hub_width");
  checks.expect(w.web_outer_thickness > 0.003 && w.web_outer_thickness <= 0.6 * w.rim_width, "web_outer_thickness",
                w.web_outer_thickness, "0.003 m to 0.6 rim_width");
  checks.expect(w.rim_width >= 0.1 && w.rim_width <= 0.15, "rim_width", w.rim_width, "0.1 to 0.15 m");
  checks.expect(
      std::abs(w.web_centre + 0.070 - w.rim_width / 2) <= 0.25 * w.rim_width, "web_centre", w.web_centre,
      fmt::format("the rim's middle {:g} m, give or take {:g} m", w.rim_width / 2 - 0.070, 0.25 * w.rim_width));
  checks.expect(w.hub_width > 0.01 && w.hub_width <= 0.4, "hub_width", w.hub_width, "0.01 to 0.4 m");
  checks.expect(w.zone_length >= w.zone_size && w.zone_length <= 2 * M_PI * w.radius, "zone_length", w.zone_length,
                fmt::format("zone_size to the circumference, {:.4f} m", 2 * M_PI * w.radius));
  checks.expect(std::abs(w.zone_start) <= M_PI * w.radius, "zone_start", w.zone_start,
                fmt::format("half the circumference, {:.4f} m, to either side", M_PI * w.radius));
  checks.expect(w.zone_width >= w.zone_size && w.zone_width <= w.rim_width, "zone_width", w.zone_width,
                "zone_size to rim_width");
  if (w.path_start) {
    const double middle = w.zone_start + w.zone_length / 2;
    checks.path(*w.path_start, *w.path_start + w.path_length, w.zone_start, w.zone_start + w.zone_length,
                middle - M_PI * w.radius, middle + M_PI * w.radius, w.path_size, w.zone_size, w.coarse_size);
  }
  checks.grading(w.zone_size, w.growth, w.coarse_size, w.core_size, w.section_size, w.zone_layers, w.web_columns);
  checks.report();
}

Stations wheel_stations(const scene::WheelMesh& w) {
  const StationPlan around{w.zone_start,
                           w.zone_start + w.zone_length,
                           w.zone_size,
                           w.growth,
                           w.coarse_size,
                           w.core_size,
                           wheel_levels(w),
                           w.path_start.value_or(w.zone_start),
                           w.path_start ? *w.path_start + w.path_length : w.zone_start,
                           w.path_size};
  return periodic_stations(around, 2 * M_PI * w.radius);
}

WheelBody wheel_body(const scene::MeshSource& source, const scene::WheelMesh& w) {
  check_wheel_mesh(source, w);
  SectionMesh section;
  try {
    section = wheel_section(w, wheel_levels(w) == 3);
  } catch (const std::invalid_argument& problem) {
    throw InputError(place_of(source) + problem.what());
  }
  const Stations stations = wheel_stations(w);

  const double radius = w.radius;
  const auto place = [radius](Point2 p, double arc) {
    return Vec3{p.z * std::sin(arc / radius), p.y, -p.z * std::cos(arc / radius)};
  };
  Extrusion extrusion = extrude(section, stations, place, true);
  balance_wheel(extrusion, section, stations, w);
  Mesh& mesh = extrusion.mesh;
  const int count = static_cast<int>(stations.position.size());
  mesh.surfaces["running_surface"] = faces_on_edges(extrusion, section.edges["running_surface"], 0, count);
  mesh.surfaces["tread"] = faces_on_edges(extrusion, section.edges["tread"], std::max(0, stations.path_first - 2),
                                          std::min(count, stations.path_last + 2));
  mesh.element_sets["zone"] = zone_elements(extrusion, section, stations.zone_first, stations.zone_last);
  mesh.node_sets["bore"] = nodes_on_section_nodes(extrusion, section.node_sets["bore"]);
  std::vector<int> centre;
  for (int n = 0; n < static_cast<int>(mesh.nodes.size()); ++n)
    if (std::abs(mesh.nodes[n][0]) < 1e-9 * radius && mesh.nodes[n][2] < 0) centre.push_back(n);
  if (!centre.empty()) mesh.node_sets["centre_section"] = centre;
  WheelBody body;
  body.bore_line = section.node_sets["bore"];
  body.bore_stations = stations.levels.back();
  for (int station : body.bore_stations) body.bore_angles.push_back(stations.position[station] / radius);
  body.extrusion = std::move(extrusion);
  return body;
}

double wheel_elements(const scene::MeshSource& source, const scene::WheelMesh& w) {
  check_wheel_mesh(source, w);
  try {
    return extruded_elements(wheel_section(w, wheel_levels(w) == 3, false), wheel_stations(w));
  } catch (const std::invalid_argument& problem) {
    throw InputError(place_of(source) + problem.what());
  }
}

double wheel_fine_size(const scene::WheelMesh& w) {
  return w.path_start ? std::max(w.zone_size, w.path_size) : w.zone_size;
}

Mesh wheel_mesh(const scene::MeshSource& source) { return wheel_body(source, source.wheel).extrusion.mesh; }

MeshGenerator wheel_generator() {
  return {[](const scene::MeshSource& source, MeshNotes*) { return wheel_mesh(source); },
          [](const scene::MeshSource& source) { return wheel_elements(source, source.wheel); },
          [](const scene::MeshSource& source) { return wheel_fine_size(source.wheel); }};
}

}  // namespace railwave
