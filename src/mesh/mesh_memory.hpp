#pragma once

#include <stdexcept>
#include <string>

#include "case/scene.hpp"

namespace railwave {

/// A mesh too large to be made; build_mesh() names the entry of the case.
class MeshTooLarge : public std::runtime_error {
 public:
  const bool of_memory;  ///< for what this machine has left; else for any

  explicit MeshTooLarge(const std::string& what, bool for_memory = false)
      : std::runtime_error(what), of_memory(for_memory) {}
};

inline constexpr const char* smaller_mesh = "make the elements larger, or the body smaller";

/// Throws MeshTooLarge, before memory is asked for, when a mesh's nodes can't be numbered by an int or the mesh is
/// larger than what this machine has left.
void expect_mesh_memory(double elements, double nodes);

/// A number of cells along one line as an int. Throws MeshTooLarge for more than a million, which no mesh has along one
/// direction.
int cell_count(double cells);

/// About how many elements the meshes of all parts will have.
double expected_elements(const scene::Scene& scene);

/// Throws MemoryShortage when the meshes and the model of all parts of a scene can't fit into the memory that is left;
/// the message names the part that takes the most of it.
void expect_memory_for_parts(const scene::Scene& scene);

/// The same against a given number of bytes.
void expect_memory_for_parts(const scene::Scene& scene, double available);

}  // namespace railwave
