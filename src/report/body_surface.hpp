#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "post/results_reader.hpp"

namespace railwave::page {

/// What is seen of a set of /fields: its facets, or the outer faces of its hexahedra, and the nodes at their corners.
struct BodySurface {
  std::string name;
  hdf5::Group group;
  std::vector<Eigen::Vector3d> nodes;               ///< m, undeformed
  std::vector<std::size_t> node_places;             ///< of each node in the set's nodes
  std::vector<std::array<std::uint32_t, 4>> faces;  ///< of `nodes`, turned outwards
  std::vector<std::size_t> face_places;             ///< of each face's element in the set's cells
  std::vector<long> elements;                       ///< of the whole set, model numbers, ascending
  std::size_t set_nodes = 0, set_cells = 0;         ///< how many the set has
  std::vector<double> times;                        ///< s, of its outputs that are there in full
};

/// Reads it. Throws std::runtime_error where the file is damaged.
BodySurface read_surface(const std::string& name, const hdf5::Group& group);

/// A rigid motion: x is brought to turn x + shift.
struct RigidMotion {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d moved(const Eigen::Vector3d& x) const { return turn * x + shift; }
};

/// The rigid motion nearest to displacements (least squares over some thousands of the nodes, by the singular values of
/// the covariance [Kabsch 1976]); none where fewer than three are known.
/// @param displacements m, three numbers a node
RigidMotion nearest_rigid_motion(const std::vector<Eigen::Vector3d>& nodes, const std::vector<double>& displacements);

}  // namespace railwave::page
