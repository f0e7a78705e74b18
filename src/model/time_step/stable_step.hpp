#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace railwave {

/// What sets the step, for messages: "the elements of part wheel, near (0, 0, 0) m", "connectors", "contact springs",
/// "beams".
std::string what_sets_step(const Model& model);

/// The longest step that the case allows now, s: `time.step`, else `time.step_scale` of the stable step; never quite
/// that step itself.
double largest_step(const Model& model);

/// Each element's own stable step by the estimate that the case chose, s; not for the global one.
std::vector<double> own_steps(const Model& model);

/// The same by its highest eigenvalue: whatever its neighbours are, free surfaces too, it is stable with that.
std::vector<double> safe_steps(const Model& model);

/// Speed of the fastest initial motion, turning left out, m/s: what bodies that hit at the beginning hit with.
double largest_initial_speed(const scene::Scene& scene);

/// Estimates the whole scene's stable step anew at the present instant. The case must have asked for the global
/// estimate.
void renew_global_step(Model& model);

/// Lines that tell what each estimate allows, which one sets the step, and what that gains.
std::vector<std::string> describe_stable_step(const Model& model);

}  // namespace railwave
