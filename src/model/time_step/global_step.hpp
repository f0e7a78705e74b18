#pragma once

#include "model/contact/contact_springs.hpp"
#include "model/time_step/tangent_operator.hpp"

namespace railwave {

/// The stable step of the assembled scene.
struct GlobalStep {
  double step = 0;                      ///< s
  int applications = 0;                 ///< of the operator
  long springs = 0;                     ///< contact springs counted in
  std::vector<std::vector<char>> seen;  ///< by contact pair and slave: whether its spring was counted in
};

/// Estimates the stable step from the highest frequency of everything together: elements, hourglass control, springs
/// and dashpots of connectors, contact springs of the nodes that touch or soon may, constraints. The central difference
/// with velocities half a step behind is stable while dt^2/4 K + dt/2 C <= M, so dt = 2/omega with omega^2 the largest
/// eigenvalue of M^-1 (K + 2/dt C). Lanczos' method, from a vector made of the nodes' numbers, finds it from below; the
/// residual's bound, at most `tolerance` of omega^2, is added, so that the step errs to the short side.
class GlobalEstimate {
 public:
  static constexpr double tolerance = 0.01;
  static constexpr int most_iterations = 150;

  explicit GlobalEstimate(const Model& model);

  /// @param horizon s: contact springs that may press within that time count
  /// @param guess s: near the answer, if anything on the short side; the answer where everything is held
  GlobalStep operator()(const Model& model, double horizon, double guess);

  /// The longest step up to `longest` that is stable for the elements with everything that contact may put on them,
  /// wherever the bodies touch; without connectors and beams. A spring k between two nodes is at most 2 k from each to
  /// the ground: (u - w)^2 <= 2 u^2 + 2 w^2, with equality where the two move against each other.
  GlobalStep of_elements(const Model& model, double longest);

  std::size_t bytes() const;

 private:
  void set_springs(const Model& model, double horizon, GlobalStep& result);
  GlobalStep solve(const Model& model, double guess, bool at_most_guess, GlobalStep result);
  void apply(const Model& model, double inverse_time);
  /// @param enough a Ritz value with three times its residual below this will do; 0: none
  double largest_eigenvalue(const Model& model, double inverse_time, double accuracy, double enough,
                            GlobalStep& result);

  TangentOperator tangent_;
  NodeVector now_, before_, image_, displacement_;
};

}  // namespace railwave
