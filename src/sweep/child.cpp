#include "sweep/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iostream>
#include <stdexcept>

#include <fmt/format.h>

#include "sweep/study.hpp"

namespace railwave::sweep {
namespace {

constexpr int not_started = 127;

sigset_t child_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  return set;
}

/// In the child, before anything else.
void settle_in(pid_t parent, const ChildPlace& place) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(failed);
  const int log = open(place.log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666), nothing = open("/dev/null", O_RDONLY);
  if (log < 0 || nothing < 0 || dup2(nothing, 0) < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0) _exit(not_started);
  close(log);
  close(nothing);
  const sigset_t set = child_signals();
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
  setenv("OMP_NUM_THREADS", std::to_string(place.threads).c_str(), 1);
  unsetenv("KOKKOS_NUM_THREADS");
}

pid_t fork_child(const std::string& log) {
  std::cout.flush();
  std::cerr.flush();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(fmt::format("no process could be had for {}: {}", log, std::strerror(errno)));
  return child;
}

}  // namespace

pid_t start_program(const std::vector<std::string>& arguments, const ChildPlace& place) {
  std::vector<std::string> words{"railwave"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = getpid(), child = fork_child(place.log);
  if (child != 0) return child;
  settle_in(parent, place);
  if (place.kept_open >= 0) fcntl(place.kept_open, F_SETFD, 0);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGHUP, SIG_IGN);
  execv("/proc/self/exe", pointers.data());
  _exit(not_started);
}

pid_t start_work(const std::function<int()>& work, const ChildPlace& place) {
  const pid_t parent = getpid(), child = fork_child(place.log);
  if (child != 0) return child;
  settle_in(parent, place);
  int code = failed;
  try {
    code = work();
  } catch (const std::exception& error) {
    std::cerr << "railwave: " << error.what() << std::endl;
  }
  std::cout.flush();
  _exit(code);  // nothing of the parent's is to be ended here
}

void hold_back_child_signals() {
  const sigset_t set = child_signals();
  sigprocmask(SIG_BLOCK, &set, nullptr);
}

ChildEnd wait_for_child(double seconds) {
  const sigset_t set = child_signals();
  for (int look = 0; look < 2; ++look) {
    int status = 0;
    rusage used{};
    const pid_t ended = wait4(-1, &status, WNOHANG, &used);
    if (ended > 0) {
      ChildEnd end;
      end.pid = ended;
      end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
      end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
      end.most_memory = 1024.0 * static_cast<double>(used.ru_maxrss);
      return end;
    }
    if (look == 1) break;
    timespec patience{static_cast<time_t>(seconds), static_cast<long>(1e9 * (seconds - std::floor(seconds)))};
    sigtimedwait(&set, nullptr, &patience);
  }
  return {};
}

}  // namespace railwave::sweep
