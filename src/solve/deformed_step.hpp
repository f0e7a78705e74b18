#pragma once

#include <vector>

#include "model/time_step/deformed_elements.hpp"
#include "model/time_step/step_sizes.hpp"
#include "solve/monitor/sampled_ranks.hpp"

namespace railwave {

/// Follows elements that change their shape, so that no step is longer than they allow (docs/stability.md). Checks are
/// rare where nothing deforms: at steps 16, 32, 64 ... and every 512. Where elements do, the next check comes when half
/// of the steps are over in which they could come in the way, moving on as now. Bodies so fast, where they can touch,
/// that a blow could squeeze elements between two checks are looked at when their contacts are, and checked when they
/// meet. A wheel's top goes twice as fast as the train, and what is near the rail hardly moves against it.
class DeformedStep {
 public:
  /// @param elements those of this process
  /// @param others of a run over several ranks; null: there are none
  DeformedStep(const Model& model, DeformedElements elements, SampledRanks* others);

  /// Whether a check is due at a step, which may be one to come.
  bool due(long step) const;

  /// Looks at the elements as they are now.
  /// @return whether StableStep::limit is to be set(), for the step is too long or shorter than it need be
  bool check();

  /// The same, due or not.
  bool check_again();

  /// Sets the limit that was found.
  void set(StableStep& stable);

  /// A new estimate has been made: it is the limit, as far as elements have their shape.
  void estimated() { undeformed_ = sizes_.stable_step.limit; }

  /// Whether the elements' step is now no shorter than the whole scene's.
  bool by_elements() const { return by_elements_; }

  /// See StateSaver.
  template <class Archive>
  void archive(Archive& archive) {
    archive.value("deformed_undeformed", undeformed_);
    archive.value("deformed_next", next_);
    archive.value("deformed_last", last_);
    archive.value("deformed_left", left_);
    archive.value("deformed_speed", speed_);
    archive.value("deformed_approach", approach_);
    archive.value("deformed_layouts", layouts_);
    archive.value("deformed_striking", striking_);
    archive.value("deformed_moving", moving_);
    archive.value("deformed_given_up", given_up_);
  }

 private:
  static constexpr long none = -1;

  bool contact_checked_before(long step) const;
  bool moves_fast() const { return 2 * speed_ > fast_; }
  bool may_strike() const;
  bool window_is_new() const;
  bool check(double size);
  double used_share() const;
  DeformedNow measure_now(double elements, bool approach) const;
  DeformedAhead measure_ahead(double limit, double least) const;

  const scene::Scene& scene_;
  const NodalState& nodal_;
  const std::vector<ContactPair>& contacts_;
  const StepSizes& sizes_;
  SampledRanks* const others_;
  const bool any_;  ///< there are elements
  const DeformedElements elements_;
  const double fast_;      ///< m/s, striking_speed()
  double undeformed_ = 0;  ///< s, the limit of the scene whose elements have their shape
  long next_ = 0;          ///< step of the next check
  long last_ = 0;          ///< of the last one
  double left_ = 1;        ///< share of the limit that was left then
  double speed_ = 0;       ///< m/s, of the fastest element then
  double approach_ = 0;    ///< m/s, of a node in the contacts' windows against the other body, at most
  long layouts_ = none;    ///< of windows, when that was found: a new one has other nodes
  bool striking_ = false;  ///< nodes were about to strike then
  bool given_up_ = false;  ///< the step was too long for too long, see beyond_help
  bool moving_ = false;    ///< elements were coming in the way then
  double found_ = 0;       ///< s, of the present check: allowed step
  double loss_ = 0;        ///< of the present check: relative loss of it in a step
  bool by_elements_ = false;
};

}  // namespace railwave
