#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kernels/relaxation.hpp"
#include "model/model.hpp"

namespace railwave {

/// What the stages of a step must know of time.
struct Instant {
  double time = 0;                               ///< s
  double step = 0;                               ///< s to the next instant
  double elapsed = 0;                            ///< s since the instant before; 0 at the first
  bool settling = false;                         ///< pseudo-time of a dynamic relaxation
  const RelaxationUpdate* relaxation = nullptr;  ///< how that moves the nodes
  bool advancing = false;  ///< nobody looks at this instant: patches may move the nodes that are theirs alone at once
};

/// One piece of physics of a step. A scene's list holds only those that it needs.
struct Stage {
  std::string name;
  std::function<void(const Instant&)> run;
};

/// The stages that compute the forces of an instant, in order: elements, loads, connectors, contact.
/// The model must outlive the list.
std::vector<Stage> force_stages(Model& model);

/// Brings tied nodes after their masters; `step` as of Instant.
void follow_ties(const Model& model, double step, bool carried);

/// Accelerations, constraints, velocities and positions: from the present instant to the next.
void advance(Model& model, double step);

}  // namespace railwave
