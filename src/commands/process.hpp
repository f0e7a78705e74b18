#pragma once

#include <sys/types.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// What the process has and how it ends: its stack and memory, signals, a child that reads files.
namespace railwave {

/// Bytes that a thread of this program needs at least: 128 kB were enough for every command when it was measured.
inline constexpr std::size_t smallest_stack = 512 << 10;

/// Runs the program. Where the system gives it a smaller stack than that (ulimit -s), it runs in a thread with a stack
/// of its own, and so do all threads that it starts.
/// @return what `program` returned
int with_enough_stack(const std::function<int()>& program);

/// Makes little memory do the same on every machine, and nothing worse than a message: one heap for all threads, unless
/// MALLOC_ARENA_MAX says otherwise (the C library would map up to 64 MB of address space for each), and a main stack
/// that need not grow any more, which the system would answer by SIGSEGV. Ends the program with a message and exit code
/// 1 where not even that can be had. Before the libraries begin, which happens before main(), steady_memory.cpp
/// looks whether they will have enough.
void steady_memory();

/// Whether steady_memory() has been called: before, no exception may be thrown.
bool has_begun() noexcept;

/// Says so and ends the program with exit code 1. Allocates nothing.
[[noreturn]] void end_for_want_of_memory() noexcept;

/// Whether an exception says that memory was refused, on the host or the device.
bool is_out_of_memory(const std::exception& error);

/// For people: how much was wanted, how much there is, what to do.
std::string out_of_memory(const std::exception& error);

/// Libraries may end the program by themselves: HDF5 1.10 calls exit(-1) without a word where it finds no memory for an
/// identifier, on whatever thread. While one of these lives such an end is reported, and has the exit code of a
/// failure.
class NoSuddenExit {
 public:
  NoSuddenExit();
  ~NoSuddenExit();
  NoSuddenExit(const NoSuddenExit&) = delete;
  NoSuddenExit& operator=(const NoSuddenExit&) = delete;
};

/// SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1 and SIGUSR2 (schedulers send these before a job's time is up) end the
/// program in good order. Those that whoever started it has it ignore stay ignored (nohup, jobs in a shell's
/// background). SIGPIPE and SIGXFSZ are ignored: what is written then is refused with EPIPE and EFBIG.
/// From now on such a signal takes away what was half written, says so and ends the program with exit code 130.
void end_on_signals();

/// From now on such a signal is a wish to stop (request_stop()), which the run's loop looks at.
void stop_on_signals();

/// From now on such a signal is passed on to a child, which ends in good order itself; this process waits for it. 0: no
/// longer.
void pass_signals_to(pid_t child);

/// Whether there was such a wish.
bool was_signalled();

/// Runs a command that reads results files in a process of its own: HDF5 may crash, or go round in circles, in a
/// damaged file. To be called before any other thread is started and before HDF5 or Kokkos are used. The child prints
/// and writes what the command does; this process waits for it, and where a signal ended it says on stderr which files
/// are damaged and what to do.
/// @param command for people: "railwave signal"
/// @param files that it reads
/// @return the exit code, in both processes: the caller ends with it. What `work` throws passes through, in the child.
int in_reading_child(const std::string& command, const std::vector<std::string>& files,
                     const std::function<int()>& work);

/// The same for reading files before something else is done with them.
/// @return the exit code to end with; nothing: `read` came to its end, go on (only in this process, the child is to
/// end)
std::optional<int> after_reading_in_child(const std::string& command, const std::vector<std::string>& files,
                                          const std::function<void()>& read);

}  // namespace railwave
