#include "modes/modes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "case/error.hpp"
#include "model/beams/beams.hpp"
#include "modes/shifted_matrix.hpp"
#include "modes/stiffness_matrix.hpp"

namespace railwave {
namespace {

/// A motion whose frequency is below this share of the highest one asked for strains nothing but by rounding.
constexpr double rigid_share = 1e-5;

/// Kinetic energy at unit angular frequency, times two, of each part and, behind them, of all else.
std::vector<double> kinetic(const AssembledScene& assembled, const Eigen::VectorXd& motion, double total) {
  std::vector<double> result;
  for (const auto& part : assembled.assembly.parts) {
    double sum = 0;
    for (int n = part.first_node; n < part.first_node + part.node_count; ++n)
      sum += assembled.mass[n] * motion.segment<3>(3 * n).squaredNorm();
    result.push_back(sum);
  }
  result.push_back(std::max(0.0, total - std::accumulate(result.begin(), result.end(), 0.0)));
  return result;
}

}  // namespace

ModeList modes_below(const Model& model, double up_to) {
  tighten_beams(model.beams, model.nodes, true);
  const ModeUnknowns unknowns(StaticUnknowns(model, model.ties, model.ends, model.beams), model.nodes, model.beams);
  if (unknowns.count() == 0)
    throw InputError(
        "nothing can move: all nodes are held ([constraints], [prescribed_motion] and [non_reflecting] hold); free "
        "some, or name other parts by --part");
  const SpringCollector springs = mode_springs(model.scene, model.connectors.cells, model.beams, model.nodes);
  ShiftedMatrix matrix(stiffness_matrix(model, model.nodes, unknowns, springs), unknowns.mass(), unknowns.places());
  const double limit = std::pow(2 * M_PI * up_to, 2);
  const Eigenpairs pairs = eigenpairs_below(matrix, limit);

  const StrainEnergy strain(model, model.nodes, springs);
  std::vector<std::optional<RoundBody>> bodies;
  for (std::size_t p = 0; p < model.assembly.parts.size(); ++p)
    bodies.push_back(RoundBody::of_part(model, static_cast<int>(p)));
  ModeList list;
  list.unknowns = unknowns.count();
  list.factor_entries = matrix.entries_of_factor();
  list.solves = matrix.quality();
  const Eigen::VectorXd weight = unknowns.mass().cwiseSqrt().cwiseInverse();
  for (Eigen::Index k = 0; k < pairs.values.size(); ++k) {
    // Of unit modal mass.
    const Eigen::VectorXd motion = unknowns.motion(weight.cwiseProduct(pairs.vectors.col(k)));
    std::vector<double> hourglass;
    const auto energy = strain(motion, &hourglass);
    const double all = std::accumulate(energy.begin(), energy.end(), 0.0);
    Mode mode;
    mode.frequency = std::sqrt(2 * all) / (2 * M_PI);
    mode.rigid = mode.frequency < rigid_share * up_to;
    if (mode.rigid) mode.frequency = 0;
    if (!mode.rigid && !hourglass.empty()) {
      mode.hourglass_part = static_cast<int>(std::max_element(hourglass.begin(), hourglass.end()) - hourglass.begin());
      mode.hourglass_share = hourglass[mode.hourglass_part] / all;
    }
    const auto moving = kinetic(model, motion, 1);
    const int most = static_cast<int>(std::max_element(moving.begin(), moving.end()) - moving.begin());
    const bool of_part = most < static_cast<int>(model.assembly.parts.size());
    mode.part = of_part ? most : -1;
    mode.part_share = moving[most] / std::accumulate(moving.begin(), moving.end(), 0.0);
    if (of_part && bodies[most] && !mode.rigid) mode.round = bodies[most]->name(motion);
    mode.shape = motion.head(3 * unknowns.nodes());
    double largest = 0;
    for (int n = 0; n < unknowns.nodes(); ++n) largest = std::max(largest, mode.shape.segment<3>(3 * n).norm());
    if (largest > 0) mode.shape /= largest;
    mode.modal_mass = largest > 0 ? 1 / (largest * largest) : 0;
    list.modes.push_back(std::move(mode));
  }
  return list;
}

}  // namespace railwave
