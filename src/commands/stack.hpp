#pragma once

#include <cstddef>
#include <functional>

namespace railwave {

/// Bytes that a thread of this program needs at least: 128 kB were enough for every command when it was measured.
inline constexpr std::size_t smallest_stack = 512 << 10;

/// Runs the program. Where the system gives it a smaller stack than that (ulimit -s), it runs in a thread with a stack
/// of its own, and so do all threads that it starts.
/// @return what `program` returned
int with_enough_stack(const std::function<int()>& program);

}  // namespace railwave
