#include "solve/tasks/damping_forces.hpp"

#include "kernels/elements/element_damping.hpp"
#include "model/elements/carriers.hpp"
#include "model/elements/patch_launch.hpp"
#include "solve/tasks/element_forces.hpp"

namespace railwave {

template <class S, class Nodes>
struct LaunchBoundsOf<PatchDamping<S, Nodes>> {
  using type = Kokkos::LaunchBounds<patch_size, 1>;
};

void element_damping(const Model& model, const ElementGroup& group, const Instant& instant) {
  const double elapsed = static_cast<double>(1L << group.level) * instant.elapsed;
  const double before = group.level == 0 ? 1 : 0;
  if (!model.scene.solver.elements_in_single())
    launch_patches(group.patches,
                   PatchDamping<double, NodeAdvance>{group.damping, group.patches, node_advance(model, instant.step),
                                                     elapsed, before, model.partial.wide});
  else if (!model.carried.active())
    launch_patches(group.patches,
                   PatchDamping<float, NodeAdvance>{group.damping, group.patches, node_advance(model, instant.step),
                                                    elapsed, before, model.partial.narrow});
  else
    launch_patches(group.patches, PatchDamping<float, CarriedAdvance>{
                                      group.damping, group.patches, carried_advance(model, group.carried, instant.step),
                                      elapsed, before, model.partial.narrow});
}

void book_damping(const Model& model, const ElementGroup& group, double elapsed) {
  const double half_time = 0.5 * static_cast<double>(1L << group.level) * elapsed;
  const Range patches(0, group.patches.count);
  if (!model.scene.solver.elements_in_single())
    Kokkos::parallel_for(
        "book_damping", patches,
        BookDamping<double>{group.damping, group.patches, model.nodes.velocity, half_time, model.partial.wide});
  else
    Kokkos::parallel_for(
        "book_damping", patches,
        BookDamping<float>{group.damping, group.patches, model.nodes.velocity, half_time, model.partial.narrow});
}

}  // namespace railwave
