#include "mesh/sections/section_columns.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/grading.hpp"
#include "mesh/mesh_memory.hpp"

namespace railwave {

int zone_columns(double width, double size) { return 3 * std::max(1, cell_count(std::ceil(width / size / 3 - 1e-6))); }

SurfaceColumns surface_columns(double begin, double first, double last, double end, int zone, double size,
                               double growth, double largest, int multiple) {
  SurfaceColumns columns;
  columns.sizes = graded_cells(first - begin, size, growth, largest, multiple);
  std::reverse(columns.sizes.begin(), columns.sizes.end());
  columns.zone_first = static_cast<int>(columns.sizes.size());
  columns.zone_last = columns.zone_first + zone;
  columns.sizes.insert(columns.sizes.end(), zone, (last - first) / zone);
  const auto after = graded_cells(end - last, size, growth, largest, multiple);
  columns.sizes.insert(columns.sizes.end(), after.begin(), after.end());
  columns.boundaries = {begin};
  for (double width : columns.sizes) columns.boundaries.push_back(columns.boundaries.back() + width);
  for (int i = 0; i <= zone; ++i) columns.boundaries[columns.zone_first + i] = first + (last - first) * i / zone;
  columns.boundaries.back() = end;
  return columns;
}

std::vector<std::vector<int>> plan_merges(const SurfaceColumns& columns, double band_limit, double limit, int least,
                                          int most) {
  std::vector<std::vector<int>> merges;
  std::vector<double> sizes = columns.sizes;
  int middle = columns.zone_first;
  double width = columns.sizes[columns.zone_first];
  while (3 * width <= band_limit * (1 + 1e-9) || (static_cast<int>(sizes.size()) > most && merges.size() < 2)) {
    const auto groups = merge_groups(sizes, middle, std::max(limit, 3 * width));
    if (std::count(groups.begin(), groups.end(), 3) == 0) break;
    if (static_cast<int>(groups.size()) < least) break;
    int cell = 0, next = 0;
    while (cell < middle) cell += groups[next++];
    middle = next;
    sizes = merged_sizes(sizes, groups);
    merges.push_back(groups);
    width *= 3;
  }
  return merges;
}

std::vector<Row> lateral_rows(int count, double size) {
  std::vector<Row> rows;
  for (int i = 0; i < count; ++i, size *= 3) rows.push_back({RowKind::lateral, transition_height * size});
  return rows;
}

std::vector<double> row_fractions(const std::vector<Row>& rows) {
  std::vector<double> fractions{0};
  for (const Row& row : rows) fractions.push_back(fractions.back() + row.height);
  for (double& fraction : fractions) fraction /= fractions.back();
  return fractions;
}

std::vector<double> even_fractions(int parts) {
  std::vector<double> fractions;
  for (int i = 0; i <= parts; ++i) fractions.push_back(static_cast<double>(i) / parts);
  return fractions;
}

std::vector<int> straight_line(SectionMesh& section, int first, int last, const std::vector<double>& fractions) {
  const Point2 a = section.position(first), b = section.position(last);
  std::vector<int> nodes{first};
  for (std::size_t i = 1; i + 1 < fractions.size(); ++i)
    nodes.push_back(section.add_node((1 - fractions[i]) * a + fractions[i] * b));
  nodes.push_back(last);
  return nodes;
}

void fix_zone(SectionMesh& section, const std::vector<BlockRow>& rows, const SurfaceColumns& columns,
              const Curve& surface, int layers, double size) {
  for (int r = 0; r <= layers; ++r) {
    for (int c = columns.zone_first; c <= columns.zone_last; ++c) {
      SectionNode& node = section.nodes[rows[r].top_line[c]];
      if (r > 0 && node.curve >= 0) continue;  // the band reaches the section's side
      const double arc = columns.boundaries[c], depth = r * size;
      const auto below = [&](double at) { return surface.at(at) - depth * surface.left_normal(at); };
      node.position = below(arc);
      // Below a sharp corner normals run together: leave the deeper nodes there to smoothing.
      const double step = std::min(1e-5, 0.1 * size);
      const double from = std::max(0.0, arc - step), to = std::min(surface.length, arc + step);
      node.fixed = r <= 1 || norm(below(to) - below(from)) > 0.8 * (to - from);
    }
    if (r == layers) break;
    for (int c = columns.zone_first; c < columns.zone_last; ++c) section.quads[rows[r].first_quads[c]].zone = true;
  }
}

}  // namespace railwave
