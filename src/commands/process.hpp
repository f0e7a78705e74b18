#pragma once

#include <sys/types.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// The process of the program: its stack and memory, signals, how it ends, a child process that reads files.
namespace railwave {

/// Bytes that a thread of this program needs at least: 128 kB were enough for every command when it was measured.
inline constexpr std::size_t smallest_stack = 512 << 10;

/// Runs the program. Where the system gives it a smaller stack than that (ulimit -s), it runs in a thread with a stack
/// of its own, and so do all threads that it starts.
/// @return what `program` returned
int with_enough_stack(const std::function<int()>& program);

/// Makes a lack of memory end in a message on every machine: one heap for all threads, unless MALLOC_ARENA_MAX says
/// otherwise (the C library would map up to 64 MB of address space for each), and a main stack that need not grow any
/// more, because the system answers a stack that cannot grow by SIGSEGV. Ends the program with a message and exit code
/// 1 where there is not even memory for that. steady_memory.cpp also checks before main() that the libraries will have
/// enough to start.
void steady_memory();

/// Whether steady_memory() has been called: before that no exception may be thrown.
bool has_begun() noexcept;

/// Says so and ends the program with exit code 1. Allocates nothing.
[[noreturn]] void end_for_want_of_memory() noexcept;

/// Whether an exception says that memory was refused, on the host or the device.
bool is_out_of_memory(const std::exception& error);

/// "rank 2: " where a launcher of MPI has started several processes, for what one of them lacks; else empty.
std::string rank_for_messages();

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

// Signals that stop the program: SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1 and SIGUSR2 (schedulers send these before a
// job's time is up). One that was ignored when the program started stays ignored (nohup, jobs in a shell's background).
// SIGPIPE and SIGXFSZ are ignored: writing then fails with EPIPE or EFBIG.

/// From now on a stopping signal removes half-written files, prints a message and ends the program with exit code 130.
void end_on_signals();

/// From now on a stopping signal calls request_stop(): the time loop stops cleanly after the step.
void stop_on_signals();

/// From now on a stopping signal is passed on to a child, as SIGTERM; the child stops cleanly, and this process waits.
/// @param child 0: none any more
void pass_signals_to(pid_t child);

/// Whether a stopping signal came after stop_on_signals().
bool was_signalled();

/// Runs a command that reads results files in a process of its own, because HDF5 may crash, or loop without end, in a
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

/// Runs scripts/picture on the table (HDF5) of a sweep and waits for it; where that is not there or fails a note says
/// so on standard output.
void draw_sweep(const std::string& table);

}  // namespace railwave
