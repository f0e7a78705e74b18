#include "kernels/elements/element_damping.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/relative_coordinates.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {

template <class S, class Nodes>
struct LaunchBoundsOf<BlockDamping<S, Nodes>> {
  using type = Kokkos::LaunchBounds<elements_of_block, 1>;
};

void element_damping(const NodalState& nodal, const ElementGroup& group, bool in_single, const Instant& instant,
                     const Array<int*>* listed) {
  const double elapsed = static_cast<double>(1L << group.level) * instant.elapsed;
  const double before = group.level == 0 ? 1 : 0;
  if (!in_single)
    launch_blocks(group.blocks, listed,
                  BlockDamping<double, NodeAdvance>{group.damping, group.blocks, node_advance(nodal, instant.step),
                                                    elapsed, before, nodal.partial.in_double},
                  instant.space());
  else if (!nodal.relative.active())
    launch_blocks(group.blocks, listed,
                  BlockDamping<float, NodeAdvance>{group.damping, group.blocks, node_advance(nodal, instant.step),
                                                   elapsed, before, nodal.partial.in_single},
                  instant.space());
  else
    launch_blocks(group.blocks, listed,
                  BlockDamping<float, RelativeAdvance>{group.damping, group.blocks,
                                                       relative_advance(nodal, group.relative, instant.step), elapsed,
                                                       before, nodal.partial.in_single},
                  instant.space());
}

void book_damping(const NodalState& nodal, const ElementGroup& group, bool in_single, const Instant& instant) {
  const double half_time = 0.5 * static_cast<double>(1L << group.level) * instant.elapsed;
  const Range blocks(instant.space(), 0, group.blocks.count);
  if (!in_single)
    Kokkos::parallel_for(
        "book_damping", blocks,
        BookDamping<double>{group.damping, group.blocks, nodal.nodes.velocity, half_time, nodal.partial.in_double});
  else
    Kokkos::parallel_for(
        "book_damping", blocks,
        BookDamping<float>{group.damping, group.blocks, nodal.nodes.velocity, half_time, nodal.partial.in_single});
}

}  // namespace railwave
