#pragma once

#include <map>
#include <vector>

#include "case/scene.hpp"
#include "kernels/support/spaces.hpp"
#include "model/assembly.hpp"

namespace railwave {

/// Directions in which a node is held, orthonormal.
using HeldDirections = std::vector<scene::Vec3>;

/// Adds a direction, unless it lies in the span of those there are.
void add_direction(HeldDirections& directions, scene::Vec3 direction);

/// Adds all three.
void hold(HeldDirections& directions);

/// By node: the directions in which constraints and prescribed motions hold it.
std::map<int, HeldDirections> held_directions(const scene::Scene& scene, const Assembly& assembly);

/// Whether what holds a node leaves nothing of a force in that direction.
bool force_is_held(const std::map<int, HeldDirections>& held, int node, const Vec3& force);

/// Whether all three directions of a node are held.
bool wholly_held(const std::map<int, HeldDirections>& held, int node);

/// A projection I - sum d d^T for each different set of directions, and which one each node has.
/// @param row_of_node set for the nodes in `held`, left as it is for others
Array<double* [3][3]> projections(const std::map<int, HeldDirections>& held, std::vector<int>& row_of_node);

}  // namespace railwave
