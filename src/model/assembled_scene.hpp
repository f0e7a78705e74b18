#pragma once

#include <vector>

#include "model/assembly.hpp"

namespace railwave {

/// A scene with its mesh: all that the host knows of it before there are arrays of a run. It is the part of a model
/// that checks of input, descriptions and files of results work with.
struct AssembledScene {
  scene::Scene scene;
  Assembly assembly;
  std::vector<double> mass;            ///< kg by node
  std::vector<double> element_length;  ///< m, V / A_max by element

  long element_count() const { return static_cast<long>(assembly.elements.size()); }
};

}  // namespace railwave
