#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <vector>

#include "kernels/elements/element_force.hpp"
#include "kernels/materials/bilinear.hpp"
#include "tests/kernels/exact_plasticity.hpp"
#include "tests/kernels/material_path.hpp"

using namespace railwave;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double yield_stress = 500e6;

/// The constants of one element, and its history.
struct Element {
  BilinearConstants constants;
  Array<double*> history;
  Matrix turn = Matrix::Identity();
};

Element material(const BilinearConstants& constants) {
  return {constants, Array<double*>("history", Bilinear::history_values * tile_width<float>)};
}

/// Takes one batch of elements along a path, each lane by its share of the gradient.
template <class S>
struct FollowPath {
  Bilinear material;
  Bilinear::OfBlock<S> block;
  bool plastic;
  Array<const double* [3][3]> path;  ///< displacement gradients along present coordinates
  Array<const S*> share;             ///< by lane
  Array<S*> stress;                  ///< tiled, 6 values an instant

  KOKKOS_INLINE_FUNCTION void operator()(const int batch) const {
    const Pack<S> share_of_lane = load<S>(share.data());
    for (int k = 0; k < static_cast<int>(path.extent(0)); ++k) {
      Pack<S> H[3][3], e[6], tau[6];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[i][j] = share_of_lane * static_cast<S>(path(k, i, j));
      almansi_strain<S>(H, e);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) H[i][j] = (i == j ? S(1) : S(0)) - H[i][j];
      if (plastic)
        material.template stress<S>(block, batch, H, e, tau);
      else
        Elastic::stress<S>(block.constants.elastic, batch, H, e, tau);
      for (int c = 0; c < 6; ++c) store<S>(stress.data() + (6l * k + c) * tile_width<S>, tau[c]);
    }
  }
};

/// The first lane has the whole gradient, the last one the least share.
double lane_share(int lane, int lanes, double least) { return 1 - (1 - least) * lane / std::max(1, lanes - 1); }

/// Kirchhoff stresses along a path of deformation gradients.
template <class S = double>
std::vector<Matrix> follow(const Element& element, const std::vector<Matrix>& path, bool plastic = true,
                           double least_share = 1) {
  Array<double* [3][3]> gradient("path", path.size());
  const auto host = Kokkos::create_mirror_view(gradient);
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Matrix H = Matrix::Identity() - path[k].inverse();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) host(k, i, j) = H(i, j);
  }
  Kokkos::deep_copy(gradient, host);
  const Array<S*> stress("stress", 6 * tile_width<S> * path.size());
  const Array<S*> share("share", tile_width<S>);
  const auto shares = Kokkos::create_mirror_view(share);
  for (int lane = 0; lane < tile_width<S>; ++lane)
    shares(lane) = static_cast<S>(lane_share(lane, tile_width<S>, least_share));
  Kokkos::deep_copy(share, shares);
  Bilinear::OfBlock<S> block;
  block.constants = element.constants;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block.turn[i][j] = static_cast<S>(element.turn(i, j));
  Kokkos::parallel_for("follow_path", Range(0, 1),
                       FollowPath<S>{{{element.history.data(), nullptr}}, block, plastic, gradient, share, stress});
  const auto values = Kokkos::create_mirror_view(stress);
  Kokkos::deep_copy(values, stress);
  std::vector<Matrix> result(path.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto at = [&](int c) { return static_cast<double>(values((6 * k + c) * tile_width<S>)); };
    result[k] << at(0), at(3), at(5), at(3), at(1), at(4), at(5), at(4), at(2);
  }
  return result;
}

/// The first element's history.
std::vector<double> history_of(const Element& bilinear, int tile = tile_width<double>) {
  const auto host = Kokkos::create_mirror_view(bilinear.history);
  Kokkos::deep_copy(host, bilinear.history);
  std::vector<double> values;
  for (int c = 0; c < Bilinear::history_values; ++c) values.push_back(host(c * static_cast<long>(tile)));
  return values;
}

double plastic_volume(const Element& bilinear) {
  const std::vector<double> p = history_of(bilinear);
  Matrix metric;
  metric << p[0], p[3], p[5], p[3], p[1], p[4], p[5], p[4], p[2];
  return (Matrix::Identity() + 2 * metric).determinant();
}

Matrix stretch(double a, double b, double c) {
  return Eigen::Vector3d(std::exp(a), std::exp(b), std::exp(c)).asDiagonal();
}

Matrix shear(double angle) {
  Matrix F = Matrix::Identity();
  F(0, 1) = angle;
  return F;
}

/// Shear and stretches out of phase, so that the flow turns all the time; volume changes by 0.2 %.
Matrix winding(double t) {
  const double phase = 2 * M_PI * t, a = 0.02 * (1 - std::cos(phase)), b = -0.01 * std::sin(2 * phase);
  return shear(0.03 * std::sin(phase)) * stretch(a, b, 0.002 * t - a - b);
}

/// The kernel's series in the elastic strain e, overshoot of a step included, leaves out 4/3 e^2 of the stress and 4
/// e^2 of the flow.
double series_error(double elastic_strain) { return 6 * elastic_strain * elastic_strain; }

/// Checks stress and equivalent plastic strain along a path against the spectral reference.
void check_path(const BilinearConstants& constants, const std::vector<Matrix>& path) {
  const Element bilinear = material(constants);
  const std::vector<Matrix> stress = follow(bilinear, path);
  SpectralPlasticity reference{constants};
  double worst = 0, largest = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Matrix exact = reference.stress(path[k]);
    worst = std::max(worst, (stress[k] - exact).norm());
    largest = std::max(largest, exact.norm());
  }
  const double hardened = constants.hardening * reference.equivalent, flow_stress = constants.yield_stress + hardened;
  const double step = (path[1] - path[0]).norm(), volume = 0.002;
  const double share = series_error(flow_stress / (3 * constants.elastic.mu) + volume / 3 + step);
  CHECK(reference.equivalent > 0.05);
  CHECK_THAT(history_of(bilinear)[6], WithinRel(reference.equivalent, share));
  CHECK(worst < share * (largest + hardened));
  CHECK_THAT(plastic_volume(bilinear), WithinAbs(1, 1e-12));
}

}  // namespace

TEST_CASE("under uniaxial stress the material follows its two slopes, forth and back") {
  const BilinearConstants constants = steel(yield_stress, 5e9);
  // The lateral strain that keeps the lateral stress zero: -nu times the elastic part, -1/2 times the plastic one.
  double plastic = 0, equivalent = 0;
  std::vector<Matrix> path;
  std::vector<double> exact;
  const double turns[] = {0, 0.03, -0.02, 0.01};
  for (int leg = 0; leg < 3; ++leg)
    for (int k = 1; k <= 1000; ++k) {
      const double strain = turns[leg] + (turns[leg + 1] - turns[leg]) * k / 1000;
      const double trial = youngs_modulus * (strain - plastic), limit = yield_stress + constants.hardening * equivalent;
      if (std::fabs(trial) > limit) {
        const double increment = (std::fabs(trial) - limit) / (youngs_modulus + constants.hardening);
        plastic += std::copysign(increment, trial);
        equivalent += increment;
      }
      exact.push_back(youngs_modulus * (strain - plastic));
      const double lateral = -poissons_ratio * (strain - plastic) - 0.5 * plastic;
      path.push_back(stretch(strain, lateral, lateral));
    }
  const Element bilinear = material(constants);
  const std::vector<Matrix> stress = follow(bilinear, path);
  double worst = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Matrix expected = Eigen::Vector3d(exact[k], 0, 0).asDiagonal();
    worst = std::max(worst, (stress[k] - expected).norm() / yield_stress);
  }
  const double flow_stress = yield_stress + constants.hardening * equivalent,
               share = series_error(flow_stress / youngs_modulus);
  CHECK(worst < share * flow_stress / yield_stress);
  CHECK_THAT(history_of(bilinear)[6], WithinRel(equivalent, share));
  // The slope beyond yield is the tangent modulus.
  CHECK_THAT((stress[900](0, 0) - stress[500](0, 0)) / (0.03 * 0.4), WithinRel(5e9, 1e-3));
}

TEST_CASE("pure shear strain far beyond yield follows the exact law, without hardening too") {
  for (const double tangent : {0.0, 2e9}) {
    const BilinearConstants constants = steel(yield_stress, tangent);
    const Element bilinear = material(constants);
    const int steps = 1000;
    const auto stress = follow(bilinear, sampled([](double t) { return stretch(0.5 * t, -0.5 * t, 0); }, steps));
    double worst = 0;
    for (int k = 1; k <= steps; ++k) {
      const double strain = 2 / std::sqrt(3.0) * 0.5 * k / steps, mu = constants.elastic.mu;
      const double plastic = std::max(0.0, (3 * mu * strain - yield_stress) / (3 * mu + constants.hardening));
      const double exact = 3 * mu * (strain - plastic);
      worst =
          std::max(worst, std::fabs(mises(stress[k - 1]) / exact - 1) / series_error(strain - plastic + 0.6 / steps));
    }
    CHECK(worst < 1);
    CHECK_THAT(plastic_volume(bilinear), WithinAbs(1, 1e-12));
  }
}

TEST_CASE("stress along winding paths is that of the spectral return map") {
  const auto back_and_forth = sampled([](double t) { return shear(std::sin(7 * t)); }, 8000);
  for (const double tangent : {0.0, 2e9, 10e9}) check_path(steel(yield_stress, tangent), sampled(winding, 4000));
  for (const double tangent : {0.0, 2e9}) check_path(steel(yield_stress, tangent), back_and_forth);
  BilinearConstants soft = steel(yield_stress, 0);
  soft.yield_stress = 0.1 * yield_stress;
  check_path(soft, sampled(winding, 40000));
  check_path(soft, sampled([](double t) { return shear(std::sin(7 * t)); }, 40000));
}

TEST_CASE("at small strain the return converges to the integrated rate equations") {
  const BilinearConstants constants = steel(yield_stress, 10e9);
  Matrix tension = Matrix::Zero(), twist = Matrix::Zero();
  tension.diagonal() << 0.004, -0.002, -0.002;
  twist(0, 1) = twist(1, 0) = 0.004;
  RatePlasticity exact{constants};
  const Matrix legs[] = {tension, twist, -0.5 * tension, -twist};
  for (const Matrix& leg : legs) exact.go(leg, 4000);
  const auto deviation = [&](int steps) {
    std::vector<Matrix> path;
    Matrix strain = Matrix::Zero();
    for (const Matrix& leg : legs)
      for (int k = 0; k < steps; ++k) {
        strain += leg / steps;
        // Logarithmic strain exactly.
        const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(strain);
        const Eigen::Vector3d stretches = spectrum.eigenvalues().array().exp();
        path.push_back(spectrum.eigenvectors() * stretches.asDiagonal() * spectrum.eigenvectors().transpose());
      }
    const Matrix tau = follow(material(constants), path).back();
    return (tau - Matrix::Identity() * tau.trace() / 3 - exact.stress).norm() / yield_stress;
  };
  const double coarse = deviation(25), fine = deviation(400);
  INFO("25 steps a leg: " << coarse << ", 400: " << fine);
  CHECK(fine < 3e-3);
  CHECK(coarse < 4e-2);
}

TEST_CASE("a turning body has the same stress, turned") {
  const int steps = 1500;
  const Element still = material(steel(yield_stress, 5e9)), turning = material(steel(yield_stress, 5e9));
  const auto turned_by = [](double t) {
    return Matrix(rotation(9 * t, {1, 2, -0.5}) * rotation(4 * t * t, {0, 1, 1}));
  };
  const auto stress = follow(still, sampled(winding, steps));
  const auto turned = follow(turning, sampled([&](double t) { return Matrix(turned_by(t) * winding(t)); }, steps));
  double worst = 0;
  for (int k = 0; k < steps; ++k) {
    const Matrix Q = turned_by(static_cast<double>(k + 1) / steps);
    worst = std::max(worst, (turned[k] - Q * stress[k] * Q.transpose()).norm() / yield_stress);
  }
  CHECK(worst < 1e-10);
  for (int c = 0; c < 7; ++c) CHECK_THAT(history_of(turning)[c], WithinAbs(history_of(still)[c], 1e-12));
}

TEST_CASE("below yield the stress is the elastic material's") {
  const auto path = sampled(
      [](double t) {
        return Matrix(rotation(3 * t, {1, 1, 2}) * shear(0.002 * t) * stretch(0.001 * t, 0, 0));
      },
      500);
  const BilinearConstants constants = steel(yield_stress, 5e9);
  const Element bilinear = material(constants);
  const auto plastic = follow(bilinear, path), elastic = follow(bilinear, path, false);
  // Bit by bit but where a compiler fuses multiplications and additions differently in the two.
  double worst = 0;
  for (std::size_t k = 0; k < path.size(); ++k)
    worst = std::max(worst, (plastic[k] - elastic[k]).norm() / elastic[k].norm());
  CHECK(worst < 1e-15);
  CHECK(mises(plastic.back()) < yield_stress);
  CHECK(history_of(bilinear) == std::vector<double>(7, 0.0));
}

TEST_CASE("a hundred thousand yielding steps end where a few end") {
  const BilinearConstants constants = steel(yield_stress, 0);
  const Motion straight = [](double t) { return stretch(0.3 * t, -0.2 * t, -0.1 * t); };
  // The direction is fixed, so the law can be written down: the strain's own measure less the elastic part.
  const Eigen::Vector3d strain(0.3, -0.2, -0.1);
  const double elastic = yield_stress / (3 * constants.elastic.mu),
               exact = std::sqrt(2.0 / 3.0) * strain.norm() - elastic;
  const Matrix exact_stress = (std::sqrt(2.0 / 3.0) * yield_stress / strain.norm() * strain).asDiagonal();
  for (const int steps : {1000, 100000}) {
    const Element bilinear = material(constants);
    const Matrix stress = follow(bilinear, sampled(straight, steps)).back();
    const double share = series_error(elastic + 0.3 / steps);
    CHECK((stress - exact_stress).norm() / yield_stress < share);
    CHECK_THAT(history_of(bilinear)[6], WithinRel(exact, share));
    CHECK_THAT(plastic_volume(bilinear), WithinAbs(1, 1e-12));
  }
}

TEST_CASE("held on the yield surface for a hundred thousand steps nothing flows") {
  const Element bilinear = material(steel(yield_stress, 0));
  std::vector<Matrix> path = sampled(winding, 300);
  path.resize(200);
  path.push_back(path.back());
  const Matrix start = follow(bilinear, path).back();
  const std::vector<double> before = history_of(bilinear);
  CHECK_THAT(mises(start), WithinRel(yield_stress, 1e-6));
  const Matrix end = follow(bilinear, std::vector<Matrix>(100000, path.back())).back();
  CHECK((end - start).norm() / yield_stress < 1e-9);
  for (int c = 0; c < 7; ++c) CHECK_THAT(history_of(bilinear)[c], WithinAbs(before[c], 1e-12));
}

TEST_CASE("a hundred thousand steps around a loop do not ratchet the pressure") {
  const Element bilinear = material(steel(yield_stress, 0));
  const Motion loop = [](double t) {
    const double phase = 2 * M_PI * 100 * t;
    return Matrix(rotation(20 * t, {0, 1, 0}) * shear(0.01 * std::sin(phase)) *
                  stretch(0.004 * std::cos(phase), -0.004 * std::cos(phase), 0));
  };
  const auto path = sampled(loop, 100000);
  const auto stress = follow(bilinear, path);
  const double bulk = youngs_modulus / (3 * (1 - 2 * poissons_ratio));
  double worst = 0;
  for (std::size_t k = 0; k < path.size(); ++k)
    worst = std::max(worst, std::fabs(stress[k].trace() / 3 - bulk * std::log(path[k].determinant())) / yield_stress);
  INFO("equivalent plastic strain " << history_of(bilinear)[6]);
  CHECK(worst < 1e-4);
  CHECK_THAT(plastic_volume(bilinear), WithinAbs(1, 1e-12));
}

TEST_CASE("plastic work is never negative and is what the stress did") {
  const BilinearConstants constants = steel(yield_stress, 8e9);
  const Element bilinear = material(constants);
  const int steps = 20000;
  const auto path = sampled(winding, steps);
  const auto stress = follow(bilinear, path);
  // Work of the Kirchhoff stress on the rate of deformation, by the trapezoidal rule.
  double work = 0, equivalent_before = 0;
  for (int k = 1; k < steps; ++k) {
    const Matrix middle = 0.5 * (path[k] + path[k - 1]);
    const Matrix L = (path[k] - path[k - 1]) * middle.inverse();
    work += (0.5 * (stress[k] + stress[k - 1])).cwiseProduct(0.5 * (L + L.transpose())).sum();
  }
  SpectralPlasticity reference{constants};
  for (const Matrix& F : path) {
    reference.stress(F);
    CHECK(reference.equivalent >= equivalent_before);
    equivalent_before = reference.equivalent;
  }
  const double equivalent = history_of(bilinear)[6];
  const double dissipated = (constants.yield_stress + 0.5 * constants.hardening * equivalent) * equivalent;
  const Matrix& tau = stress.back();
  const double mean = tau.trace() / 3, mu = constants.elastic.mu, bulk = constants.elastic.lambda + 2 * mu / 3;
  const double stored = mises(tau) * mises(tau) / (6 * mu) + mean * mean / (2 * bulk);
  CHECK(dissipated > 0);
  const double share = series_error((constants.yield_stress + constants.hardening * equivalent) / (3 * mu));
  CHECK_THAT(dissipated + stored, WithinRel(work, share));
  CHECK_THAT(dissipated, WithinRel(reference.work, share));
}

TEST_CASE("numbers of type float follow the same path") {
  const auto path = sampled(winding, 2000);
  const auto exact = follow(material(steel(yield_stress, 5e9)), path);
  const auto deviation = [&](const std::vector<Matrix>& stress) {
    double worst = 0;
    for (std::size_t k = 0; k < path.size(); ++k) worst = std::max(worst, (stress[k] - exact[k]).norm() / yield_stress);
    return worst;
  };
  CHECK(deviation(follow<float>(material(steel(yield_stress, 5e9)), path)) < 1e-3);
}

TEST_CASE("the turn that single precision leaves out of the gradient may change from step to step") {
  const auto path = sampled(winding, 800);
  const auto exact = follow<double>(material(steel(yield_stress, 5e9)), path);
  Element turned = material(steel(yield_stress, 5e9));
  double worst = 0;
  for (int leg = 0; leg < 4; ++leg) {
    const Matrix R = rotation(0.9 * leg, {1, -2, 0.7});
    turned.turn = R;
    // The gradient of x - R X is I - R F^-1, the one that F R^T has.
    std::vector<Matrix> relative;
    for (int k = 200 * leg; k < 200 * (leg + 1); ++k) relative.push_back(path[k] * R.transpose());
    const auto stress = follow<float>(turned, relative);
    for (int k = 0; k < 200; ++k) worst = std::max(worst, (stress[k] - exact[200 * leg + k]).norm() / yield_stress);
  }
  // H is of order 1 here, not small as in a run: rounding of 1e-7 over a yield strain of 2e-3.
  CHECK(worst < 2e-3);
}

TEST_CASE("each lane flows by itself") {
  const BilinearConstants constants = steel(yield_stress, 5e9);
  const int lanes = tile_width<double>;
  const auto path = sampled([](double t) { return shear(0.02 * t); }, 200);
  const Element batch = material(constants);
  follow<double>(batch, path, true, 0);
  // A GPU's batch is one element.
  for (int lane = 0; lane < lane_count<double>; ++lane) {
    const double share = lane_share(lane, lanes, 0);
    std::vector<Matrix> alone_path;
    for (const Matrix& F : path)
      alone_path.push_back((Matrix::Identity() - share * (Matrix::Identity() - F.inverse())).inverse());
    const Element alone = material(constants);
    follow<double>(alone, alone_path);
    const auto host = Kokkos::create_mirror_view(batch.history);
    Kokkos::deep_copy(host, batch.history);
    for (int c = 0; c < Bilinear::history_values; ++c) {
      INFO("lane " << lane << ", value " << c);
      CHECK_THAT(host(c * lanes + lane), WithinAbs(history_of(alone)[c], 1e-14));
    }
    if (share * 0.02 / std::sqrt(3.0) < 0.9 * yield_stress / (3 * constants.elastic.mu))
      CHECK(history_of(alone)[6] == 0);
  }
}
