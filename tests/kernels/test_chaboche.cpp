#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <vector>

#include "kernels/materials/chaboche.hpp"
#include "kernels/materials/kinematic_bilinear.hpp"
#include "tests/kernels/exact_kinematic.hpp"
#include "tests/kernels/material_path.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Matrix3 = Eigen::Matrix3d;

namespace {

/// So soft that elastic strains stay near 1e-6, where the series of the logarithm leaves out nothing that shows.
ChabocheConstants soft() { return {elastic_steel(), 0.1e6, 0.06e6, 8e4, 30e9, 2e5}; }

/// One direction: 3 mu (strain - plastic) = sign k(p) + back, each stretch of flow by its exact integral.
struct Uniaxial {
  ChabocheConstants constants;
  double flowed = 0, plastic = 0, back = 0, work = 0;

  double size_at(double p) const {
    return constants.yield_stress + constants.saturation * (1 - std::exp(-constants.rate * p));
  }
  double back_after(double sign, double dp) const {
    if (constants.recall == 0) return back + sign * constants.back_modulus * dp;
    const double end = sign * constants.back_modulus / constants.recall;
    return end + (back - end) * std::exp(-constants.recall * dp);
  }

  /// To a strain that is reached without turning. @return stress
  double go(double strain) {
    const double stiffness = 3 * constants.elastic.mu, trial = stiffness * (strain - plastic);
    const double sign = trial > back ? 1 : -1;
    const auto excess = [&](double dp) {
      return sign * (trial - sign * stiffness * dp - back_after(sign, dp)) - size_at(flowed + dp);
    };
    if (!(excess(0) > 0)) return trial;
    double low = 0, high = std::fabs(trial) / stiffness;
    for (int k = 0; k < 200; ++k) (excess(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
    const double dp = low;
    const int parts = 2000;  // of the work's integral
    for (int k = 0; k < parts; ++k) {
      const double at = (k + 0.5) * dp / parts;
      work += (size_at(flowed + at) + sign * back_after(sign, at)) * dp / parts;
    }
    back = back_after(sign, dp);
    flowed += dp;
    plastic += sign * dp;
    return trial - sign * stiffness * dp;
  }
};

/// H of the isochoric stretch by a logarithmic strain along x.
Matrix3 stretched(double strain) {
  return Eigen::Vector3d(-std::expm1(-strain), -std::expm1(0.5 * strain), -std::expm1(0.5 * strain)).asDiagonal();
}

struct Element {
  ChabocheConstants constants;
  Array<double*> history{"history", Chaboche::history_values* tile_width<float>};
  Matrix3 turn = Matrix3::Identity();

  template <class S = double>
  std::vector<Matrix3> follow(const std::vector<Matrix3>& path) const {
    Chaboche::OfBlock<S> block;
    block.constants = constants;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) block.turn[i][j] = static_cast<S>(turn(i, j));
    return follow_path<S>(Chaboche{{{history.data(), nullptr}}}, block, path);
  }
  template <class S = double>
  double value(int number) const {
    const auto host = Kokkos::create_mirror_view(history);
    Kokkos::deep_copy(host, history);
    return host(number * static_cast<long>(tile_width<S>));
  }
};

/// To and fro between turning points, in so many steps each way.
std::vector<double> strains(const std::vector<double>& turning, int steps) {
  std::vector<double> all;
  double from = 0;
  for (double to : turning) {
    for (int k = 1; k <= steps; ++k) all.push_back(from + (to - from) * k / steps);
    from = to;
  }
  return all;
}

const std::vector<double> cycle{8e-6, -8e-6, 6e-6, -2e-6, 1.2e-5};

struct Worst {
  double stress = 0, flowed = 0, work = 0;
};

template <class S>
Worst deviation(const ChabocheConstants& constants, int steps) {
  const Element element{constants};
  std::vector<Matrix3> path;
  for (double strain : strains(cycle, steps)) path.push_back(stretched(strain));
  const auto stress = element.follow<S>(path);
  Uniaxial exact{constants};
  Worst worst;
  std::size_t k = 0;
  for (std::size_t leg = 0; leg < cycle.size(); ++leg) {
    k += steps;
    const double expected = exact.go(cycle[leg]);
    const double sign = stress[k - 1](0, 0) > stress[k - 1](1, 1) ? 1 : -1;
    worst.stress = std::max(worst.stress, std::fabs(sign * mises(stress[k - 1]) - expected));
  }
  worst.stress /= constants.yield_stress;
  worst.flowed = std::fabs(element.template value<S>(Chaboche::plastic_strain) / exact.flowed - 1);
  worst.work = std::fabs(element.template value<S>(Chaboche::flow_work) / exact.work - 1);
  return worst;
}

}  // namespace

TEST_CASE("hardening that saturates: stretches to and fro follow the exact integrals, the closer the finer the steps") {
  const Worst coarse = deviation<double>(soft(), 40), fine = deviation<double>(soft(), 4000);
  INFO("coarse " << coarse.stress << ' ' << coarse.flowed << ' ' << coarse.work << ", fine " << fine.stress << ' '
                 << fine.flowed << ' ' << fine.work);
  CHECK(coarse.stress < 0.02);
  CHECK(fine.stress < 2e-4);
  CHECK(fine.flowed < 2e-4);
  CHECK(fine.work < 2e-4);
  const Worst single = deviation<float>(soft(), 400);
  INFO("single " << single.stress << ' ' << single.flowed << ' ' << single.work);
  CHECK(single.stress < 0.01);
}

TEST_CASE("surfaces that only grow, or only move, and one that softens, follow theirs") {
  ChabocheConstants growing = soft(), moving = soft(), softening = soft();
  growing.back_modulus = growing.recall = 0;
  moving.saturation = moving.rate = 0;
  softening.saturation = -0.04e6;
  for (const ChabocheConstants& constants : {growing, moving, softening}) {
    const Worst fine = deviation<double>(constants, 4000);
    INFO("stress " << fine.stress << ", flowed " << fine.flowed << ", work " << fine.work);
    CHECK(fine.stress < 3e-4);
    CHECK(fine.flowed < 3e-4);
    CHECK(fine.work < 3e-4);
  }
}

TEST_CASE("without recall and without saturation it is the bilinear law with a moving surface") {
  ChabocheConstants constants = soft();
  constants.saturation = constants.rate = constants.recall = 0;
  const Element element{constants};
  Array<double*> history("history", KinematicBilinear::history_values * tile_width<float>);
  KinematicBilinear::OfBlock<double> block;
  // C is d(back)/dp along the flow, as is (1 - beta) H.
  block.constants = {{constants.elastic, constants.yield_stress, constants.back_modulus}, 0};
  std::vector<Matrix3> path;
  for (double strain : strains(cycle, 500)) {
    Matrix3 H = stretched(strain);
    H(0, 1) = 0.7 * strain;  // and a shear, so that axes turn
    path.push_back(H);
  }
  const auto stress = element.follow(path);
  const auto expected = follow_path<double>(KinematicBilinear{{{history.data(), nullptr}}}, block, path);
  double worst = 0;
  for (std::size_t k = 0; k < path.size(); ++k)
    worst = std::max(worst, (stress[k] - expected[k]).norm() / constants.yield_stress);
  CHECK(worst < 1e-9);
}

TEST_CASE("between strains of unlike amplitude the law of Armstrong and Frederick ratchets, and saturates in size") {
  ChabocheConstants constants = soft();
  const Element element{constants};
  std::vector<Matrix3> path;
  for (int k = 0; k < 40; ++k)
    for (double strain : strains({1e-5, -1e-5, 0}, 200)) path.push_back(stretched(strain));
  const auto stress = element.follow(path);
  double largest = 0;
  for (const Matrix3& tau : stress) largest = std::max(largest, mises(tau));
  const double bound = constants.yield_stress + constants.saturation + constants.back_modulus / constants.recall;
  CHECK(largest < bound * 1.001);
  CHECK(largest > 0.9 * bound);
  CHECK(element.value(Chaboche::flow_work) > 0);
}
