#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "sweep/child.hpp"
#include "sweep/member_row.hpp"
#include "sweep/study.hpp"

namespace railwave::sweep {

/// Why a member is left to the next sweep.
inline constexpr const char* inputs_changed =
    "the case or a file that it names was changed after the sweep had begun; sweep again";

/// One try to bring a member to its row: the run, its natural frequencies, then the figures, each a process of its own,
/// as far as they are needed and not there yet.
class Attempt {
 public:
  /// What came of a process that has ended.
  enum class Result { goes_on, row_written, again, failed };

  Attempt(const Study& study, const Member& member, MemberLock lock, int threads);

  /// Starts the first process.
  void begin();

  /// After the process has ended: starts the next, or says how the attempt ended.
  Result advance(const ChildEnd& end, bool stopping);

  const Member& member() const { return member_; }
  pid_t process() const { return process_; }
  int threads() const { return threads_; }
  double seconds() const;
  /// Whether the last process may have been ended for want of memory.
  bool wanted_memory() const { return wanted_memory_; }
  const std::string& reason() const { return reason_; }

 private:
  enum class Stage { run, modes, figures, done };
  void start(Stage stage);
  void start_run();
  Stage after(Stage stage) const;
  bool run_is_complete() const;
  Result run_ended(const ChildEnd& end);
  Result figures_ended(const ChildEnd& end);
  Result of_other_inputs();
  Result write_final_row(Status status, const std::string& reason);
  Result again(const std::string& reason);
  std::string said_last() const;

  const Study& study_;
  const Member& member_;
  MemberFiles files_;
  MemberLock lock_;
  int threads_;
  Stage stage_ = Stage::done;
  bool afresh_ = false, restarted_ = false, ran_ = false, wanted_memory_ = false;
  long log_begins_ = 0;  ///< where the log of the present process begins
  pid_t process_ = 0;
  std::string reason_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace railwave::sweep
