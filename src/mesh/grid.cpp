#include "mesh/grid.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/grading.hpp"
#include "mesh/mesh_memory.hpp"

namespace railwave {
namespace {

// Side of an element (see hexahedron_face_corners) at the beginning and the end of each direction.
constexpr int beginning_side[3] = {5, 2, 0};
constexpr int ending_side[3] = {3, 4, 1};

}  // namespace

Mesh grid_mesh(const Grid& grid, const GridPlacement& place) {
  const auto& n = grid.cells;
  const int nodes_along = grid.closed ? n[0] : n[0] + 1;
  const auto number = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * nodes_along + i % nodes_along; };
  const auto has_sides = [&](int axis) { return axis > 0 || !grid.closed; };

  expect_mesh_memory(double(n[0]) * n[1] * n[2], double(nodes_along) * (n[1] + 1.0) * (n[2] + 1.0));
  Mesh mesh;
  mesh.nodes.reserve(std::size_t(nodes_along) * (n[1] + 1) * (n[2] + 1));
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i < nodes_along; ++i) {
        const std::array<int, 3> at{i, j, k};
        for (int axis = 0; axis < 3; ++axis) {
          if (!has_sides(axis)) continue;
          if (at[axis] == 0) mesh.node_sets[grid.first_side[axis]].push_back(number(i, j, k));
          if (at[axis] == n[axis]) mesh.node_sets[grid.last_side[axis]].push_back(number(i, j, k));
        }
        mesh.nodes.push_back(place(i, j, k));
      }

  mesh.elements.reserve(std::size_t(n[0]) * n[1] * n[2]);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        const int element = int(mesh.elements.size());
        mesh.elements.push_back({number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k),
                                 number(i, j, k + 1), number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1),
                                 number(i, j + 1, k + 1)});
        for (int axis = 0; axis < 3; ++axis) {
          if (!has_sides(axis)) continue;
          if (at[axis] == 0) mesh.surfaces[grid.first_side[axis]].push_back({element, beginning_side[axis]});
          if (at[axis] == n[axis] - 1) mesh.surfaces[grid.last_side[axis]].push_back({element, ending_side[axis]});
        }
      }
  return mesh;
}

std::vector<double> nodes_of(const GradedLine& line) {
  double first = std::max(line.zone_start, line.start), last = std::min(line.zone_end, line.end), size = line.size;
  if (first - line.start < 0.5 * size) first = line.start;
  if (line.end - last < 0.5 * size) last = line.end;
  int cells = std::max(1, cell_count(std::ceil((last - first) / size - 1e-6)));
  if (first == line.start && last == line.end)
    size = (last - first) / cells;
  else if (last == line.end)
    first = last - cells * size;
  if (first < line.start || first + cells * size > line.end - 1e-9 * size) {  // the zone fills the line
    first = line.start;
    cells = std::max(1, cell_count(std::round((line.end - first) / size)));
    size = (line.end - first) / cells;
  }
  last = first + cells * size;

  auto before = graded_cells(first - line.start, size, line.growth, line.largest);
  const auto after = graded_cells(line.end - last, size, line.growth, line.largest);
  std::reverse(before.begin(), before.end());
  std::vector<double> nodes{line.start};
  for (double cell : before) nodes.push_back(nodes.back() + cell);
  nodes.back() = first;
  for (int i = 1; i <= cells; ++i) nodes.push_back(first + i * size);
  for (double cell : after) nodes.push_back(nodes.back() + cell);
  nodes.back() = line.end;
  return nodes;
}

double cells_of(const GridLines& lines) {
  double cells = 1;
  for (const GradedLine& line : lines) cells *= static_cast<double>(nodes_of(line).size()) - 1;
  return cells;
}

std::vector<Face> zone_faces(const std::vector<Face>& side, const GradedLine& first, const GradedLine& second) {
  const auto in_zone = [](const GradedLine& line) {
    const auto nodes = nodes_of(line);
    std::vector<char> inside;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const double middle = 0.5 * (nodes[i] + nodes[i + 1]);
      inside.push_back(middle > line.zone_start && middle < line.zone_end ? 1 : 0);
    }
    return inside;
  };
  const auto along = in_zone(first), across = in_zone(second);
  std::vector<Face> faces;
  for (const Face& face : side)
    if (along[face.element % along.size()] != 0 && across[face.element / along.size() % across.size()] != 0)
      faces.push_back(face);
  return faces;
}

}  // namespace railwave
