#include "commands/process.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "output/atomic_file.hpp"
#include "solve/time_loop.hpp"

namespace railwave {
namespace {

constexpr int of_stopping[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2};
constexpr int interrupted = 130;

/// Set in one thread, and read in whichever the signal interrupts.
std::atomic<int> running{0}, signalled{0};
std::atomic<pid_t> child_at_work{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free);

/// Only what a handler may call.
void on_signal(int) {
  const int before = errno;
  if (child_at_work > 0) {
    kill(child_at_work, SIGTERM);
    errno = before;
    return;
  }
  if (running == 0) {
    remove_unfinished();
    constexpr const char* text = "railwave: interrupted before its work was done; no half-written file is left\n";
    const auto written = write(STDERR_FILENO, text, std::strlen(text));
    static_cast<void>(written);
    _exit(interrupted);
  }
  signalled = 1;
  request_stop();
  errno = before;
}

}  // namespace

void end_on_signals() {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  struct sigaction handled {};
  handled.sa_handler = on_signal;
  handled.sa_flags = SA_RESTART;
  sigemptyset(&handled.sa_mask);
  for (const int one : of_stopping) sigaddset(&handled.sa_mask, one);
  for (const int one : of_stopping) {
    struct sigaction before {};
    if (sigaction(one, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(one, &handled, nullptr);
  }
}

void stop_on_signals() { running = 1; }

void pass_signals_to(pid_t child) { child_at_work = child; }

bool was_signalled() { return signalled != 0; }

}  // namespace railwave
