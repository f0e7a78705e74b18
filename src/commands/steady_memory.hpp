#pragma once

namespace railwave {

/// Makes little memory do the same on every machine, and nothing worse than a message: one heap for all threads, unless
/// MALLOC_ARENA_MAX says otherwise (the C library would map up to 64 MB of address space for each), and a main stack
/// that need not grow any more, which the system would answer by SIGSEGV. Ends the program with a message and exit code
/// 1 where not even that can be had. Before the libraries begin, which happens before main(), the same file looks
/// whether they will have enough.
void steady_memory();

/// Whether steady_memory() has been called: before, no exception may be thrown.
bool has_begun() noexcept;

/// Says so and ends the program with exit code 1. Allocates nothing.
[[noreturn]] void end_for_want_of_memory() noexcept;

}  // namespace railwave
