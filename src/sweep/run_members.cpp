#include "sweep/run_members.hpp"

#include <algorithm>
#include <csignal>
#include <deque>
#include <filesystem>
#include <list>
#include <map>
#include <ostream>
#include <thread>

#include <fmt/format.h>

#include "case/error.hpp"
#include "case/memory.hpp"
#include "sweep/attempt.hpp"
#include "sweep/member_inputs.hpp"

namespace railwave::sweep {
namespace {

using Clock = std::chrono::steady_clock;

/// Members as processes side by side.
class SideBySide {
 public:
  SideBySide(const Study& study, const std::vector<const Member*>& members, const RunOptions& options,
             std::ostream& out)
      : study_(study), options_(options), out_(out), all_(members.size()), memory_(available_memory()) {
    for (const Member* member : members) {
      if (is_done(study, *member))
        ++done_;
      else
        waiting_.push_back(member);
    }
    if (done_ > 0) out_ << fmt::format("{} of {} members are done already\n", done_, all_) << std::flush;
  }

  bool run() {
    hold_back_child_signals();
    bool stopping = false;
    while (!running_.empty() || (!stopping && !(waiting_.empty() && others_.empty() && again_.empty()))) {
      if (!stopping && options_.stopped()) {
        stopping = true;
        out_ << "stopping: members that run write their checkpoints\n" << std::flush;
        for (const Attempt& one : running_) kill(one.process(), SIGTERM);
      }
      if (!stopping) start_what_fits();
      constexpr double patience = 0.2;  // s: how often members of other sweeps are looked at
      const ChildEnd end = wait_for_child(patience);
      if (end.pid != 0) take(end, stopping);
    }
    return stopping;
  }

 private:
  void start_what_fits() {
    look_at_others();
    while (!waiting_.empty() || (running_.empty() && !again_.empty())) {
      const bool alone = waiting_.empty();  // what was killed runs last, with the machine for itself
      std::deque<const Member*>& queue = alone ? again_ : waiting_;
      const Member* member = queue.front();
      const std::size_t at_once = std::min(queue.size() + running_.size(), fitting_into_memory(*member));
      const Sharing sharing = share_processors(processors(), alone ? 1 : at_once, options_);
      const int threads = std::max(1, std::min(sharing.threads, processors() - threads_running()));
      if (static_cast<int>(running_.size()) >= sharing.jobs || !memory_allows(*member)) return;
      queue.pop_front();
      start(*member, options_.threads > 0 ? options_.threads : threads);
    }
  }

  void start(const Member& member, int threads) try {
    std::filesystem::create_directories(member.folder);
    auto lock = MemberLock::take(MemberFiles(member).lock());
    if (!lock) {
      if (!waited_) out_ << "some members are run by another sweep of this study now\n" << std::flush;
      waited_ = true;
      others_.push_back({&member, Clock::now()});
      return;
    }
    if (is_done(study_, member)) {  // by another sweep, meanwhile
      ++done_;
      return;
    }
    if (inputs_have_changed(study_, member)) return leave(member, inputs_changed);
    if (const std::string other = in_the_way_of_row(member); !other.empty()) return leave(member, other);
    running_.emplace_back(study_, member, std::move(*lock), threads);
    ++attempts_[member.number];
    running_.back().begin();
  } catch (const std::exception& error) {  // of the system, about the member's folder
    if (!running_.empty() && &running_.back().member() == &member && running_.back().process() == 0)
      running_.pop_back();
    report(member, error.what(), 0);
  }

  /// To the next sweep.
  void leave(const Member& member, const std::string& why) {
    note_attempt(member, "failed: " + why);
    report(member, why, 0);
  }

  void report(const Member& member, const std::string& what, double seconds) {
    out_ << fmt::format("[{}/{}] member {} ({}): {}, {:.1f} s\n", done_, all_, member.number, member.called, what,
                        seconds)
         << std::flush;
  }

  /// Members that another sweep of this study had: it may have ended, or been killed.
  void look_at_others() {
    for (std::size_t left = others_.size(); left > 0; --left) {
      const auto [member, since] = others_.front();
      others_.pop_front();
      constexpr std::chrono::milliseconds interval(200);
      if (Clock::now() - since < interval)
        others_.push_back({member, since});
      else
        waiting_.push_back(member);
    }
  }

  void take(const ChildEnd& end, bool stopping) {
    const auto found =
        std::find_if(running_.begin(), running_.end(), [&](const Attempt& one) { return one.process() == end.pid; });
    if (found == running_.end()) return;
    largest_ratio_ = std::max(largest_ratio_, end.most_memory / found->member().memory);
    const Attempt::Result result = found->advance(end, stopping);
    if (result == Attempt::Result::goes_on) return;
    const Member& member = found->member();
    const bool may_again = result == Attempt::Result::again && attempts_[member.number] <= options_.retries;
    if (result == Attempt::Result::row_written) ++done_;
    std::string what = found->reason();
    if (result == Attempt::Result::row_written && what.empty()) what = "completed";
    if (may_again && !stopping) what += "; it runs again";
    report(member, what, found->seconds());
    const bool alone = found->wanted_memory();
    running_.erase(found);
    if (may_again && !stopping) (alone ? again_ : waiting_).push_back(&member);
  }

  /// Bytes. What members took so far corrects the estimate, in either direction once one has ended.
  double memory_of(const Member& member) const {
    constexpr double more = 1.1;
    return (largest_ratio_ > 0 ? more * largest_ratio_ : 1) * member.memory;
  }

  std::size_t fitting_into_memory(const Member& member) const {
    constexpr double most = 1e6;
    return static_cast<std::size_t>(std::clamp(memory_ / memory_of(member), 1.0, most));
  }

  bool memory_allows(const Member& next) const {
    if (running_.empty()) return true;
    double sum = memory_of(next);
    for (const Attempt& one : running_) sum += memory_of(one.member());
    return sum <= memory_;
  }

  int threads_running() const {
    int sum = 0;
    for (const Attempt& one : running_) sum += one.threads();
    return sum;
  }

  static int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

  struct Elsewhere {
    const Member* member;
    Clock::time_point since;
  };

  const Study& study_;
  const RunOptions& options_;
  std::ostream& out_;
  std::size_t all_, done_ = 0;
  double memory_, largest_ratio_ = 0;
  bool waited_ = false;
  std::deque<const Member*> waiting_, again_;
  std::deque<Elsewhere> others_;
  std::list<Attempt> running_;
  std::map<int, int> attempts_;  ///< by number
};

}  // namespace

Sharing share_processors(int processors, std::size_t members, const RunOptions& options) {
  Sharing sharing;
  const int most = std::max(1, static_cast<int>(std::min<std::size_t>(members, 100000)));
  if (options.jobs > 0) {
    sharing.jobs = options.jobs;
    sharing.threads = options.threads > 0 ? options.threads : std::max(1, processors / std::min(options.jobs, most));
  } else if (options.threads > 0) {
    sharing.threads = options.threads;
    sharing.jobs = std::max(1, processors / options.threads);
  } else {
    sharing.jobs = std::min(processors, most);
    sharing.threads = std::max(1, processors / sharing.jobs);
  }
  return sharing;
}

Tally run_members(const Study& study, const std::vector<const Member*>& members, const RunOptions& options,
                  std::ostream& out) {
  const bool stopped = SideBySide(study, members, options, out).run();
  Tally tally = tally_of(study, members);
  tally.stopped = stopped;
  return tally;
}

Tally tally_of(const Study& study, const std::vector<const Member*>& members) {
  Tally tally;
  for (const Member* member : members) {
    const auto row = read_row(*member);
    const bool done = is_done(study, *member);
    if (!done)
      ++tally.unfinished;
    else if (row->status == Status::completed)
      ++tally.completed;
    else if (row->status == Status::broke_down)
      ++tally.broke_down;
    else
      ++tally.refused;
  }
  return tally;
}

}  // namespace railwave::sweep
