#pragma once

#include "kernels/elements/forces_together.hpp"
#include "kernels/nodes/relative_blocks.hpp"

namespace railwave {

/// Blocks of a multiprocessor that the compiler is asked to leave room for: more of them hide latency, fewer leave each
/// thread more registers. Measured on an H100.
template <class S>
inline constexpr int blocks_at_once = sizeof(S) == sizeof(double) ? 4 : 7;

template <class Functor>
struct LaunchBoundsOf;
template <class S, class Material, class Hourglass, bool Advance, class Nodes>
struct LaunchBoundsOf<ElementForce<S, Material, Hourglass, Advance, Nodes>> {
  using type = Kokkos::LaunchBounds<elements_of_block, blocks_at_once<S>>;
};
template <class S, class Material, class Hourglass>
struct LaunchBoundsOf<ElementState<S, Material, Hourglass>> {
  using type = Kokkos::LaunchBounds<elements_of_block, 1>;
};

template <>
struct LaunchBoundsOf<RelativeBlockUpdate> {
  using type = Kokkos::LaunchBounds<elements_of_block, 1>;
};

template <class Block, bool Friction>
struct LaunchBoundsOf<ForcesTogether<Block, Friction>> {
  using type = typename LaunchBoundsOf<Block>::type;
};

/// @param space in whose order
template <class Functor>
void launch_teams(int teams, std::size_t scratch_size, const Functor& functor,
                  const ExecutionSpace& space = ExecutionSpace()) {
  using Policy = Kokkos::TeamPolicy<ExecutionSpace, typename LaunchBoundsOf<Functor>::type, AsArgument>;
  const int team_size = on_device ? elements_of_block : 1;
  Kokkos::parallel_for("blocks", Policy(space, teams, team_size).set_scratch_size(0, Kokkos::PerTeam(scratch_size)),
                       functor);
}

/// Runs a functor with one team for each block.
template <class Functor>
void launch_blocks(const ElementBlocks& blocks, const Functor& functor,
                   const ExecutionSpace& space = ExecutionSpace()) {
  launch_teams(blocks.count, Functor::scratch_size(blocks), functor, space);
}

/// The same for some blocks only, which the functor has as `listed`. @param listed null: all
template <class Functor>
void launch_blocks(const ElementBlocks& blocks, const Array<int*>* listed, Functor functor,
                   const ExecutionSpace& space = ExecutionSpace()) {
  if (listed == nullptr) return launch_blocks(blocks, functor, space);
  if (listed->extent(0) == 0) return;
  functor.listed = *listed;
  launch_teams(static_cast<int>(listed->extent(0)), Functor::scratch_size(blocks), functor, space);
}

}  // namespace railwave
