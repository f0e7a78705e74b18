#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "commands/process.hpp"
#include "output/hdf5/hdf5.hpp"

namespace railwave {
namespace {

constexpr int wrong_file = 2, failed = 1;

/// Processor seconds for one call of HDF5: disks and decompression are faster than this by far.
double patience(const std::vector<std::string>& files) {
  constexpr double least = 5, bytes_a_second = 5e6;
  double most = 0;
  for (const std::string& file : files) {
    std::error_code none;
    const auto size = std::filesystem::file_size(file, none);
    if (!none) most = std::max(most, static_cast<double>(size));
  }
  return least + most / bytes_a_second;
}

void limit_child(const std::vector<std::string>& files) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // What a damaged file claims is refused by the system, before another process suffers from it.
  rlimit limit{};
  const double left = available_memory();
  if (left < 1e18 && getrlimit(RLIMIT_AS, &limit) == 0) {
    constexpr double own = 1e9;  // address space that is taken already, and more
    limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(left + own));
    setrlimit(RLIMIT_AS, &limit);
  }
#endif
  std::signal(SIGPROF, SIG_DFL);
  hdf5::limit_calls(patience(files));
}

/// What to say of a child that a signal ended; empty: nothing, it was the user's doing.
std::string verdict(int by, const std::string& command, const std::vector<std::string>& files) {
  const std::string which =
      files.size() == 1 ? files.front() + " is damaged" : fmt::format("one of {} is damaged", fmt::join(files, ", "));
  const char* const mend = "copy it again, or repeat the run; h5dump -d tells what of it can still be read";
  if (by == SIGPROF || by == SIGXCPU)
    return fmt::format("{}: {} came to no end when it read it; {}", which, command, mend);
  for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGSYS, SIGTRAP})
    if (by == crash)
      return fmt::format("{}: the HDF5 library crashed ({}) when {} read it; {}", which, strsignal(by), command, mend);
  return {};
}

int wait_for(pid_t child, const std::string& command, const std::vector<std::string>& files) {
  int status = 0;
  pass_signals_to(child);
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw std::runtime_error(
          fmt::format("{}: waiting for the process that reads: {}", command, std::strerror(errno)));
  pass_signals_to(0);
  if (!WIFSIGNALED(status)) return WEXITSTATUS(status);
  const int by = WTERMSIG(status);
  if (const std::string text = verdict(by, command, files); !text.empty()) {
    std::cerr << "railwave: " << text << std::endl;
    return wrong_file;
  }
  if (by == SIGKILL) {
    std::cerr << "railwave: " << rank_for_messages() << command
              << " was killed, by you or by the system where it has no memory left" << std::endl;
    return failed;
  }
  // As the child ended, so do we: the shell is to see it.
  std::signal(by, SIG_DFL);
  raise(by);
  return 128 + by;
}

/// @return the child's process number; 0 in the child
pid_t fork_reader(const std::string& command, const std::vector<std::string>& files) {
  std::cout.flush();
  std::cerr.flush();
  const pid_t parent = getpid(), child = fork();
  if (child < 0)
    throw std::runtime_error(fmt::format("{}: no process could be had for reading: {}", command, std::strerror(errno)));
  if (child == 0) {
    limit_child(files);
    if (getppid() != parent) _exit(failed);
  }
  return child;
}

/// What a damaged file leads to need not know of the file.
std::string with_files(const std::string& text, const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (text.find(file) != std::string::npos) return text;
  return fmt::format("{} (results file {})", text, fmt::join(files, ", "));
}

int work_naming_files(const std::vector<std::string>& files, const std::function<int()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(with_files(error.what(), files));
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    throw std::runtime_error(with_files(error.what(), files));
  }
}

}  // namespace

int in_reading_child(const std::string& command, const std::vector<std::string>& files,
                     const std::function<int()>& work) {
  const pid_t child = fork_reader(command, files);
  return child == 0 ? work_naming_files(files, work) : wait_for(child, command, files);
}

std::optional<int> after_reading_in_child(const std::string& command, const std::vector<std::string>& files,
                                          const std::function<void()>& read) {
  const pid_t child = fork_reader(command, files);
  if (child == 0) {
    read();
    return 0;
  }
  const int code = wait_for(child, command, files);
  return code == 0 ? std::nullopt : std::optional<int>(code);
}

}  // namespace railwave
