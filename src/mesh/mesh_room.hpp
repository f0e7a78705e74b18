#pragma once

#include <stdexcept>

namespace railwave {

/// A mesh too large to be made; build_mesh() names the entry of the case.
class MeshTooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr const char* smaller_mesh = "make the elements larger, or the body smaller";

/// Throws MeshTooLarge, before memory is asked for, when a mesh's nodes can't be numbered by an int or the mesh is
/// larger than what this machine has left.
void expect_mesh_room(double elements, double nodes);

/// A number of cells along one line as an int. Throws MeshTooLarge for more than a million, which no mesh has along one
/// direction.
int cell_count(double cells);

}  // namespace railwave
