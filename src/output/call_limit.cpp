#include "output/hdf5/hdf5.hpp"

#include <sys/time.h>

#include <cmath>

namespace railwave::hdf5 {
namespace {

double limit = 0;  ///< s; 0: none
int depth = 0;     ///< calls within calls

/// Of the process's processor time; 0: takes the timer away.
void set_timer(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(std::floor(seconds));
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

void limit_calls(double seconds) { limit = seconds; }

LimitedCall::LimitedCall() {
  if (limit > 0 && depth++ == 0) set_timer(limit);
}

LimitedCall::~LimitedCall() {
  if (limit > 0 && --depth == 0) set_timer(0);
}

}  // namespace railwave::hdf5
