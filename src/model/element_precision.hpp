#pragma once

#include "case/scene.hpp"

namespace railwave {

/// Calls `work` with a number of the type in which a scene's elements are computed.
template <class Work>
auto with_element_precision(const scene::Scene& scene, const Work& work) {
  return scene.solver.elements_in_single() ? work(float{}) : work(double{});
}

}  // namespace railwave
