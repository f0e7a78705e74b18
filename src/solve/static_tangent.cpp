#include "solve/static_tangent.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "model/hourglass_scale.hpp"
#include "model/host_copy.hpp"

namespace railwave {
namespace {

Eigen::Matrix3d whole(const std::array<double, 6>& b) {
  Eigen::Matrix3d m;
  m << b[0], b[3], b[5], b[3], b[1], b[4], b[5], b[4], b[2];
  return m;
}

}  // namespace

StaticTangent::StaticTangent(const Model& model) : model_(model), tangent_(model.assembly) {
  const auto& elements = model.assembly.elements;
  const std::size_t nodes = model.assembly.nodes.size();
  part_of_element_.assign(elements.size(), 0);
  for (std::size_t p = 0; p < model.assembly.parts.size(); ++p) {
    const auto& range = model.assembly.parts[p];
    const scene::Part& part = model.scene.parts[p];
    const scene::Material& material = model.scene.materials[range.material];
    const double mu = material.shear_modulus(), factor = hourglass_factor(scene::HourglassType::stiffness,
                                                                          settling_hourglass_coefficient(part), material);
    stiffness_.push_back({material.dilatational_modulus() - 2 * mu, mu, factor, false, 0});
    std::fill_n(part_of_element_.begin() + range.first_element, range.element_count, static_cast<int>(p));
  }

  const NodeBlocks blocks = unset_array<double* [6]>("element blocks", nodes);
  Kokkos::parallel_for("element_blocks", Range(0, static_cast<int>(nodes)),
                       ElementBlocks{tangent_.first_corner(), tangent_.corner(), tangent_.corners(), model.nodes.position,
                                     to_device("stiffness", stiffness_), to_device("part of element", part_of_element_), blocks});
  const auto host = to_host(blocks);
  element_blocks_.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int c = 0; c < 6; ++c) element_blocks_[n][c] = host(n, c);

  row_of_node_ = to_vector(model.nodes.constraint);
  const auto table = to_host(model.constraints);
  for (std::size_t r = 0; r < table.extent(0); ++r) {
    auto& projection = projections_.emplace_back();
    for (int k = 0; k < 9; ++k) projection[k] = table(r, k / 3, k % 3);
  }
}

const double* StaticTangent::projection(int node) const {
  return row_of_node_[node] < 0 ? nullptr : projections_[row_of_node_[node]].data();
}

void StaticTangent::set_springs(const SpringCollector& springs, double shift) {
  shift_ = shift;
  tangent_.set_springs(springs.on_device());
  auto blocks = element_blocks_;
  for (std::size_t s = 0; s < springs.direction().size(); ++s) {
    const Vec3& d = springs.direction()[s];
    for (int k = springs.first()[s]; k < springs.first()[s + 1]; ++k) {
      const double weight = springs.weight()[k], factor = springs.stiffness()[s] * weight * weight;
      auto& b = blocks[springs.node()[k]];
      for (int i = 0; i < 3; ++i) b[i] += factor * d[i] * d[i];
      b[3] += factor * d[0] * d[1];
      b[4] += factor * d[1] * d[2];
      b[5] += factor * d[2] * d[0];
    }
  }
  double least = 1e300;
  diagonal_.resize(blocks.size());
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    diagonal_[n] = (blocks[n][0] + blocks[n][1] + blocks[n][2]) / 3;
    if (diagonal_[n] > 0) least = std::min(least, diagonal_[n]);
  }
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    // A point mass that no spring holds.
    if (!(diagonal_[n] > 0)) diagonal_[n] = least;
    Eigen::Matrix3d block = whole(blocks[n]) + shift * diagonal_[n] * Eigen::Matrix3d::Identity();
    const double* p = projection(static_cast<int>(n));
    Eigen::Matrix3d inverse;
    if (p == nullptr) {
      inverse = block.inverse();
    } else {
      const Eigen::Matrix3d P = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p);
      block = P * block * P + diagonal_[n] * (Eigen::Matrix3d::Identity() - P);
      inverse = P * block.inverse() * P;
    }
    blocks[n] = {inverse(0, 0), inverse(1, 1), inverse(2, 2), inverse(0, 1), inverse(1, 2), inverse(2, 0)};
  }
  inverse_ = to_device("inverse blocks", blocks);
  device_diagonal_ = to_device("tangent diagonal", diagonal_);
}

void StaticTangent::apply(const NodeVector& u, const NodeVector& f) const {
  tangent_.apply(model_.assembly, stiffness_, model_.nodes.position, u, 0, f);
  Kokkos::parallel_for("shift_and_hold", Range(0, model_.nodes.count),
                       ShiftAndHold{u, f, device_diagonal_, shift_, model_.nodes.constraint, model_.constraints});
}

}  // namespace railwave
