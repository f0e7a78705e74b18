#include "commands/process.hpp"

#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

#include "output/atomic_file.hpp"

namespace railwave {
namespace {

std::atomic<bool> sudden{false};

/// Allocates nothing: there may be nothing left.
void report_sudden_end() {
  if (!sudden) return;
  remove_unfinished();
  constexpr const char* text =
      "railwave: out of memory: a library found none and ended the program; take a coarser mesh or fewer outputs, or "
      "see what else takes memory; "
      "a run that had written a checkpoint goes on from it with --restart\n";
  const auto written = write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(written);
  _exit(1);
}

}  // namespace

NoSuddenExit::NoSuddenExit() {
  static const int registered = std::atexit(report_sudden_end);
  sudden = registered == 0;
}

NoSuddenExit::~NoSuddenExit() { sudden = false; }

}  // namespace railwave
