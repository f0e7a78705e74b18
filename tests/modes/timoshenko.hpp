#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "case/scene.hpp"

namespace railwave::verify {

/// A clamped-free beam of Timoshenko's.
struct Cantilever {
  double length, area, second_moment;  ///< m, m2, m4
  double shear_share;                  ///< Cowper's coefficient
  scene::Material material;

  /// Bending moment and shear force of the free end by those of the clamped one have a determinant that vanishes at
  /// each natural angular frequency. With y = (w, phi, M, V): w' = phi + V/(k G A), phi' = M/(E I), M' = -V - rho I
  /// omega^2 phi, V' = -rho A omega^2 w.
  double determinant(double omega) const {
    const double inertia = material.density * omega * omega;
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    a(0, 1) = 1;
    a(0, 3) = 1 / (shear_share * material.shear_modulus() * area);
    a(1, 2) = 1 / (material.youngs_modulus * second_moment);
    a(2, 1) = -inertia * second_moment;
    a(2, 3) = -1;
    a(3, 0) = -inertia * area;
    constexpr int halvings = 16;
    a *= length / (1 << halvings);
    Eigen::Matrix4d power = Eigen::Matrix4d::Identity() + a + a * a / 2 + a * a * a / 6;
    for (int k = 0; k < halvings; ++k) power = (power * power).eval();
    return power.block<2, 2>(2, 2).determinant();
  }

  /// Hz, the lowest ones.
  std::vector<double> frequencies(int count) const {
    std::vector<double> result;
    double low = 1, at_low = determinant(low);
    for (double high = low; static_cast<int>(result.size()) < count;) {
      high = low * 1.01;
      const double at_high = determinant(high);
      if (at_low * at_high < 0) {
        double a = low, b = high;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (a + b);
          (determinant(middle) * at_low > 0 ? a : b) = middle;
        }
        result.push_back(a / (2 * M_PI));
      }
      low = high;
      at_low = at_high;
    }
    return result;
  }
};

}  // namespace railwave::verify
