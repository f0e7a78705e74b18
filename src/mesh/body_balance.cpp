#include "mesh/body_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/hexahedron.hpp"

namespace railwave {
namespace {

/// Volume (m3) and its first moments (m4) along x and z.
using Amount = std::array<double, 3>;

Amount amount_of(const Mesh& mesh, const std::vector<int>& elements) {
  Amount sum{0, 0, 0};
  for (int e : elements) {
    const auto integrals = hexahedron_shape_integrals(corners_of(mesh.nodes, mesh.elements[e]));
    for (int N = 0; N < 8; ++N) {
      const Vec3& x = mesh.nodes[mesh.elements[e][N]];
      sum = {sum[0] + integrals[N], sum[1] + integrals[N] * x[0], sum[2] + integrals[N] * x[2]};
    }
  }
  return sum;
}

double determinant(const std::array<Amount, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
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

  void reach(const Amount& wanted) {
    const Amount others = amount_of(mesh_, others_), now = amount_of(mesh_, moved_);
    constexpr double steps[] = {0.1, 1e-4, 1e-4};
    std::array<Amount, 3> slope{};  // of each amplitude
    for (int k = 0; k < 3; ++k) {
      Amount amplitude{0, 0, 0};
      amplitude[k] = steps[k];
      move(amplitude);
      const Amount then = amount_of(mesh_, moved_);
      for (int i = 0; i < 3; ++i) slope[k][i] = (then[i] - now[i]) / steps[k];
    }
    Amount amplitude{0, 0, 0};
    for (int iteration = 0; iteration < 4; ++iteration) {
      move(amplitude);
      const Amount reached = amount_of(mesh_, moved_);
      Amount lacks{};
      for (int i = 0; i < 3; ++i) lacks[i] = wanted[i] - others[i] - reached[i];
      for (int k = 0; k < 3; ++k) {  // Cramer's rule
        auto replaced = slope;
        replaced[k] = lacks;
        amplitude[k] += determinant(replaced) / determinant(slope);
      }
    }
    if (!(move(amplitude) < 0.1)) mesh_.nodes = original_;
  }

 private:
  /// Returns the largest share of its distance by which a node moves; infinite if it is no number.
  double move(const Amount& amplitude) {
    double most = 0;
    for (std::size_t n = 0; n < original_.size(); ++n) {
      if (motion_.share[n] == 0) continue;
      const Vec3& x = original_[n];
      const double around = (amplitude[1] * x[0] + amplitude[2] * x[2]) / std::hypot(x[0], x[2]);
      const double growth = motion_.share[n] * (amplitude[0] * motion_.shape[n] + around), factor = 1 + growth;
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
  std::vector<int> all(mesh.elements.size());
  std::iota(all.begin(), all.end(), 0);
  return amount_of(mesh, all)[0];
}

}  // namespace railwave
