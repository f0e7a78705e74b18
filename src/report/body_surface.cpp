#include "report/body_surface.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/field_table.hpp"
#include "mesh/face_table.hpp"

namespace railwave::page {
namespace {

constexpr std::size_t fitted_nodes = 4000;  ///< at most, for a rigid motion

struct OuterFaces {
  std::vector<std::array<int, 4>> corners;  ///< positions among the set's nodes
  std::vector<std::size_t> cells;
};

OuterFaces outer_faces(const std::vector<int>& connectivity, std::size_t corners, std::size_t node_count) {
  for (const int node : connectivity)
    if (node < 0 || static_cast<std::size_t>(node) >= node_count)
      throw std::runtime_error("a cell has a corner that is no node");
  OuterFaces faces;
  const std::size_t cells = connectivity.size() / corners;
  if (corners == 4) {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const int* c = &connectivity[4 * cell];
      faces.corners.push_back({c[0], c[1], c[2], c[3]});
      faces.cells.push_back(cell);
    }
    return faces;
  }
  Mesh mesh;
  mesh.nodes.resize(node_count);
  mesh.elements.resize(cells);
  for (std::size_t i = 0; i < connectivity.size(); ++i) mesh.elements[i / 8][i % 8] = connectivity[i];
  for (const Face& face : FaceTable(mesh).exterior()) {
    faces.corners.push_back(mesh.face_nodes(face));
    faces.cells.push_back(static_cast<std::size_t>(face.element));
  }
  return faces;
}

/// A kill in the middle of a flush may leave the arrays with different lengths.
std::vector<double> whole_outputs(const hdf5::Group& group) {
  std::vector<double> times = group.dataset("time").read<double>();
  for (const FieldRow* row : fields_for(FieldRow::fields))
    if (group.has(row->name))
      times.resize(std::min(times.size(), static_cast<std::size_t>(group.dataset(row->name).shape().at(0))));
  return times;
}

}  // namespace

BodySurface read_surface(const std::string& name, const hdf5::Group& parent) {
  BodySurface surface;
  surface.name = name;
  surface.group = parent.group(name);
  const hdf5::Group& group = surface.group;
  const std::vector<double> coordinates = group.dataset("coordinates").read<double>();
  const hdf5::Shape shape = group.dataset("connectivity").shape();
  if (coordinates.size() % 3 != 0 || shape.size() != 2 || (shape[1] != 4 && shape[1] != 8))
    throw std::runtime_error("its coordinates or cells have another shape");
  surface.set_nodes = coordinates.size() / 3;
  surface.set_cells = static_cast<std::size_t>(shape[0]);
  const OuterFaces outer =
      outer_faces(group.dataset("connectivity").read<int>(), static_cast<std::size_t>(shape[1]), surface.set_nodes);
  constexpr std::uint32_t unused = UINT32_MAX;
  std::vector<std::uint32_t> place(surface.set_nodes, unused);
  for (const auto& face : outer.corners)
    for (const int node : face) place[static_cast<std::size_t>(node)] = 0;
  for (std::size_t node = 0; node < place.size(); ++node) {
    if (place[node] == unused) continue;
    place[node] = static_cast<std::uint32_t>(surface.nodes.size());
    surface.nodes.emplace_back(&coordinates[3 * node]);
    surface.node_places.push_back(node);
  }
  for (const auto& face : outer.corners) {
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) corners[i] = place[static_cast<std::size_t>(face[i])];
    surface.faces.push_back(corners);
  }
  surface.face_places = outer.cells;
  surface.elements = group.dataset("elements").read<long>();
  std::sort(surface.elements.begin(), surface.elements.end());
  surface.times = whole_outputs(group);
  return surface;
}

RigidMotion nearest_rigid_motion(const std::vector<Eigen::Vector3d>& nodes, const std::vector<double>& displacements) {
  std::vector<std::size_t> known;
  const std::size_t stride = std::max<std::size_t>(1, nodes.size() / fitted_nodes);
  for (std::size_t i = 0; i < nodes.size(); i += stride)
    if (Eigen::Vector3d(&displacements[3 * i]).allFinite()) known.push_back(i);
  if (known.size() < 3) return {};
  const auto count = static_cast<double>(known.size());
  Eigen::Vector3d before = Eigen::Vector3d::Zero(), after = before;
  for (const std::size_t i : known) {
    before += nodes[i] / count;
    after += (nodes[i] + Eigen::Vector3d(&displacements[3 * i])) / count;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const std::size_t i : known)
    covariance += (nodes[i] - before) * (nodes[i] + Eigen::Vector3d(&displacements[3 * i]) - after).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1);
  RigidMotion motion;
  motion.turn = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  motion.shift = after - motion.turn * before;
  return motion;
}

}  // namespace railwave::page
