#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/disk.hpp"
#include "sweep/figure.hpp"
#include "sweep/study.hpp"

namespace railwave::sweep {

/// How a member ended. The first three stay: the same case would end so again.
enum class Status { completed, broke_down, refused, failed, killed, not_run };
inline constexpr const char* status_names[] = {"completed", "broke down", "refused", "failed", "killed", "not run"};

/// What is known of a member.
struct MemberRow {
  Status status = Status::not_run;
  std::string reason;  ///< why it did not complete; one line
  std::string figures_key;
  std::vector<FigureValue> figures;

  bool final() const { return status <= Status::refused; }
};

/// Files of a member, in its folder.
struct MemberFiles {
  explicit MemberFiles(const Member& member) : folder(member.folder) {}
  std::string folder;
  std::string row() const { return folder + "/row.toml"; }
  std::string results() const { return folder + "/results.h5"; }
  std::string modes() const { return folder + "/modes.csv"; }
  std::string log() const { return folder + "/log.txt"; }
  std::string attempts() const { return folder + "/attempts.txt"; }
  std::string lock() const { return folder + "/member.lock"; }
};

/// A text as TOML has it.
std::string quoted(const std::string& text);

/// Writes the row, whole or not at all, and brings it to the disk.
void write_row(const Member& member, const MemberRow& row);

/// The row of a member that has ended; nothing: it has none, or a damaged one, which counts as none.
std::optional<MemberRow> read_row(const Member& member);

/// Whether nothing remains to be done: it has its row, and that is of the study's figures, unless the run itself broke
/// down.
bool is_done(const Study& study, const Member& member);

/// What is in the way where the member's row is to be: a file that is none; empty: nothing is.
std::string in_the_way_of_row(const Member& member);

/// Adds a line to the member's attempts: when, where, and what happened.
void note_attempt(const Member& member, const std::string& what);

/// The last line of the member's attempts; empty: there was none.
std::string last_attempt(const Member& member);

/// Keeps other sweeps of the study off a member: a file that is locked (flock) as long as this object, or a process
/// that was started meanwhile and has inherited the descriptor, lives. So a member whose sweep was killed is free again
/// only when its run has ended too. What a killed sweep leaves of the file locks nothing.
class MemberLock {
 public:
  /// @return nothing: another sweep has the member now. Throws std::runtime_error if the system refuses.
  static std::optional<MemberLock> take(const std::string& path);
  MemberLock(MemberLock&&) noexcept;
  MemberLock& operator=(MemberLock&&) = delete;
  ~MemberLock();
  int descriptor() const { return file_.get(); }

 private:
  MemberLock(std::string path, disk::Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}
  std::string path_;
  disk::Descriptor file_;
};

}  // namespace railwave::sweep
