#include "mesh/body_balance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/hexahedron.hpp"

namespace railwave {
namespace {

/// Volume (m3) and its first moments along x and z (m4).
using Moments = Eigen::Vector3d;

Moments moments_of(const Mesh& mesh, const std::vector<int>& elements) {
  Moments sum = Moments::Zero();
  for (int e : elements) {
    const auto integrals = hexahedron_shape_integrals(corners_of(mesh.nodes, mesh.elements[e]));
    for (int N = 0; N < 8; ++N) {
      const Vec3& x = mesh.nodes[mesh.elements[e][N]];
      sum[0] += integrals[N];
      sum[1] += integrals[N] * x[0];
      sum[2] += integrals[N] * x[2];
    }
  }
  return sum;
}

class Balancer {
 public:
  Balancer(Mesh& mesh, const RadialMotion& motion) : mesh_(mesh), motion_(motion), original_(mesh.nodes) {
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
      const auto& corners = mesh.elements[e];
      const bool moves = std::any_of(corners.begin(), corners.end(), [&](int n) { return motion.share[n] > 0; });
      (moves ? moved_ : others_).push_back(e);
    }
  }

  /// Newton's method with the Jacobian of the first iteration, by finite differences.
  void reach(const Moments& wanted) {
    const Moments others = moments_of(mesh_, others_), start = moments_of(mesh_, moved_);
    constexpr double steps[] = {0.1, 1e-4, 1e-4};
    Eigen::Matrix3d jacobian;  // a column for each amplitude
    for (int k = 0; k < 3; ++k) {
      move(steps[k] * Amplitudes::Unit(k));
      jacobian.col(k) = (moments_of(mesh_, moved_) - start) / steps[k];
    }
    const Eigen::PartialPivLU<Eigen::Matrix3d> factors(jacobian);  // singular: amplitudes are not finite
    Amplitudes amplitudes = Amplitudes::Zero();
    for (int iteration = 0; iteration < 4; ++iteration) {
      move(amplitudes);
      const Moments residual = wanted - others - moments_of(mesh_, moved_);
      amplitudes += factors.solve(residual);
    }
    if (!(move(amplitudes) < 0.1)) mesh_.nodes = original_;
  }

 private:
  using Amplitudes = Eigen::Vector3d;  ///< A, B, C of RadialMotion

  /// Returns the largest displacement of a node over its distance from the axis; infinity if one is not finite.
  double move(const Amplitudes& amplitudes) {
    double most = 0;
    for (std::size_t n = 0; n < original_.size(); ++n) {
      if (motion_.share[n] == 0) continue;
      const Vec3& x = original_[n];
      const double around = (amplitudes[1] * x[0] + amplitudes[2] * x[2]) / std::hypot(x[0], x[2]);
      const double growth = motion_.share[n] * (amplitudes[0] * motion_.shape[n] + around), factor = 1 + growth;
      mesh_.nodes[n] = {factor * x[0], x[1], factor * x[2]};
      most = std::isfinite(growth) ? std::max(most, std::fabs(growth)) : std::numeric_limits<double>::infinity();
    }
    return most;
  }

  Mesh& mesh_;
  const RadialMotion& motion_;
  const std::vector<Vec3> original_;
  std::vector<int> moved_, others_;  ///< elements
};

}  // namespace

void balance_body(Mesh& mesh, const RadialMotion& motion, double volume) {
  Balancer(mesh, motion).reach({volume, 0, 0});
}

double mesh_volume(const Mesh& mesh) {
  double volume = 0;
  for (const auto& element : mesh.elements)
    for (double part : hexahedron_shape_integrals(corners_of(mesh.nodes, element))) volume += part;
  return volume;
}

}  // namespace railwave
