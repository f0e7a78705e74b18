#include "modes/stiffness_matrix.hpp"

#include "model/host_copy.hpp"

namespace railwave {
namespace {

/// J, of the mean strain and of the hourglass control.
struct ElementEnergy {
  double strain, hourglass;
};

/// V (mu |eps|^2 + lambda/2 tr^2), and k/2 times the squared hourglass content, see ElementStiffness.
ElementEnergy element_energy(const ElementStiffness& stiffness, const double (&x)[3][7], const double (&u)[3][7]) {
  double B[3][6], L[3][3];
  mean_gradient<double>(x, B);
  const double volume = along(x[0], B[0]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) L[i][j] = along(u[i], B[j]) / volume;
  double strain = 0, hourglass = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) strain += 0.25 * (L[i][j] + L[j][i]) * (L[i][j] + L[j][i]);
    for (int M = 0; M < 4; ++M) {
      const double content = hourglass_content(u[i], L[i], x, M);
      hourglass += content * content;
    }
  }
  const double trace = L[0][0] + L[1][1] + L[2][2];
  return {volume * (stiffness.mu * strain + 0.5 * stiffness.lambda * trace * trace),
          0.5 * stiffness.hourglass * std::cbrt(volume) * hourglass};
}

}  // namespace

StrainEnergy::StrainEnergy(const AssembledScene& assembled, const NodeArrays& nodes, const SpringCollector& springs)
    : assembly_(assembled.assembly),
      springs_(springs),
      stiffness_(mode_stiffness(assembled)),
      position_(to_host(nodes.position)) {}

std::vector<double> StrainEnergy::operator()(const Eigen::VectorXd& motion, std::vector<double>* hourglass) const {
  const auto& parts = assembly_.parts;
  std::vector<double> energy(parts.size() + 1, 0.0);
  if (hourglass) hourglass->assign(parts.size(), 0.0);
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (int e = parts[p].first_element; e < parts[p].first_element + parts[p].element_count; ++e) {
      double x[3][7], u[3][7];
      for (int i = 0; i < 3; ++i) {
        double place[8], moved[8];
        for (int N = 0; N < 8; ++N) {
          const int n = assembly_.elements[e][N];
          place[N] = position_(n, i);
          moved[N] = motion[3 * n + i];
        }
        modes_of(place, x[i]);
        modes_of(moved, u[i]);
      }
      const ElementEnergy own = element_energy(stiffness_[p], x, u);
      energy[p] += own.strain + own.hourglass;
      if (hourglass) (*hourglass)[p] += own.hourglass;
    }
  for (std::size_t s = 0; s < springs_.count(); ++s) {
    double stretch = 0;
    for (int k = springs_.first()[s]; k < springs_.first()[s + 1]; ++k)
      for (int i = 0; i < 3; ++i) stretch += springs_.share()[k][i] * motion[3 * springs_.node()[k] + i];
    energy.back() += 0.5 * springs_.stiffness()[s] * stretch * stretch;
  }
  return energy;
}

}  // namespace railwave
