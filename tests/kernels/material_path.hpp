#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <vector>

#include "kernels/materials/bilinear.hpp"
#include "kernels/materials/elastic.hpp"

namespace railwave {

/// Of the steel that materials are tested with.
inline constexpr double youngs_modulus = 210e9, poissons_ratio = 0.3;

inline ElasticConstants elastic_steel() {
  const double mu = youngs_modulus / (2 * (1 + poissons_ratio));
  return {2 * mu * poissons_ratio / (1 - 2 * poissons_ratio), mu};
}

inline BilinearConstants steel(double yield_stress, double tangent_modulus) {
  return {elastic_steel(), yield_stress, hardening_modulus(youngs_modulus, tangent_modulus)};
}

inline Eigen::Matrix3d rotation(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Equivalent stress of von Mises.
inline double mises(const Eigen::Matrix3d& tau) {
  return std::sqrt(1.5) * (tau - Eigen::Matrix3d::Identity() * tau.trace() / 3).norm();
}

/// Gradients over a time from 0 to 1.
using Motion = std::function<Eigen::Matrix3d(double)>;

inline std::vector<Eigen::Matrix3d> sampled(const Motion& motion, int steps) {
  std::vector<Eigen::Matrix3d> path;
  for (int k = 1; k <= steps; ++k) path.push_back(motion(static_cast<double>(k) / steps));
  return path;
}

/// Takes one batch of elements, all lanes alike, along a path.
template <class S, class Material>
struct MaterialPath {
  Material material;
  typename Material::template OfBlock<S> block;
  Array<const double* [3][3]> path;  ///< displacement gradients along present coordinates
  Array<S*> stress;                  ///< tiled, 6 values an instant

  KOKKOS_INLINE_FUNCTION void operator()(const int batch) const {
    for (int k = 0; k < static_cast<int>(path.extent(0)); ++k) {
      Pack<S> H[3][3], e[6], tau[6];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[i][j] = static_cast<S>(path(k, i, j));
      almansi_strain<S>(H, e);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[i][j] = (i == j ? S(1) : S(0)) - H[i][j];
      material.template stress<S>(block, batch, H, e, tau);
      for (int c = 0; c < 6; ++c) store<S>(stress.data() + (6l * k + c) * tile_width<S>, tau[c]);
    }
  }
};

/// Kirchhoff stresses of the first element along a path of displacement gradients H, F = (I - H)^-1.
template <class S, class Material>
std::vector<Eigen::Matrix3d> follow_path(const Material& material, const typename Material::template OfBlock<S>& block,
                                         const std::vector<Eigen::Matrix3d>& path) {
  const Array<double* [3][3]> gradient("path", path.size());
  const auto host = Kokkos::create_mirror_view(gradient);
  for (std::size_t k = 0; k < path.size(); ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) host(k, i, j) = path[k](i, j);
  Kokkos::deep_copy(gradient, host);
  const Array<S*> stress("stress", 6 * tile_width<S> * path.size());
  Kokkos::parallel_for("material_path", Range(0, 1), MaterialPath<S, Material>{material, block, gradient, stress});
  const auto values = Kokkos::create_mirror_view(stress);
  Kokkos::deep_copy(values, stress);
  std::vector<Eigen::Matrix3d> result(path.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto at = [&](int c) { return static_cast<double>(values((6 * k + c) * tile_width<S>)); };
    result[k] << at(0), at(3), at(5), at(3), at(1), at(4), at(5), at(4), at(2);
  }
  return result;
}

}  // namespace railwave
