#pragma once

#include "model/time_step/tangent_springs.hpp"
#include "solve/tasks.hpp"

namespace railwave {

/// What contact is to the search for a static equilibrium. Pairs with penalty springs press as they do in the run.
/// Pairs with multipliers press by augmented Lagrange (kernels/contact/laws/augmented_penalty.hpp).
class StaticContact {
 public:
  StaticContact(const AssembledScene& assembled, const NodalState& nodal, std::vector<ContactPair>& contacts);

  bool any() const { return !contacts_.empty(); }
  bool augmented() const { return augmented_; }
  /// m, the smallest diagonal of a master segment; 1e300 without contact.
  double smallest_segment() const { return smallest_segment_; }

  /// Nodes that can touch are searched for anew: the places are others.
  void search_anew();
  /// Forces of the augmented pairs at the present places.
  void press();

  /// Springs of the nodes that press now.
  void add_springs(SpringCollector& springs) const;

  /// Takes what presses now as the multipliers. @return largest change of one, over the largest multiplier
  double renew_multipliers();

 private:
  const scene::Scene& scene_;
  const NodalState& nodal_;
  std::vector<ContactPair>& contacts_;
  bool augmented_ = false;
  double smallest_segment_ = 1e300;
  std::vector<Array<double*>> multiplier_;  ///< N, by pair and slave node; empty with springs
};

}  // namespace railwave
