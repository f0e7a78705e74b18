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

StaticTangent::StaticTangent(const Model& model) : model_(model) {
  const auto& elements = model.assembly.elements;
  const std::size_t nodes = model.assembly.nodes.size();
  stiffness_of_element_.assign(elements.size(), 0);
  for (std::size_t p = 0; p < model.assembly.parts.size(); ++p) {
    const auto& range = model.assembly.parts[p];
    const scene::Part& part = model.scene.parts[p];
    const scene::Material& material = model.scene.materials[range.material];
    const double mu = material.shear_modulus(), factor = hourglass_factor(scene::HourglassType::stiffness,
                                                                          settling_hourglass_coefficient(part), material);
    stiffness_.push_back({material.dilatational_modulus() - 2 * mu, mu, factor, false, 0});
    std::fill_n(stiffness_of_element_.begin() + range.first_element, range.element_count, static_cast<int>(p));
  }

  std::vector<int> first(nodes + 1, 0), corner(8 * elements.size());
  for (const auto& corners : elements)
    for (int n : corners) ++first[n + 1];
  for (std::size_t n = 0; n < nodes; ++n) first[n + 1] += first[n];
  std::vector<int> filled(first.begin(), first.end() - 1);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (int N = 0; N < 8; ++N) corner[filled[elements[e][N]]++] = static_cast<int>(8 * e) + N;
  corners_ = to_device("tangent corners", elements);
  first_corner_ = to_device("tangent first corner", first);
  corner_ = to_device("tangent corner", corner);
  corner_force_ = unset_array<double* [24]>("tangent corner force", elements.size());

  const NodeBlocks blocks = unset_array<double* [6]>("element blocks", nodes);
  Kokkos::parallel_for("element_blocks", Range(0, static_cast<int>(nodes)),
                       ElementBlocks{first_corner_, corner_, corners_, model.nodes.position, to_device("stiffness", stiffness_),
                                     to_device("stiffness of element", stiffness_of_element_), blocks});
  const auto host = to_host(blocks);
  element_blocks_.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int c = 0; c < 6; ++c) element_blocks_[n][c] = host(n, c);

  lay_holds();
}

/// Constraints, and what is held only while the scene settles.
void StaticTangent::lay_holds() {
  const auto constraint = to_host(model_.nodes.constraint);
  hold_.assign(constraint.data(), constraint.data() + constraint.extent(0));
  const auto table = to_host(model_.constraints);
  for (std::size_t r = 0; r < table.extent(0); ++r) {
    auto& projection = projections_.emplace_back();
    for (int k = 0; k < 9; ++k) projection[k] = table(r, k / 3, k % 3);
  }
  const Array<double* [3][3]> device = unset_array<double* [3][3]>("static holds", projections_.size());
  const auto host = Kokkos::create_mirror_view(device);
  for (std::size_t r = 0; r < projections_.size(); ++r)
    for (int k = 0; k < 9; ++k) host(r, k / 3, k % 3) = projections_[r][k];
  Kokkos::deep_copy(device, host);
  holds_ = {to_device("static holds of nodes", hold_), device};
}

const double* StaticTangent::projection(int node) const {
  return hold_[node] < 0 ? nullptr : projections_[hold_[node]].data();
}

void StaticTangent::set_springs(const SpringCollector& springs, double shift) {
  shift_ = shift;
  springs_ = springs.on_device();
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
  const int nodes = static_cast<int>(model_.assembly.nodes.size());
  for (std::size_t p = 0; p < model_.assembly.parts.size(); ++p) {
    const auto& range = model_.assembly.parts[p];
    Kokkos::parallel_for("element_tangent", Range(0, range.element_count),
                         ElementTangent{range.first_element, stiffness_[p], corners_, model_.nodes.position, u, corner_force_});
  }
  Kokkos::parallel_for("tangent_gather", Range(0, nodes), GatherTangent{first_corner_, corner_, corner_force_, f});
  if (springs_.count > 0) {
    Kokkos::parallel_for("tangent_springs", Range(0, springs_.count), SpringForce{springs_, u, 0});
    Kokkos::parallel_for("tangent_add_springs", Range(0, springs_.node_count), AddSprings{springs_, f});
  }
  Kokkos::parallel_for("shift_and_hold", Range(0, nodes), ShiftAndHold{u, f, device_diagonal_, shift_, holds_});
}

}  // namespace railwave
