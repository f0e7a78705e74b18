#include "commands/process.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

namespace railwave {
namespace {

constexpr std::size_t usual_stack = 8 << 20;

}  // namespace

int with_enough_stack(const std::function<int()>& program) {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= smallest_stack)
    return program();
  // By this limit the C library also sizes the stacks of threads.
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) == 0) {
    if (pthread_attr_setstacksize(&attributes, usual_stack) == 0) pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);
  }
  int code = 1;
  const pid_t self = getpid();
  std::thread([&] {
    code = program();
    if (getpid() != self) std::exit(code);  // a child that was forked in there has no other thread that could return
  }).join();
  return code;
}

}  // namespace railwave
