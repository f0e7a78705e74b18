#pragma once

#include "model/model.hpp"
#include "model/time_step/tangent_springs.hpp"
#include "solve/plan.hpp"

namespace railwave {

/// What contact is to the search for a static equilibrium. Pairs with penalty springs press as they do in the run.
/// Pairs with multipliers press by augmented Lagrange (kernels/contact/laws/augmented_penalty.hpp). A force evaluation
/// leaves what nodes touch, stick to and have flowed plastically in the arrays; a trial that is not taken must not.
class StaticContact {
 public:
  explicit StaticContact(Model& model);

  bool any() const { return !model_.contacts.empty(); }
  bool augmented() const { return augmented_; }
  /// m, the smallest diagonal of a master segment; 1e300 without contact.
  double smallest_segment() const { return smallest_segment_; }

  /// Takes the present contact and plastic state as the one from which trials start.
  void keep();
  /// Goes back to it; nodes that can touch are looked for anew.
  void restore();
  /// Forces of the augmented pairs at the present places.
  void press();

  /// Springs of the nodes that press now.
  void add_springs(SpringCollector& springs) const;

  /// Takes what presses now as the multipliers. @return largest change of one, over the largest multiplier
  double renew_multipliers();

 private:
  Model& model_;
  bool augmented_ = false;
  double smallest_segment_ = 1e300;
  std::vector<Array<unsigned char*>> kept_;  ///< what trials change
  std::vector<Array<double*>> multiplier_;   ///< N, by pair and slave node; empty with springs
};

}  // namespace railwave
