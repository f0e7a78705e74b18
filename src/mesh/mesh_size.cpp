#include "mesh/mesh_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "mesh/fishplate.hpp"
#include "mesh/grid.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_room.hpp"
#include "mesh/rail.hpp"
#include "mesh/rail_pad.hpp"
#include "mesh/rail_section.hpp"
#include "mesh/wheel.hpp"
#include "mesh/wheelset.hpp"

namespace railwave {
namespace {

/// A text line of an element and one of a node, as Gmsh and Abaqus write them.
constexpr double bytes_of_element_in_file = 110;

double cells(const GradedLine& line) { return static_cast<double>(nodes_of(line).size()) - 1; }

/// Cells along, across and down a block or a roller graded from a zone.
template <class Graded>
double graded(const Graded& g, const GradedLine& along, double side_start, double side_end, double depth) {
  const double layer = g.layer_height.value_or(g.zone_size);
  const double across = cells({side_start, side_end, g.zone_centre - g.zone_width / 2, g.zone_centre + g.zone_width / 2,
                               g.zone_size, g.growth, g.coarse_size});
  return cells(along) * across * cells({0, depth, 0, g.zone_layers * layer, layer, g.growth, g.coarse_size});
}

double crowned_block(const scene::CrownedBlockMesh& b) {
  const GradedLine along{b.origin[0],  b.origin[0] + b.size[0], b.zone_start, b.zone_end, b.zone_size, b.growth,
                         b.coarse_size};
  return graded(b, along, b.origin[1], b.origin[1] + b.size[1], b.size[2]);
}

double roller(const scene::RollerMesh& r) {
  const double around = r.ring ? 2 * M_PI * r.radius : r.arc_end - r.arc_start;
  const double start = r.ring ? 0.5 * (r.zone_start + r.zone_end - around) : r.arc_start;
  const GradedLine along{start, start + around, r.zone_start, r.zone_end, r.zone_size, r.growth, r.coarse_size};
  return graded(r, along, r.side_start, r.side_end, r.radius - r.bore_radius);
}

double fishplate(const scene::FishplateMesh& plate) {
  constexpr double section = 60;  // quadrilaterals of a chamber between zone_size and three times that
  return section * std::max(1.0, (plate.end - plate.start) / plate.size.value_or(3 * plate.rail_mesh.zone_size));
}

double rail_pad(const scene::MeshSource& source) {
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

/// Only where its parameters fit each other may a mesh be counted; where they don't, its maker says so.
bool counts(double number) { return number >= 0 && std::isfinite(number); }

double count(const scene::MeshSource& source) {
  switch (source.type) {
    case scene::MeshType::box: {
      const auto& n = source.box.divisions;
      return static_cast<double>(n[0]) * n[1] * n[2];
    }
    case scene::MeshType::wheel:
      return wheel_elements(source, source.wheel);
    case scene::MeshType::rail:
      return rail_elements(source);
    case scene::MeshType::file: {
      std::error_code failed;
      const auto size = std::filesystem::file_size(source.file.path, failed);
      return failed ? 0 : static_cast<double>(size) / bytes_of_element_in_file;
    }
    case scene::MeshType::crowned_block:
      return crowned_block(source.crowned_block);
    case scene::MeshType::roller:
      return roller(source.roller);
    case scene::MeshType::cylinder: {
      const auto& c = source.cylinder;
      return (static_cast<double>(c.core_divisions) + 4.0 * c.ring_divisions) * c.core_divisions * c.length_divisions;
    }
    case scene::MeshType::fishplate:
      return fishplate(source.fishplate);
    case scene::MeshType::rail_pad:
      return rail_pad(source);
    case scene::MeshType::wheelset:
      return wheelset_elements(source);
  }
  return 0;
}

}  // namespace

double expected_elements(const scene::MeshSource& source) {
  try {
    const double found = count(source);
    return counts(found) ? found : 0;
  } catch (const MeshTooLarge& problem) {
    throw InputError(place_of(source) + problem.what());
  }
}

void expect_room_for_parts(const scene::Scene& scene, double available) {
  std::map<std::string, double> of_mesh;
  for (const scene::MeshSource& mesh : scene.meshes)
    if (std::any_of(scene.parts.begin(), scene.parts.end(),
                    [&](const scene::Part& part) { return part.mesh == mesh.name; }))
      of_mesh[mesh.name] = expected_elements(mesh);
  double total = 0, most = 0;
  const scene::Part* largest = nullptr;
  for (const scene::Part& part : scene.parts) {
    const auto found = of_mesh.find(part.mesh);
    const double own = found == of_mesh.end() || !part.element_set.empty() ? 0 : found->second;
    total += own;
    if (own > most) most = own, largest = &part;
  }
  // What is known beforehand is somewhat uncertain: what might just fit is tried.
  constexpr double certainly = 0.7;
  const double bytes = (bytes_of_mesh_element + bytes_of_model_element) * total;
  if (!largest || certainly * bytes <= available) return;
  throw InputError(
      fmt::format("{}: the meshes of all parts have about {:.2g} elements, which need about {} of memory, but this "
                  "machine has {} left; most of them "
                  "has [parts.{}] (line {}) by mesh '{}', about {:.2g}: {}, and see whether its lengths are in m",
                  scene.path, total, bytes_text(bytes), bytes_text(available), largest->name, largest->line,
                  largest->mesh, most, smaller_mesh));
}

void expect_room_for_parts(const scene::Scene& scene) { expect_room_for_parts(scene, available_memory()); }

}  // namespace railwave
