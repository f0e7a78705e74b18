#include "solve/tasks/damping_forces.hpp"

#include "kernels/elements/element_damping.hpp"
#include "model/elements/block_launch.hpp"
#include "model/elements/carriers.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {

template <class S, class Nodes>
struct LaunchBoundsOf<BlockDamping<S, Nodes>> {
  using type = Kokkos::LaunchBounds<elements_of_block, 1>;
};

void element_damping(const Model& model, const ElementGroup& group, const Instant& instant) {
  const double elapsed = static_cast<double>(1L << group.level) * instant.elapsed;
  const double before = group.level == 0 ? 1 : 0;
  if (!model.scene.solver.elements_in_single())
    launch_blocks(group.blocks,
                  BlockDamping<double, NodeAdvance>{group.damping, group.blocks, node_advance(model, instant.step),
                                                    elapsed, before, model.partial.in_double});
  else if (!model.carried.active())
    launch_blocks(group.blocks,
                  BlockDamping<float, NodeAdvance>{group.damping, group.blocks, node_advance(model, instant.step),
                                                   elapsed, before, model.partial.in_single});
  else
    launch_blocks(group.blocks, BlockDamping<float, CarriedAdvance>{group.damping, group.blocks,
                                                                    carried_advance(model, group.carried, instant.step),
                                                                    elapsed, before, model.partial.in_single});
}

void book_damping(const Model& model, const ElementGroup& group, double elapsed) {
  const double half_time = 0.5 * static_cast<double>(1L << group.level) * elapsed;
  const Range blocks(0, group.blocks.count);
  if (!model.scene.solver.elements_in_single())
    Kokkos::parallel_for(
        "book_damping", blocks,
        BookDamping<double>{group.damping, group.blocks, model.nodes.velocity, half_time, model.partial.in_double});
  else
    Kokkos::parallel_for(
        "book_damping", blocks,
        BookDamping<float>{group.damping, group.blocks, model.nodes.velocity, half_time, model.partial.in_single});
}

}  // namespace railwave
