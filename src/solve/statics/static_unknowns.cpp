#include "solve/statics/static_unknowns.hpp"

#include <Eigen/Geometry>

#include "model/host_copy.hpp"

namespace railwave {
namespace {

Eigen::Vector3d vector(const Vector3& a) { return {a[0], a[1], a[2]}; }

/// What a master's corner has to do with its slave's motion, see TieMotion.
Eigen::Matrix3d share_of(const TiedPlace& tied, int corner, const Array<double* [3]>::HostMirror& position) {
  Eigen::Matrix3d share = tied.weight[corner] * Eigen::Matrix3d::Identity();
  if (tied.distance == 0) return share;
  const Eigen::Vector3d along = vector(tied.sum(tied.slope_xi, position)),
                        across = vector(tied.sum(tied.slope_eta, position));
  const Eigen::Vector3d area = along.cross(across), n = area.normalized();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(i);
    const Eigen::Vector3d turned =
        tied.slope_xi[corner] * unit.cross(across) + tied.slope_eta[corner] * along.cross(unit);
    share.col(i) += tied.distance / area.norm() * (turned - n.dot(turned) * n);
  }
  return share;
}

template <class Table>
std::vector<std::array<double, 9>> rows_of(const Table& device) {
  const auto host = to_host(device);
  std::vector<std::array<double, 9>> rows(host.extent(0));
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (int k = 0; k < 9; ++k) rows[r][k] = host(r, k / 3, k % 3);
  return rows;
}

}  // namespace

StaticUnknowns::StaticUnknowns(const NodalState& nodal, const Ties& ties, const NonReflectingEnds& ends,
                               const std::shared_ptr<BeamModel>& beams)
    : nodes_(nodal.nodes), ties_(ties.arrays), beams_(beams.get()), rows_(nodal.nodes.count) {
  if (beams_ != nullptr) rows_ += beams_->arrays.node_count;
  hold(nodal, ends);
  slave_.assign(rows_, -1);
  const auto position = to_host(nodes_.position);
  for (const TiedPlace& tied : ties.places) {
    slave_[tied.slave] = static_cast<int>(leads_.size());
    auto& leads = leads_.emplace_back();
    for (int k = 0; k < 4; ++k) leads[k] = {tied.face[k], share_of(tied, k, position)};
  }
}

void StaticUnknowns::hold(const NodalState& nodal, const NonReflectingEnds& ends) {
  row_of_ = to_vector(nodes_.constraint);
  row_of_.resize(rows_, -1);
  table_ = rows_of(nodal.constraints);
  if (!ends.nodes.empty()) {
    for (int n : ends.nodes) row_of_[n] = static_cast<int>(table_.size());
    table_.push_back({});
  }
  if (beams_ != nullptr) {
    const auto of_rotations = to_vector(beams_->arrays.constraint);
    const int first = static_cast<int>(table_.size());
    for (std::size_t b = 0; b < of_rotations.size(); ++b)
      if (of_rotations[b] >= 0) row_of_[nodes() + b] = first + of_rotations[b];
    for (const auto& row : rows_of(beams_->arrays.projections)) table_.push_back(row);
  }
  held_.row = to_device("static constraint of row", row_of_);
  held_.projections = unset_array<double* [3][3]>("static constraints", table_.size());
  const auto host = Kokkos::create_mirror_view(held_.projections);
  for (std::size_t r = 0; r < table_.size(); ++r)
    for (int k = 0; k < 9; ++k) host(r, k / 3, k % 3) = table_[r][k];
  Kokkos::deep_copy(held_.projections, host);
}

std::vector<Vec3> StaticUnknowns::positions() const {
  const auto position = to_host(nodes_.position);
  std::vector<Vec3> all(rows_);
  for (int n = 0; n < nodes(); ++n) all[n] = {position(n, 0), position(n, 1), position(n, 2)};
  if (beams_ == nullptr) return all;
  const auto node = to_vector(beams_->arrays.node);
  for (std::size_t b = 0; b < node.size(); ++b) all[nodes() + b] = all[node[b]];
  return all;
}

void StaticUnknowns::lead_slaves(const NodeVector& motion) const {
  if (ties_.active())
    Kokkos::parallel_for("static_ties", SpreadRange(0, ties_.slave_count), TieMotion{ties_, nodes_.position, motion});
}

void StaticUnknowns::pass_on(const NodeVector& force) const {
  if (!ties_.active()) return;
  Kokkos::parallel_for("static_tie_force", SpreadRange(0, ties_.slave_count),
                       TieMotionForce{ties_, nodes_.position, force});
  Kokkos::parallel_for("static_tie_gather", SumTeams(3 * ties_.master_count, threads_of_sum),
                       TieGather{ties_, ties_.master_nodes, force});
}

}  // namespace railwave
