#pragma once

#include <vector>

#include "kernels/monitor/monitor_terms.hpp"
#include "model/assembly.hpp"
#include "model/contact/contact_pair.hpp"
#include "model/nodal_state.hpp"
#include "model/ranks/rank_share.hpp"
#include "solve/checkpoint/run_state.hpp"
#include "solve/monitor/question.hpp"

namespace railwave {

/// An extreme value and the item that has it; -1: none.
struct Extreme {
  double value = 0;
  int place = -1;
};

/// What one check of the whole model found.
struct MonitorMeasures {
  Extreme jacobian;                  ///< smallest over the undeformed one, 1 in the beginning; element
  Extreme distortion;                ///< largest hourglass mode over the size; element
  Extreme speed;                     ///< m/s; node
  Extreme acceleration;              ///< m/s2; node
  std::vector<Extreme> penetration;  ///< by contact pair: over the face's size; node of the model
  std::vector<Extreme> chatter;      ///< by contact pair: times opened and closed; node of the model
};

/// Puts the worse of two sets of measures into the first: contacts are rank 0's.
void join(MonitorMeasures& measures, const MonitorMeasures& of_others);

/// An element of the mesh, undeformed.
ElementShape undeformed_shape(const Assembly& assembly, int element);

/// The device arrays of the monitor, and the reductions over them: a few launches a check, none in a step.
class MonitorArrays {
 public:
  /// @param own elements and nodes that this process measures; null: all
  MonitorArrays(const Assembly& assembly, const std::vector<ContactPair>& contacts, const OwnItems* own = nullptr);

  /// Asks the device for the measures of the present instant.
  /// @param order in which the launches come
  void ask(const NodalState& nodal, const std::vector<ContactPair>& contacts, const ExecutionSpace& order);
  /// Whether the device has yet to come to that.
  bool waits() const { return question_.waits(); }
  /// Waits for what was asked, or asks.
  MonitorMeasures measure(const NodalState& nodal, const std::vector<ContactPair>& contacts);

  /// Largest difference of velocity over distance between neighbouring corners of an element, 1/s.
  double largest_rate(const NodalState& nodal) const;

  /// What was seen of contact nodes up to now.
  void archive(StateSaver& state);
  void archive(StateRestorer& state);

 private:
  ElementShapes shapes_;
  std::vector<int> elements_;  ///< the numbers of those measured; empty: all are
  bool own_nodes_ = false;     ///< the listed nodes alone are measured
  std::vector<int> node_numbers_;
  Array<int*> nodes_;
  std::vector<Array<int*>> changes_;  ///< by contact pair
  Question<MonitorMeasures> question_;
};

}  // namespace railwave
