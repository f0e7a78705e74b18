#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "case/error.hpp"
#include "model/beams/beams.hpp"
#include "model/host_copy.hpp"
#include "model/time_step/tangent_springs.hpp"
#include "solve/statics/settle.hpp"

namespace railwave {

void refuse_drifting_points(const AssembledScene& assembled, const std::vector<ConnectorCell>& cells,
                            const std::shared_ptr<BeamModel>& beams, const NodeVector& unbalanced, double applied) {
  const auto residual = to_host(unbalanced);
  SpringCollector springs;
  springs.add_connectors(assembled.scene, cells);
  for (std::size_t k = 0; k < assembled.assembly.point_nodes.size(); ++k) {
    const int n = assembled.assembly.point_nodes[k];
    if (beams && beams->number[n] >= 0) continue;
    Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
    for (std::size_t s = 0; s < springs.count(); ++s)
      for (int j = springs.first()[s]; j < springs.first()[s + 1]; ++j)
        if (springs.node()[j] == n) {
          const Eigen::Vector3d d(springs.share()[j].data());
          held += springs.stiffness()[s] * d * d.transpose();
        }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(held);
    for (int m = 0; m < 3; ++m) {
      const Eigen::Vector3d direction = eigen.eigenvectors().col(m);
      const double force = direction.dot(Eigen::Vector3d(residual(n, 0), residual(n, 1), residual(n, 2)));
      if (eigen.eigenvalues()[m] > 1e-9 * eigen.eigenvalues()[2]) continue;
      if (std::fabs(force) <= assembled.scene.settle.tolerance * applied) continue;
      const scene::PointMass& point = assembled.scene.points[k];
      throw InputError(fmt::format(
          "{}:{}: [points.{}]: drifts away while the scene settles: {:.4g} N act on it along ({:.3g}, {:.3g}, {:.3g}), "
          "where no "
          "connector is stiff; give one a stiffness there, preload it by that force, or constrain the point",
          assembled.scene.path, point.line, point.name, std::fabs(force), direction[0], direction[1], direction[2]));
    }
  }
}

std::string what_drifts(const AssembledScene& assembled, const NodeVector& unbalanced, double applied) {
  const auto residual = to_host(unbalanced);
  std::string worst;
  double largest = assembled.scene.settle.tolerance * applied;
  const auto check = [&](const std::string& what, const std::vector<int>& nodes) {
    Vec3 sum{};
    for (int n : nodes)
      for (int i = 0; i < 3; ++i) sum[i] += residual(n, i);
    const double size = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    if (!(size > largest)) return;
    largest = size;
    worst = fmt::format(
        "{} is left with a force of ({:.4g}, {:.4g}, {:.4g}) N: nothing holds it along that, or it has not met "
        "what will",
        what, sum[0], sum[1], sum[2]);
  };
  for (const auto& part : assembled.assembly.parts) {
    std::vector<int> nodes(part.node_count);
    std::iota(nodes.begin(), nodes.end(), part.first_node);
    check("part '" + part.name + "'", nodes);
  }
  for (const Assembly::BeamChain& chain : assembled.assembly.beam_chains)
    check("a beam of '" + assembled.scene.beams[chain.beam].name + "'", chain.nodes);
  return worst;
}

}  // namespace railwave
