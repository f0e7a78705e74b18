#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

/// Processes that a sweep starts. They end when the sweep is killed, and their output goes to the end of a file.
namespace railwave::sweep {

struct ChildPlace {
  std::string log;     ///< file that standard output and error are added to
  int threads = 1;     ///< of OpenMP
  int kept_open = -1;  ///< descriptor that a program inherits too: of the member's lock
};

/// Starts this program with other arguments. Signals of the terminal (ctrl-C, its end) do not reach it: the sweep stops
/// it by SIGTERM. Throws std::runtime_error if no process can be had.
pid_t start_program(const std::vector<std::string>& arguments, const ChildPlace& place);

/// Does `work` in a process of its own and ends it with the code that this returns; 1, with a message, for what it
/// throws.
pid_t start_work(const std::function<int()>& work, const ChildPlace& place);

/// How a process ended.
struct ChildEnd {
  pid_t pid = 0;
  int code = 0;            ///< if no signal ended it
  int signal = 0;          ///< that ended it
  double most_memory = 0;  ///< bytes that it had at most
};

/// SIGCHLD waits from now on until wait_for_child() takes it.
void hold_back_child_signals();

/// The next of them that has ended, or none (pid 0) when so many seconds have passed or another signal came.
ChildEnd wait_for_child(double seconds);

}  // namespace railwave::sweep
