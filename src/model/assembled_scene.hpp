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

/// Centre of mass of a set of nodes, m. @param place place(n, i): component i of where node n lies
template <class Place>
Vec3 centre_of_mass(const AssembledScene& assembled, const std::vector<int>& nodes, const Place& place) {
  Vec3 centre{};
  double mass = 0;
  for (int n : nodes) {
    mass += assembled.mass[n];
    for (int i = 0; i < 3; ++i) centre[i] += assembled.mass[n] * place(n, i);
  }
  for (double& c : centre) c /= mass;
  return centre;
}

/// The same where the nodes lie undeformed.
inline Vec3 centre_of_mass(const AssembledScene& assembled, const std::vector<int>& nodes) {
  return centre_of_mass(assembled, nodes, [&](int n, int i) { return assembled.assembly.nodes[n][i]; });
}

}  // namespace railwave
