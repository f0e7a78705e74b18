#pragma once

#include "model/model.hpp"

namespace railwave {

/// Centre of mass of a set of nodes, m. @param place place(n, i): component i of where node n lies
template <class Place>
Vec3 centre_of_mass(const Model& model, const std::vector<int>& nodes, const Place& place) {
  Vec3 centre{};
  double mass = 0;
  for (int n : nodes) {
    mass += model.mass[n];
    for (int i = 0; i < 3; ++i) centre[i] += model.mass[n] * place(n, i);
  }
  for (double& c : centre) c /= mass;
  return centre;
}

}  // namespace railwave
