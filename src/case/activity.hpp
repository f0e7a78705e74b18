#pragma once

#include <string>

/// What the program is doing at the moment, for those who wait: a command that takes long says so on the standard
/// error, on a terminal and in a log alike, and one that is quick says nothing.
namespace railwave {

/// While it lives, `what` is being done: "making the mesh of part wheel, about 1.2 million elements". An activity
/// inside another one stands in for it. At most 200 letters are shown. Costs a copy of the text; may be used with or
/// without a PatienceTimer.
class Activity {
 public:
  explicit Activity(const std::string& what);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

 private:
  int place_;
};

/// While it lives, what takes longer than some three seconds is reported on the standard error, then every ten seconds,
/// as "railwave: 13 s so far: ACTIVITY". By a timer of the system (SIGALRM), whose handler only writes: no thread and
/// no memory are needed. Ends before a run's steps begin, which have progress lines of their own.
class PatienceTimer {
 public:
  PatienceTimer();
  ~PatienceTimer() { stop(); }
  PatienceTimer(const PatienceTimer&) = delete;
  PatienceTimer& operator=(const PatienceTimer&) = delete;
  /// Nothing is reported any more.
  void stop();
};

}  // namespace railwave
