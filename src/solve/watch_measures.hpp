#pragma once

#include <vector>

#include "kernels/watch_terms.hpp"
#include "model/model.hpp"

namespace railwave {

/// An extreme value and the item that has it; -1: none.
struct Extreme {
  double value = 0;
  int place = -1;
};

/// What one look at the whole model found.
struct WatchMeasures {
  Extreme jacobian;                   ///< smallest over the undeformed one; element
  Extreme distortion;                 ///< largest hourglass mode over the size; element
  Extreme speed;                      ///< m/s; node
  std::vector<Extreme> penetration;   ///< by contact pair: over the face's size; node of the model
  std::vector<Extreme> chatter;       ///< by contact pair: times opened and closed; node of the model
};

/// The device arrays of the watch, and the reductions over them: a few launches a look, none in a step.
class WatchArrays {
 public:
  explicit WatchArrays(const Model& model);
  WatchMeasures measure(const Model& model) const;

 private:
  ElementShapes shapes_;
  std::vector<Array<int*>> changes_;  ///< by contact pair
};

}  // namespace railwave
