#pragma once

#include <limits>
#include <vector>

#include "model/boundaries/absorbing_boundaries.hpp"
#include "model/boundaries/ties.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/contact/contact_springs.hpp"
#include "model/loads/connector_cells.hpp"
#include "model/nodal_state.hpp"
#include "model/time_step/tangent_operator.hpp"

namespace railwave {

template <class Visitor>
struct Named;  // model/visit_arrays.hpp
class EstimateShare;

/// The largest eigenvalue of the tridiagonal matrix that Lanczos' recurrence has made of a symmetric operator so far.
struct RitzValue {
  double value = 0;     ///< at most the operator's largest eigenvalue
  double residual = 0;  ///< an eigenvalue of the operator lies within this of `value`
};

/// @param diagonal alpha_1 ... alpha_m
/// @param beside beta_1 ... beta_m; the last one leads to the vector not yet used
RitzValue largest_ritz_value(const std::vector<double>& diagonal, const std::vector<double>& beside);

/// The stable step of the assembled scene.
struct GlobalStep {
  double step = 0;                           ///< s
  int applications = 0;                      ///< of the operator
  long springs = 0;                          ///< contact springs counted in
  std::vector<std::vector<char>> seen;       ///< by contact pair and slave: whether its spring was counted in
  std::vector<std::vector<double>> counted;  ///< N/m, the same: that spring at no penetration
};

/// Estimates the stable step from the highest frequency of everything together: elements, hourglass control, springs
/// and dashpots of connectors, contact springs of the nodes that touch or soon may, constraints. The central difference
/// with velocities half a step behind is stable while dt^2/4 K + dt/2 C <= M, so dt = 2/omega with omega^2 the largest
/// eigenvalue of M^-1 (K + 2/dt C). Lanczos' method, from a vector made of the nodes' undeformed places, finds it from
/// below; the residual's bound, at most `tolerance` of omega^2, is added, so that the step errs to the short side.
class GlobalEstimate {
 public:
  static constexpr double tolerance = 0.01;
  static constexpr int most_iterations = 150;

  /// What it is given must outlive it.
  GlobalEstimate(const AssembledScene& assembled, const NodalState& nodal, const std::vector<ConnectorCell>& cells,
                 const std::vector<ContactPair>& contacts, const Ties& ties, const AbsorbingLayers& absorbing);

  /// @param within contact springs that count
  /// @param guess s: near the answer, if anything on the short side; the answer where everything is held
  GlobalStep operator()(const ContactReach& within, double guess);

  /// The same where a step below `least`, s, is of no use: as soon as that is certain, what has been found so far, also
  /// below `least`, is the answer.
  GlobalStep at_least(const ContactReach& within, double least);

  /// The longest step up to `longest` that is stable for the elements with everything that contact may put on them,
  /// wherever the bodies touch; without connectors and beams. A spring k between two nodes is at most 2 k from each to
  /// the ground: (u - w)^2 <= 2 u^2 + 2 w^2, with equality where the two move against each other.
  /// @param contact springs of all contacts on the nodes
  GlobalStep of_elements(const ContactOnNodes& contact, double longest);

  /// The scene is a rank's share: sums are over all ranks, see estimate_share.hpp.
  void set_share(const EstimateShare* share) { share_ = share; }

  template <class Visitor>
  friend void visit_arrays(const Named<Visitor>& visit, GlobalEstimate& estimate);

 private:
  /// What the guess of the step is.
  enum class Guess { near, most, least };

  void set_springs(const ContactReach& within, GlobalStep& result);
  GlobalStep solve(double guess, Guess is, GlobalStep result);
  void apply(double inverse_time);
  /// a . b, for launches that come later, at that place of products_.
  void inner(const NodeVector& a, const NodeVector& b, int place) const;
  /// Lanczos' recurrence as far as the host knows it: its numbers are on the device, and fetched now and then.
  struct Recurrence {
    std::vector<double> diagonal, beside;
    bool exhausted = false;  ///< nothing is left beside the last vector; what was launched after it is void
  };
  /// @param iterations that were launched
  void fetch_products(int iterations, Recurrence& known) const;
  /// Where the search of the largest eigenvalue may end early.
  struct Bounds {
    double enough = 0;  ///< a Ritz value with three times its residual below this will do; 0: none
    double most = std::numeric_limits<double>::infinity();  ///< so will one beyond this
  };
  double largest_eigenvalue(double inverse_time, double accuracy, const Bounds& bounds, GlobalStep& result);

  const AssembledScene& assembled_;
  const NodalState& nodal_;
  const std::vector<ConnectorCell>& cells_;
  const std::vector<ContactPair>& contacts_;
  const Ties& ties_;
  const AbsorbingLayers& absorbing_;
  const EstimateShare* share_ = nullptr;
  TangentOperator tangent_;
  NodeVector now_, before_, image_, displacement_;
  Array<double*> products_;  ///< the start with itself, 0; of each iteration diagonal and square of what is beside it
};

}  // namespace railwave
