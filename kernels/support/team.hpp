#pragma once

#include <cstdint>

#include "kernels/support/spaces.hpp"

namespace railwave {

/// A team: a block of threads on a GPU, one thread on a host.
using Team = Kokkos::TeamPolicy<ExecutionSpace>;
using Scratch = ExecutionSpace::scratch_memory_space;

/// For long sums, each by a team: SumTeams(sums, threads_of_sum).
using SumTeams = Kokkos::TeamPolicy<ExecutionSpace, Kokkos::LaunchBounds<32>, AsArgument>;
inline constexpr int threads_of_sum = on_device ? 32 : 1;

inline constexpr std::size_t scratch_alignment = 16;

/// Bytes that a host's processor brings from memory at once.
inline constexpr std::size_t cache_line = 64;

/// The team's scratch memory for `count` values, aligned for loads of 16 bytes unless `alignment` says otherwise.
template <class S, class Member>
KOKKOS_INLINE_FUNCTION S* scratch_values(const Member& team, std::size_t count,
                                         std::size_t alignment = scratch_alignment) {
  return static_cast<S*>(team.team_scratch(0).get_shmem_aligned(count * sizeof(S), alignment));
}

/// 16 bytes, copied at once.
struct alignas(16) Chunk {
  std::uint64_t half[2];
};

}  // namespace railwave
