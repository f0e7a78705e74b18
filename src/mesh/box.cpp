#include "mesh/box.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "case/error.hpp"
#include "mesh/mesh_checks.hpp"

namespace railwave {
namespace {

constexpr char axis_names[3] = {'x', 'y', 'z'};

// Side of an element (see hexahedron_face_corners) that looks along -axis and +axis.
constexpr int lower_side[3] = {5, 2, 0};
constexpr int upper_side[3] = {3, 4, 1};

void check(const scene::MeshSource& source) {
  const scene::BoxMesh& box = source.box;
  const auto where = place_of(source);
  double node_count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.origin[axis]))
      throw InputError(
          fmt::format("{}origin along {} is {}; give a finite number in m", where, axis_names[axis], box.origin[axis]));
    if (!(box.size[axis] > 0) || !std::isfinite(box.size[axis]))
      throw InputError(
          fmt::format("{}size along {} is {}; give a length above 0 in m", where, axis_names[axis], box.size[axis]));
    if (box.divisions[axis] < 1)
      throw InputError(fmt::format("{}divisions along {} is {}; give a whole number of 1 or more", where,
                                   axis_names[axis], box.divisions[axis]));
    node_count *= box.divisions[axis] + 1.0;
  }
  if (node_count > std::numeric_limits<int>::max())
    throw InputError(fmt::format("{}divisions {} x {} x {} make {:.3g} nodes, more than {} can be numbered; use fewer",
                                 where, box.divisions[0], box.divisions[1], box.divisions[2], node_count,
                                 std::numeric_limits<int>::max()));
}

}  // namespace

Mesh box_mesh(const scene::MeshSource& source) {
  check(source);
  const scene::BoxMesh& box = source.box;
  const auto& n = box.divisions;
  const auto node_number = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };

  Mesh mesh;
  mesh.nodes.reserve(std::size_t(n[0] + 1) * (n[1] + 1) * (n[2] + 1));
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) {
        const std::array<int, 3> position{i, j, k};
        Vec3 x;
        for (int axis = 0; axis < 3; ++axis) x[axis] = box.origin[axis] + box.size[axis] * position[axis] / n[axis];
        for (int axis = 0; axis < 3; ++axis) {
          const std::string name(1, axis_names[axis]);
          if (position[axis] == 0) mesh.node_sets[name + "_min"].push_back(node_number(i, j, k));
          if (position[axis] == n[axis]) mesh.node_sets[name + "_max"].push_back(node_number(i, j, k));
        }
        mesh.nodes.push_back(x);
      }

  mesh.elements.reserve(std::size_t(n[0]) * n[1] * n[2]);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const std::array<int, 3> position{i, j, k};
        const int element = int(mesh.elements.size());
        mesh.elements.push_back({node_number(i, j, k), node_number(i + 1, j, k), node_number(i + 1, j + 1, k),
                                 node_number(i, j + 1, k), node_number(i, j, k + 1), node_number(i + 1, j, k + 1),
                                 node_number(i + 1, j + 1, k + 1), node_number(i, j + 1, k + 1)});
        for (int axis = 0; axis < 3; ++axis) {
          const std::string name(1, axis_names[axis]);
          if (position[axis] == 0) mesh.surfaces[name + "_min"].push_back({element, lower_side[axis]});
          if (position[axis] == n[axis] - 1) mesh.surfaces[name + "_max"].push_back({element, upper_side[axis]});
        }
      }
  return mesh;
}

}  // namespace railwave
