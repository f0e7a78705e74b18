#include "mesh/mesh_room.hpp"

#include <fmt/format.h>

#include <limits>

#include "case/error.hpp"
#include "case/memory.hpp"

namespace railwave {
void expect_mesh_room(double elements, double nodes) {
  if (nodes > std::numeric_limits<int>::max())
    throw MeshTooLarge(fmt::format("makes {:.3g} nodes, more than {} can be numbered; {}", nodes,
                                   std::numeric_limits<int>::max(), smaller_mesh));
  try {
    expect_memory(bytes_of_mesh_element * elements, fmt::format("makes {:.3g} elements, which need", elements),
                  smaller_mesh);
  } catch (const InputError& problem) {
    throw MeshTooLarge(problem.what());
  }
}

int cell_count(double cells) {
  constexpr double most = 1e6;
  if (!(cells <= most))
    throw MeshTooLarge(fmt::format("makes more than {:.0f} elements along one line; {}", most, smaller_mesh));
  return static_cast<int>(cells);
}

}  // namespace railwave
