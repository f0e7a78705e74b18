#pragma once

#include <array>
#include <map>

#include "model/assembly.hpp"
#include "model/boundaries/held_directions.hpp"

namespace railwave {

/// Which faces of the elements are on the outside of a body: those that belong to one element only.
class OutsideFaces {
 public:
  explicit OutsideFaces(const Assembly& assembly);
  bool has(const Face& face) const;

 private:
  const Assembly& assembly_;
  std::map<std::array<int, 4>, int> owners_;  ///< by sorted nodes: elements; only of faces that lie in a named surface
};

/// Whether what holds a node leaves nothing of a force in that direction.
bool force_is_held(const std::map<int, HeldDirections>& held, int node, const Vec3& force);

/// Whether all three directions of a node are held.
bool wholly_held(const std::map<int, HeldDirections>& held, int node);

}  // namespace railwave
