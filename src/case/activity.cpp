#include "case/activity.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>

#include <sys/time.h>
#include <unistd.h>

namespace railwave {
namespace {

constexpr int deepest = 8, longest = 200;
constexpr int first_after = 3, then_every = 10;  // s

/// Texts of the activities, outermost first. The handler reads the innermost one; its text is complete before `depth`
/// names it.
char texts[deepest][longest + 1];
std::atomic<int> depth{0};
timespec began;

int digits_of(long number, char* to) {
  char backwards[24];
  int count = 0;
  do backwards[count++] = static_cast<char>('0' + number % 10);
  while ((number /= 10) > 0);
  for (int i = 0; i < count; ++i) to[i] = backwards[count - 1 - i];
  return count;
}

/// Only what a signal handler may call: no memory, no streams.
void on_alarm(int) {
  const int saved = errno;
  const int shown = std::min(depth.load(std::memory_order_acquire), deepest);
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  char line[longest + 64];
  int length = 0;
  const auto add = [&](const char* text) {
    for (; *text != 0 && length < static_cast<int>(sizeof line) - 1; ++text) line[length++] = *text;
  };
  add("railwave: ");
  length += digits_of(now.tv_sec - began.tv_sec, line + length);
  add(" s so far: ");
  add(shown > 0 ? texts[shown - 1] : "working");
  line[length++] = '\n';
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line, static_cast<std::size_t>(length));
  errno = saved;
}

void set_timer(int first, int interval) {
  itimerval timer{};
  timer.it_value.tv_sec = first;
  timer.it_interval.tv_sec = interval;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

Activity::Activity(const std::string& what) : place_(depth.load()) {
  if (place_ < deepest) {
    const std::size_t count = std::min<std::size_t>(what.size(), longest);
    std::memcpy(texts[place_], what.data(), count);
    texts[place_][count] = 0;
  }
  depth.store(place_ + 1, std::memory_order_release);
}

Activity::~Activity() { depth.store(place_, std::memory_order_release); }

PatienceTimer::PatienceTimer() {
  clock_gettime(CLOCK_MONOTONIC, &began);
  struct sigaction action {};
  action.sa_handler = on_alarm;
  action.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &action, nullptr);
  set_timer(first_after, then_every);
}

void PatienceTimer::stop() { set_timer(0, 0); }

}  // namespace railwave
