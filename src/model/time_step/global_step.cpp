#include "model/time_step/global_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "kernels/support/reductions.hpp"
#include "kernels/ties/tie.hpp"
#include "model/elements/hourglass_scale.hpp"
#include "model/host_copy.hpp"
#include "model/time_step/estimate_share.hpp"
#include "model/time_step/stable_step.hpp"
#include "model/time_step/tangent_springs.hpp"

namespace railwave {
namespace {

/// Iterations between checks of the Ritz value.
constexpr int iterations_between_checks = 10;
/// Iterations before which a low Ritz value is not believed.
constexpr int least_iterations = 30;

/// Between -1 and 1, without order from place to place, yet continuous: rounding in a place hardly counts. No plane or
/// axis of a scene is one of its planes or axes.
/// @param x m
/// @param direction 0, 1, 2: each has values of its own
/// @param shift so has each shift, rad
KOKKOS_INLINE_FUNCTION double scattered(const Vector3& x, int direction, double shift) {
  // Waves of about 1 mm, so many times over again that nodes 1 um apart still differ.
  const double wave = 5077.1 * x[0] + 6411.7 * x[1] + 7933.3 * x[2];
  return std::sin(300 * std::sin(wave + shift + 0.7 + 1.1 * direction));
}

/// M^(1/2) times scattered numbers, so that ToWeighted leaves the start vector of unit mass. They are by places, so
/// that the step does not depend on how a mesh is numbered. The place is a little inside the node's elements: nodes of
/// two bodies that lie on one another differ.
struct StartVector {
  NodeVector f;
  Array<const double*> mass;
  Array<const double* [3]> reference;
  Array<const int*> first_corner, corner;  ///< see GatherTangent
  Array<const int* [8]> corners;
  int end;  ///< one more than the number of the scene's last node, as `n` counts

  KOKKOS_INLINE_FUNCTION Vector3 middle_of_elements(int n) const {
    Vector3 sum{{0, 0, 0}};
    for (int k = first_corner(n); k < first_corner(n + 1); ++k)
      for (int N = 0; N < 8; ++N) sum = sum + row(reference, corners(corner(k) / 8, N));
    return (0.125 / (first_corner(n + 1) - first_corner(n))) * sum;
  }

  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const bool of_elements = first_corner(n + 1) > first_corner(n);
    Vector3 x = row(reference, n);
    if (of_elements) x = 0.7 * x + 0.3 * middle_of_elements(n);
    // Point masses, of which many may lie at one place, and nodes inside beams are the last, in the case's order.
    const double shift = of_elements ? 0 : end - n;
    for (int i = 0; i < 3; ++i) f(n, i) = std::sqrt(mass(n)) * scattered(x, i, shift);
  }
};

/// w - alpha q - beta p
struct Recur {
  NodeVector w, q, p;
  const double *alpha, *squared_beta;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const double beta = std::sqrt(*squared_beta);
    for (int i = 0; i < 3; ++i) w(n, i) -= *alpha * q(n, i) + beta * p(n, i);
  }
};

/// To unit length.
struct Scale {
  NodeVector w;
  const double* squared_length;
  KOKKOS_INLINE_FUNCTION void operator()(const int n) const {
    const double factor = 1 / std::sqrt(*squared_length);
    for (int i = 0; i < 3; ++i) w(n, i) *= factor;
  }
};

}  // namespace

RitzValue largest_ritz_value(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  const Eigen::VectorXd along = Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size);
  const Eigen::VectorXd off = Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(along, off);
  const Eigen::Index last = size - 1;
  return {solver.eigenvalues()[last], beside.back() * std::fabs(solver.eigenvectors()(last, last))};
}

GlobalEstimate::GlobalEstimate(const AssembledScene& assembled, const NodalState& nodal,
                               const std::vector<ConnectorCell>& cells, const std::vector<ContactPair>& contacts,
                               const Ties& ties, const AbsorbingLayers& absorbing)
    : assembled_(assembled),
      nodal_(nodal),
      cells_(cells),
      contacts_(contacts),
      ties_(ties),
      absorbing_(absorbing),
      tangent_(assembled.assembly) {
  const std::size_t nodes = assembled_.assembly.nodes.size();
  now_ = unset_array<double* [3]>("tangent vector", nodes);
  before_ = unset_array<double* [3]>("tangent vector before", nodes);
  image_ = unset_array<double* [3]>("tangent image", nodes);
  displacement_ = unset_array<double* [3]>("tangent displacement", nodes);
  products_ = Array<double*>("inner products", 2 + 2 * most_iterations);
}

void GlobalEstimate::inner(const NodeVector& a, const NodeVector& b, int place) const {
  if (share_ == nullptr)
    Reductions(*nodal_.reduction_space)
        .sum_on_device(InnerProduct{a, b}, static_cast<int>(a.extent(0)), products_.data() + place);
  else
    Kokkos::deep_copy(ExecutionSpace(), Kokkos::subview(products_, place), share_->sum(a, b));
}

void GlobalEstimate::fetch_products(int iterations, Recurrence& known) const {
  const std::vector<double> products = to_vector(products_);
  for (int k = static_cast<int>(known.diagonal.size()) + 1; k <= iterations && !known.exhausted; ++k) {
    known.diagonal.push_back(products[2 * k]);
    known.beside.push_back(std::sqrt(products[2 * k + 1]));
    known.exhausted = known.beside.back() <= 1e-10 * std::fabs(known.diagonal.front());
  }
}

void GlobalEstimate::set_springs(const ContactReach& within, GlobalStep& result) {
  SpringCollector collector;
  collector.add_connectors(assembled_.scene, cells_);
  for (const ContactPair& pair : contacts_) {
    if (!pair.has_springs()) {
      result.seen.emplace_back(pair.slave_nodes.size(), 1);
      result.counted.emplace_back();
      continue;
    }
    const auto springs = possible_contact_springs(assembled_.mass, nodal_.nodes, pair, within);
    collector.add_contact(springs, pair.arrays.friction > 0);
    result.springs += static_cast<long>(springs.size());
    auto& seen = result.seen.emplace_back(pair.slave_nodes.size(), 0);
    auto& counted = result.counted.emplace_back(pair.slave_nodes.size(), 0);
    for (const ContactSpring& spring : springs) {
      seen[spring.slave] = 1;
      counted[spring.slave] = spring.stiffness / pair.growth;
    }
  }
  tangent_.set_springs(collector);
}

void GlobalEstimate::apply(double inverse_time) {
  const int nodes = static_cast<int>(now_.extent(0));
  Kokkos::parallel_for("tangent_displacement", Range(0, nodes), ToDisplacement{now_, displacement_, nodal_.nodes.mass});
  if (share_ != nullptr) share_->bring(displacement_);
  const TieArrays& ties = ties_.arrays;
  if (ties.active())
    Kokkos::parallel_for("tangent_ties", SpreadRange(0, ties.slave_count),
                         TieMotion{ties, nodal_.nodes.position, displacement_});
  const double speed = largest_initial_speed(assembled_.scene);
  std::vector<ElementStiffness> stiffness;
  for (std::size_t p = 0; p < assembled_.assembly.parts.size(); ++p) {
    const scene::Part& part = assembled_.scene.parts[p];
    const scene::Material& material = assembled_.scene.materials[assembled_.assembly.parts[p].material];
    const bool viscous = part.hourglass == scene::HourglassType::viscous;
    const double factor =
        hourglass_factor(part.hourglass, part.hourglass_coefficient, material) * (viscous ? inverse_time : 1);
    const double mu = material.shear_modulus(), damped = 1 + part.stiffness_damping * inverse_time;
    const double bulk =
        (part.linear_bulk_viscosity * material.dilatational_speed() + part.quadratic_bulk_viscosity * speed) *
        material.density * inverse_time;
    stiffness.push_back({damped * (material.dilatational_modulus() - 2 * mu), damped * mu, factor, viscous, bulk});
  }
  tangent_.apply(assembled_.assembly, stiffness, nodal_.nodes.position, displacement_, inverse_time, image_);
  if (ties.active()) {
    Kokkos::parallel_for("tangent_tie_force", SpreadRange(0, ties.slave_count),
                         TieMotionForce{ties, nodal_.nodes.position, image_});
    Kokkos::parallel_for("tangent_tie_gather", SumTeams(3 * ties.master_count, threads_of_sum),
                         TieGather{ties, ties.master_nodes, image_});
  }
  Kokkos::parallel_for("tangent_weighted", Range(0, nodes),
                       ToWeighted{image_, nodal_.nodes.mass, nodal_.nodes.constraint, nodal_.constraints});
}

double GlobalEstimate::largest_eigenvalue(double inverse_time, double accuracy, const Bounds& bounds,
                                          GlobalStep& result) {
  const int nodes = static_cast<int>(now_.extent(0));
  Kokkos::parallel_for(
      "tangent_start", Range(0, nodes),
      StartVector{now_, nodal_.nodes.mass, nodal_.nodes.reference, tangent_.first_corner(), tangent_.corner(),
                  tangent_.corners(), share_ != nullptr ? share_->end_of_scene() : nodes});
  Kokkos::parallel_for("tangent_weighted", Range(0, nodes),
                       ToWeighted{now_, nodal_.nodes.mass, nodal_.nodes.constraint, nodal_.constraints});
  const double* const products = products_.data();
  Kokkos::deep_copy(ExecutionSpace(), products_, 0.0);
  inner(now_, now_, 0);
  if (!(to_vector(products_).front() > 0)) return 0;  // everything is held
  Kokkos::parallel_for("tangent_scale", Range(0, nodes), Scale{now_, products});
  Kokkos::deep_copy(ExecutionSpace(), before_, 0.0);

  Recurrence known;
  for (int k = 1;; ++k) {
    apply(inverse_time);
    const int diagonal = 2 * k, beside = 2 * k + 1;
    inner(now_, image_, diagonal);
    Kokkos::parallel_for("tangent_recur", Range(0, nodes),
                         Recur{image_, now_, before_, products + diagonal, products + beside - 2});
    inner(image_, image_, beside);
    if (k % iterations_between_checks == 0 || k == most_iterations) {
      fetch_products(k, known);
      const int iterations = static_cast<int>(known.diagonal.size());
      const RitzValue ritz = largest_ritz_value(known.diagonal, known.beside);
      const bool low_enough = iterations >= least_iterations && ritz.value + 3 * ritz.residual <= bounds.enough;
      const bool too_high = ritz.value > bounds.most;
      if (known.exhausted || low_enough || too_high || ritz.residual <= accuracy * ritz.value || k == most_iterations) {
        result.applications += iterations;
        return ritz.value + ritz.residual;
      }
    }
    Kokkos::parallel_for("tangent_scale", Range(0, nodes), Scale{image_, products + beside});
    const NodeVector spent = before_;
    before_ = now_;
    now_ = image_;
    image_ = spent;
  }
}

GlobalStep GlobalEstimate::operator()(const ContactReach& within, double guess) {
  GlobalStep result;
  set_springs(within, result);
  return solve(guess, Guess::near, std::move(result));
}

GlobalStep GlobalEstimate::at_least(const ContactReach& within, double least) {
  GlobalStep result;
  set_springs(within, result);
  return solve(least, Guess::least, std::move(result));
}

GlobalStep GlobalEstimate::of_elements(const ContactOnNodes& contact, double longest) {
  SpringCollector collector;
  for (int n = 0; n < static_cast<int>(contact.stiffness.size()); ++n)
    if (contact.stiffness[n] > 0) collector.add_ground(n, 2 * contact.stiffness[n], 2 * contact.damping[n]);
  tangent_.set_springs(collector);
  return solve(longest, Guess::most, {});
}

GlobalStep GlobalEstimate::solve(double guess, Guess is, GlobalStep result) {
  result.step = guess;
  const bool at_most_guess = is == Guess::most;
  bool damped = false;
  double mass_rate = 0;  // counted as if all nodes had the largest
  for (const scene::Part& part : assembled_.scene.parts) {
    damped =
        damped || part.damped() || (part.hourglass == scene::HourglassType::viscous && part.hourglass_coefficient > 0);
    mass_rate = std::fmax(mass_rate, part.mass_damping);
  }
  for (const AbsorbingLayers::Zone& zone : absorbing_.zones) {
    damped = true;
    mass_rate = std::fmax(mass_rate, zone.rate);
  }
  for (const scene::Connector& connector : assembled_.scene.connectors)
    damped = damped || connector.damping != Vec3{0, 0, 0};
  for (const ContactPair& pair : contacts_) damped = damped || pair.contact->damping > 0;
  const double limit = 4 / (guess * guess), enough = at_most_guess ? limit : 0;
  Bounds bounds{enough, is == Guess::least ? limit : std::numeric_limits<double>::infinity()};
  if (!damped) {
    const double eigenvalue = largest_eigenvalue(0, tolerance, bounds, result);
    if (eigenvalue > enough) result.step = 2 / std::sqrt(eigenvalue);
    return result;
  }
  // The operator holds the step itself. Too short a step makes dashpots too strong, so that the pass is short of the
  // answer and yet nearer to it than the step was; too long a one the other way round. The last pass counts from the
  // short side.
  constexpr int most_passes = 8;
  double step = guess;
  for (int k = 0; k < most_passes; ++k) {
    const bool first = k == 0;
    const double by_mass = mass_rate * 2 / step;
    if (first) bounds = {enough - by_mass, bounds.most - by_mass};
    const double eigenvalue =
        by_mass + largest_eigenvalue(2 / step, first && !at_most_guess ? 4 * tolerance : tolerance,
                                     first ? bounds : Bounds{}, result);
    if (!(eigenvalue > 0) || (first && eigenvalue <= enough)) break;
    result.step = 2 / std::sqrt(eigenvalue);
    // Of a longer step dashpots are weaker: the step sought lies on the same side of the guess.
    if (first && is == Guess::least && result.step < guess) break;
    if (result.step >= step && result.step <= (1 + 0.5 * tolerance) * step) break;
    step = result.step >= step ? result.step : result.step - 0.6 * (step - result.step);
  }
  if (at_most_guess) result.step = std::fmin(result.step, guess);
  return result;
}

}  // namespace railwave
