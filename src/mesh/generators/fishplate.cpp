#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "case/error.hpp"
#include "mesh/build_mesh.hpp"
#include "mesh/extrusion.hpp"
#include "mesh/generators/rail.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/mesh_memory.hpp"

/// A fishplate: a bar along x that fills the fishing chamber of a rail's mesh at one side, inclined as the rail is. Its
/// inner side follows the facets of the rail's mesh, with their nodes: under the head, along the web (`clearance` away
/// from it), on the foot; its outer side is plane. Surfaces upper, inner and lower (towards head, web and foot), outer,
/// start_face, end_face; `fishing` is the first three together, where it bridges a gap those before the gap, and
/// `fishing_2` those behind it. Throws InputError when it doesn't fit the chamber.
namespace railwave {
namespace {

using Points = std::vector<Point2>;

void check(const scene::MeshSource& source) {
  const scene::FishplateMesh& plate = source.fishplate;
  MeshChecks checks(source);
  checks.expect(plate.end > plate.start, "end", plate.end, fmt::format("more than start = {:g} m", plate.start));
  checks.expect(plate.thickness >= 0.004, "thickness", plate.thickness, "0.004 m or more");
  checks.expect(plate.clearance >= 0 && plate.clearance <= 0.003, "clearance", plate.clearance, "0 to 0.003 m");
  checks.expect(!plate.size || (*plate.size > 0 && *plate.size <= plate.end - plate.start), "size",
                plate.size.value_or(0), "above 0, to the plate's length");
  if (plate.gap_start && plate.gap_end) {
    checks.expect(*plate.gap_start > plate.start, "gap_start", *plate.gap_start,
                  fmt::format("more than start = {:g} m", plate.start));
    checks.expect(*plate.gap_end > *plate.gap_start, "gap_end", *plate.gap_end,
                  fmt::format("more than gap_start = {:g} m", *plate.gap_start));
    checks.expect(*plate.gap_end < plate.end, "gap_end", *plate.gap_end,
                  fmt::format("less than end = {:g} m", plate.end));
  }
  checks.report();
}

/// Point at the lateral position `y` on a line that leads outwards.
Point2 on(const Points& line, double y) {
  std::size_t i = 1;
  while (i + 1 < line.size() && line[i].y < y) ++i;
  const Point2 a = line[i - 1], b = line[i];
  return a + ((y - a.y) / (b.y - a.y)) * (b - a);
}

/// The line's own points as far as `outer`, and one there.
Points up_to(const Points& line, double outer) {
  Points kept{line.front()};
  for (std::size_t i = 1; line[i].y < outer; ++i) kept.push_back(line[i]);
  // A point close before the end would leave a sliver.
  const Point2 end = on(line, outer);
  if (const std::size_t n = kept.size(); n > 1 && norm(end - kept[n - 1]) < 0.3 * norm(kept[n - 1] - kept[n - 2]))
    kept.pop_back();
  kept.push_back(end);
  return kept;
}

/// Splits the longest cells by points on the line until there are `cells`.
Points refined(Points kept, const Points& line, std::size_t cells) {
  while (kept.size() < cells + 1) {
    std::size_t longest = 1;
    for (std::size_t i = 2; i < kept.size(); ++i)
      if (norm(kept[i] - kept[i - 1]) > (1 + 1e-9) * norm(kept[longest] - kept[longest - 1])) longest = i;
    kept.insert(kept.begin() + static_cast<long>(longest), on(line, 0.5 * (kept[longest - 1].y + kept[longest].y)));
  }
  return kept;
}

/// The lines of a rail's section that a plate lies on, mirrored to y > 0.
struct Chamber {
  Points underside, web, foot_top;  ///< outwards; from head to foot; outwards
  double fine_from = 0;             ///< y from which on the underside is as fine along x as the running surface
};

Chamber chamber(const SectionMesh& rail, scene::RailSide side) {
  const bool left = side == scene::RailSide::left;
  const auto points = [&](const char* name) {
    Points line;
    int before = -1;
    for (int n : rail.lines.at(std::string(name) + (left ? "_left" : "_right"))) {
      // In a transition along x the rail has nodes between the section's.
      if (before >= 0 && rail.nodes[n].level != rail.nodes[before].level) {
        const bool down = rail.nodes[n].level > rail.nodes[before].level;
        const Point2 lower = rail.position(down ? n : before), upper = rail.position(down ? before : n);
        line.push_back((1 - transition_depth) * lower + transition_depth * upper);
      }
      line.push_back(rail.position(n));
      before = n;
    }
    if (left)
      for (Point2& p : line) p.y = -p.y;
    return line;
  };
  Chamber found{points(fishing_lines[0]), points(fishing_lines[1]), points(fishing_lines[2])};
  std::reverse(found.underside.begin(), found.underside.end());
  found.fine_from = found.underside.back().y;
  for (int n :
       rail.lines.at(std::string(fishing_lines[0]) + (left ? "_left" : "_right")))  // from the head's corner inwards
    if (rail.nodes[n].level > 0) {
      found.fine_from = std::fabs(rail.position(n).y);
      break;
    }
  return found;
}

struct PlateSection {
  SectionMesh mesh;
  bool on_fine_layers = false;  ///< it reaches where the rail is as fine along x as its running surface
};

PlateSection plate_section(const scene::MeshSource& source, Chamber lines) {
  const scene::FishplateMesh& plate = source.fishplate;
  double thinnest = lines.web.front().y;
  for (const Point2& p : lines.web) thinnest = std::min(thinnest, p.y);
  for (Point2& p : lines.web) p.y += plate.clearance;
  lines.underside.front() = lines.web.front();
  lines.foot_top.front() = lines.web.back();
  const double outer = thinnest + plate.clearance + plate.thickness;
  const double least = std::max(lines.web.front().y, lines.web.back().y) + 0.002;
  const double most = std::min(lines.underside.back().y, lines.foot_top.back().y);
  if (outer < least || outer > most)
    throw InputError(
        fmt::format("{}thickness = {:g}; allowed: {:.4f} to {:.4f} m, so that the plate lies on head and foot of {}",
                    place_of(source), plate.thickness, least - thinnest - plate.clearance,
                    most - thinnest - plate.clearance, plate.rail_mesh.section));
  Points top = up_to(lines.underside, outer), bottom = up_to(lines.foot_top, outer);
  const std::size_t columns = std::max({top.size() - 1, bottom.size() - 1, std::size_t{2}});
  top = refined(top, lines.underside, columns);
  bottom = refined(bottom, lines.foot_top, columns);

  SectionMesh section;
  const auto add = [&](const Points& line) {
    std::vector<int> nodes;
    for (const Point2& p : line) nodes.push_back(section.add_fixed_node(p));
    return nodes;
  };
  const auto upper = add(top), lower = add(bottom);
  std::vector<int> inner{upper.front()}, outside{upper.back()};
  std::vector<Row> rows;
  double height = 0, down = 0;
  for (std::size_t i = 1; i < lines.web.size(); ++i) {
    rows.push_back({RowKind::plain, norm(lines.web[i] - lines.web[i - 1])});
    height += rows.back().height;
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    down += rows[i - 1].height;
    inner.push_back(section.add_fixed_node(lines.web[i]));
    outside.push_back(section.add_fixed_node(top.back() + (down / height) * (bottom.back() - top.back())));
  }
  inner.push_back(lower.front());
  outside.push_back(lower.back());
  fill_block(section, upper, rows, {}, inner, outside, lower, 0);
  section.lines = {{"upper", upper}, {"inner", inner}, {"lower", lower}, {"outer", outside}};
  return {std::move(section), outer > lines.fine_from + 1e-6};
}

/// Equal cells of about `size` in each of the stretches between `ends`.
Stations plate_stations(const std::vector<double>& ends, double size, std::vector<int>& station_of_end) {
  Stations stations;
  stations.position = {ends.front()};
  station_of_end = {0};
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double length = ends[i] - ends[i - 1];
    const int cells = std::max(1, cell_count(std::ceil(length / size - 1e-6)));
    for (int k = 1; k < cells; ++k) stations.position.push_back(ends[i - 1] + length * k / cells);
    stations.position.push_back(ends[i]);
    station_of_end.push_back(static_cast<int>(stations.position.size()) - 1);
  }
  stations.levels.resize(1);
  for (int i = 0; i < static_cast<int>(stations.position.size()); ++i) stations.levels[0].push_back(i);
  return stations;
}

Mesh build(const scene::MeshSource& source, MeshNotes* /*notes*/) {
  check(source);
  const scene::FishplateMesh& plate = source.fishplate;
  scene::MeshSource rail = source;
  rail.name = plate.rail;
  rail.rail = plate.rail_mesh;
  check_rail_mesh(rail);
  PlateSection built;
  try {
    built = plate_section(source, chamber(rail_section(section_plan(plate.rail_mesh)), plate.side));
  } catch (const std::invalid_argument& problem) {
    throw InputError(place_of(rail) + problem.what());
  }

  const SectionMesh& section = built.mesh;
  const double default_size =
      (built.on_fine_layers ? 1 : 3) * plate.rail_mesh.zone_size;  // nowhere coarser than the rail, for ties
  std::vector<double> ends{plate.start, plate.end};
  if (plate.gap_start && plate.gap_end) ends = {plate.start, *plate.gap_start, *plate.gap_end, plate.end};
  std::vector<int> at;
  const Stations stations = plate_stations(ends, plate.size.value_or(default_size), at);
  const bool left = plate.side == scene::RailSide::left;
  const Placement leaning = inclined(plate.rail_mesh.inclination);
  const Placement place = [&](Point2 p, double x) { return leaning({left ? -p.y : p.y, p.z}, x); };
  Extrusion extrusion = extrude(section, stations, place, left);
  Mesh& mesh = extrusion.mesh;
  const auto faces = [&](const char* line, int first, int last) {
    return faces_on_edges(extrusion, section.edges_along(section.lines.at(line)), first, last);
  };
  const int last = at.back();
  for (const char* line : {"upper", "inner", "lower", "outer"}) mesh.surfaces[line] = faces(line, 0, last);
  for (const char* line : {"upper", "inner", "lower"}) {
    const auto add = [&](const char* name, int first, int end) {
      const auto found = faces(line, first, end);
      mesh.surfaces[name].insert(mesh.surfaces[name].end(), found.begin(), found.end());
    };
    add("fishing", 0, at[1]);
    if (at.size() == 4) add("fishing_2", at[2], at[3]);
  }
  mesh.surfaces["start_face"] = faces_at_station(extrusion, 0);
  mesh.surfaces["end_face"] = faces_at_station(extrusion, last);
  return std::move(extrusion.mesh);
}

double elements(const scene::MeshSource& source) {
  const scene::FishplateMesh& plate = source.fishplate;
  constexpr double section = 60;  // quadrilaterals of a chamber between zone_size and three times that
  return section * std::max(1.0, (plate.end - plate.start) / plate.size.value_or(3 * plate.rail_mesh.zone_size));
}

}  // namespace

MeshGenerator fishplate_generator() { return {build, elements}; }

}  // namespace railwave
