#pragma once

#include "kernels/elements/forces_together.hpp"
#include "kernels/nodes/carried_patches.hpp"

namespace railwave {

/// Blocks of a multiprocessor that the compiler is asked to leave room for: more of them hide latency, fewer leave each
/// thread more registers. Measured on an H100.
template <class S>
inline constexpr int blocks_at_once = sizeof(S) == sizeof(double) ? 4 : 7;

template <class Functor>
struct LaunchBoundsOf;
template <class S, class Material, class Hourglass, bool Advance, class Nodes>
struct LaunchBoundsOf<PatchForce<S, Material, Hourglass, Advance, Nodes>> {
  using type = Kokkos::LaunchBounds<patch_size, blocks_at_once<S>>;
};
template <class S, class Material, class Hourglass>
struct LaunchBoundsOf<PatchState<S, Material, Hourglass>> {
  using type = Kokkos::LaunchBounds<patch_size, 1>;
};

template <>
struct LaunchBoundsOf<CarriedPatchUpdate> {
  using type = Kokkos::LaunchBounds<patch_size, 1>;
};

template <class Patch, bool Friction>
struct LaunchBoundsOf<ForcesTogether<Patch, Friction>> {
  using type = typename LaunchBoundsOf<Patch>::type;
};

template <class Functor>
void launch_teams(int teams, std::size_t scratch_size, const Functor& functor) {
  using Policy = Kokkos::TeamPolicy<ExecutionSpace, typename LaunchBoundsOf<Functor>::type, AsArgument>;
  const int team_size = on_device ? patch_size : 1;
  Kokkos::parallel_for("patches", Policy(teams, team_size).set_scratch_size(0, Kokkos::PerTeam(scratch_size)), functor);
}

/// Runs a functor with one team for each patch.
template <class Functor>
void launch_patches(const PatchArrays& patches, const Functor& functor) {
  launch_teams(patches.count, Functor::scratch_size(patches), functor);
}

}  // namespace railwave
