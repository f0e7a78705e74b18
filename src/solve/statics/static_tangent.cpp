#include "solve/statics/static_tangent.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <utility>

#include "model/host_copy.hpp"
#include "model/time_step/tangent_operator.hpp"

namespace railwave {
namespace {

Eigen::Matrix3d whole(const std::array<double, 6>& b) {
  Eigen::Matrix3d m;
  m << b[0], b[3], b[5], b[3], b[1], b[4], b[5], b[4], b[2];
  return m;
}

std::array<double, 6> distinct(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
}

}  // namespace

StaticTangent::StaticTangent(const AssembledScene& assembled, const NodeArrays& nodes, const StaticUnknowns& unknowns,
                             StaticParts* parts)
    : assembly_(assembled.assembly),
      nodes_(nodes),
      unknowns_(unknowns),
      parts_(parts),
      tangent_(assembly_, unknowns.rotations()) {
  const auto& elements = assembly_.elements;
  const std::size_t count = assembly_.nodes.size();
  part_of_element_.assign(elements.size(), 0);
  for (std::size_t p = 0; p < assembly_.parts.size(); ++p) {
    const auto& range = assembly_.parts[p];
    stiffness_.push_back(settling_stiffness(assembled.scene.parts[p], assembled.scene.materials[range.material]));
    std::fill_n(part_of_element_.begin() + range.first_element, range.element_count, static_cast<int>(p));
  }

  const NodeBlocks blocks = unset_array<double* [6]>("element blocks", count);
  Kokkos::parallel_for(
      "element_blocks", Range(0, static_cast<int>(count)),
      StiffnessBlocks{tangent_.first_corner(), tangent_.corner(), tangent_.corners(), nodes.position,
                      to_device("stiffness", stiffness_), to_device("part of element", part_of_element_), blocks});
  const auto host = to_host(blocks);
  // Slaves' blocks are felt by their masters: what one slave has to do with another is left out.
  std::vector<Eigen::Matrix3d> sum(unknowns.rows(), Eigen::Matrix3d::Zero());
  for (std::size_t n = 0; n < count; ++n) {
    std::array<double, 6> own;
    for (int c = 0; c < 6; ++c) own[c] = host(n, c);
    if (!unknowns.follows(static_cast<int>(n))) {
      sum[n] += whole(own);
      continue;
    }
    unknowns.each_lead(static_cast<int>(n), [&](const StaticUnknowns::Lead& lead) {
      sum[lead.row] += lead.share.transpose() * whole(own) * lead.share;
    });
  }
  element_blocks_.resize(sum.size());
  for (std::size_t n = 0; n < sum.size(); ++n) element_blocks_[n] = distinct(sum[n]);
  inverse_ = unset_array<double* [6]>("inverse blocks", sum.size());
  device_diagonal_ = unset_array<double*>("tangent diagonal", sum.size());
  inverse_on_host_ = Kokkos::create_mirror_view(inverse_);
  diagonal_ = Kokkos::create_mirror_view(device_diagonal_);
}

void StaticTangent::set_springs(const SpringCollector& springs, double shift) {
  shift_ = shift;
  tangent_.set_springs(springs);
  if (parts_ != nullptr) parts_->place(nodes_.position);
  // The elements' part of the few blocks that springs concern, to be put back.
  std::map<int, std::array<double, 6>> before;
  auto& blocks = element_blocks_;
  for (std::size_t s = 0; s < springs.count(); ++s)
    for (int k = springs.first()[s]; k < springs.first()[s + 1]; ++k) {
      const Eigen::Vector3d own(springs.share()[k].data());
      unknowns_.each_lead(springs.node()[k], [&](const StaticUnknowns::Lead& lead) {
        const Eigen::Vector3d d = lead.share.transpose() * own;
        const auto more = distinct(springs.stiffness()[s] * d * d.transpose());
        before.try_emplace(lead.row, blocks[lead.row]);
        for (int c = 0; c < 6; ++c) blocks[lead.row][c] += more[c];
      });
    }
  double least = 1e300;
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    diagonal_(n) = (blocks[n][0] + blocks[n][1] + blocks[n][2]) / 3;
    if (diagonal_(n) > 0) least = std::min(least, diagonal_(n));
  }
  on_host_threads(static_cast<int>(blocks.size()), [&](int n) {
    // A point mass that no spring holds, or a slave.
    if (!(diagonal_(n) > 0)) diagonal_(n) = least;
    Eigen::Matrix3d block = whole(blocks[n]) + shift * diagonal_(n) * Eigen::Matrix3d::Identity();
    const double* p = unknowns_.projection(n);
    Eigen::Matrix3d inverse;
    if (p == nullptr) {
      inverse = block.inverse();
    } else {
      const Eigen::Matrix3d P = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(p);
      block = P * block * P + diagonal_(n) * (Eigen::Matrix3d::Identity() - P);
      inverse = P * block.inverse() * P;
    }
    const auto values = distinct(inverse);
    for (int c = 0; c < 6; ++c) inverse_on_host_(n, c) = values[c];
  });
  for (const auto& [n, block] : before) blocks[n] = block;
  Kokkos::deep_copy(inverse_, inverse_on_host_);
  Kokkos::deep_copy(device_diagonal_, diagonal_);
}

void StaticTangent::apply(const NodeVector& u, const NodeVector& f) const {
  unknowns_.lead_slaves(u);
  if (parts_ == nullptr) {
    tangent_.apply(assembly_, stiffness_, nodes_.position, u, 0, f);
  } else {
    Kokkos::deep_copy(Kokkos::subview(f, std::pair(unknowns_.nodes(), unknowns_.rows()), Kokkos::ALL), 0.0);
    parts_->apply(u, f);
    tangent_.add_springs(u, 0, f);
  }
  unknowns_.pass_on(f);
  Kokkos::parallel_for("shift_and_hold", Range(0, unknowns_.rows()),
                       ShiftAndHold{u, f, device_diagonal_, shift_, unknowns_.held()});
}

}  // namespace railwave
