#include "sweep/attempt.hpp"

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/file_kind.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/results_file.hpp"
#include "post/results_reader.hpp"
#include "sweep/member_inputs.hpp"

namespace railwave::sweep {
namespace {

namespace fs = std::filesystem;

constexpr double patience = 600;  ///< s of processor time for one call of HDF5

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::string signal_text(int number) { return fmt::format("signal {} ({})", number, strsignal(number)); }

/// The first line, not too long for a table.
std::string one_line(const std::string& text) {
  constexpr std::size_t longest = 400;
  const std::string line = text.substr(0, text.find('\n'));
  return line.size() > longest ? line.substr(0, longest) + "..." : line;
}

constexpr int damaged = 4;  ///< how collect_row() ends where results cannot be read

void expect_whole_results(const std::string& path) try {
  hdf5::File::open(path).root().check_last();
} catch (const std::exception& error) {
  std::cerr << "railwave: " << error.what() << std::endl;
  _exit(damaged);
}

/// In a process of its own: reads what the run wrote and writes the row.
int collect_row(const Study& study, const Member& member) {
  hdf5::limit_calls(patience);
  const MemberFiles files(member);
  MemberRow row;
  row.figures_key = study.figures.key();
  if (study.figures.need_run()) {
    expect_whole_results(files.results());
    const ResultsReader results(files.results());
    if (!results.completed()) {
      row.status = Status::broke_down;
      row.reason = one_line(results.reason());
      write_row(member, row);
      return done;
    }
  }
  row.status = Status::completed;
  row.figures = collect(study.figures, files.results(), files.modes());
  write_row(member, row);
  return done;
}

void remove_results(const MemberFiles& files) {
  std::error_code ignored;
  for (const std::string& path : {files.results(), files.folder + "/results.xdmf"}) fs::remove(path, ignored);
}

/// What processes that were killed left beside what they wrote: locks that lock nothing, files that had not got their
/// names, checkpoints of a run that is complete. Nobody else writes here while the member is locked.
void remove_leftovers(const MemberFiles& files) {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator entry(files.folder, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const bool of_run = name.rfind("results.", 0) == 0;
    const bool unfinished = name.find(".new") != std::string::npos;
    if ((of_run && name.find(".lock") != std::string::npos) || (of_run && unfinished) ||
        name.rfind("results.checkpoint.h5", 0) == 0 || (name.rfind("row.toml", 0) == 0 && unfinished))
      leftovers.push_back(entry->path());
  }
  for (const fs::path& path : leftovers) fs::remove(path, ignored);
}

}  // namespace

Attempt::Attempt(const Study& study, const Member& member, MemberLock lock, int threads)
    : study_(study), member_(member), files_(member), lock_(std::move(lock)), threads_(threads) {}

double Attempt::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

void Attempt::begin() {
  began_ = std::chrono::steady_clock::now();
  note_attempt(member_, fmt::format("began with {} thread{}", threads_, threads_ == 1 ? "" : "s"));
  const bool runs = study_.figures.need_run() && !run_is_complete();
  start(runs ? Stage::run : after(Stage::run));
}

bool Attempt::run_is_complete() const {
  if (!is_there(files_.results())) return false;
  const auto root = hdf5::read_root_attributes(files_.results());
  return root && root->number("completed", 0) == 1;
}

Attempt::Stage Attempt::after(Stage stage) const {
  if (stage == Stage::run && study_.figures.need_modes()) return Stage::modes;
  return Stage::figures;
}

void Attempt::start(Stage stage) {
  stage_ = stage;
  std::error_code none;
  const auto size = fs::file_size(files_.log(), none);
  log_begins_ = none ? 0 : static_cast<long>(size);
  const ChildPlace place{files_.log(), threads_, lock_.descriptor()};
  if (stage == Stage::run) return start_run();
  if (stage == Stage::figures) {
    process_ = start_work([this] { return collect_row(study_, member_); }, place);
    return;
  }
  std::vector<std::string> words{"modes", study_.case_file};
  for (const std::string& one : member_.overrides) words.insert(words.end(), {"--set", one});
  for (const std::string& part : study_.figures.modes_parts) words.insert(words.end(), {"--part", part});
  words.insert(words.end(), {"--up-to", fmt::format("{}", study_.figures.modes_up_to), "--csv", files_.modes()});
  words.push_back("--overwrite");
  process_ = start_program(words, place);
}

void Attempt::start_run() {
  ran_ = true;
  std::vector<std::string> words{"run", study_.case_file};
  for (const std::string& one : member_.overrides) words.insert(words.end(), {"--set", one});
  const std::string checkpoint = files_.folder + "/results.checkpoint.h5";
  words.insert(words.end(), {"--set", "output.file=" + quoted(files_.results())});
  words.insert(words.end(), {"--set", "checkpoint.file=" + quoted(checkpoint)});
  if (member_.settles) {
    // What was interrupted amid settling must not be where another settles on from: its numbers would be others.
    words.insert(words.end(), {"--set", "settle.keep_unsettled=false"});
    words.insert(words.end(), {"--set", "settle.cache_folder=" + quoted(study_.folder + "/settled")});
  }
  restarted_ = !afresh_ && is_there(files_.results()) && (is_there(checkpoint) || is_there(checkpoint + ".previous"));
  words.push_back(restarted_ ? "--restart" : "--overwrite");
  process_ = start_program(words, {files_.log(), threads_, lock_.descriptor()});
}

/// The last line that the process said as a complaint; where there is none, its last line.
std::string Attempt::said_last() const {
  std::ifstream log(files_.log(), std::ios::binary);
  log.seekg(log_begins_);
  const std::string mark = "railwave: ";
  std::string last, complaint;
  for (std::string line; std::getline(log, line);) {
    if (line.empty()) continue;
    last = line;
    if (line.rfind(mark, 0) == 0) complaint = line.substr(mark.size());
  }
  return one_line(complaint.empty() ? last : complaint);
}

Attempt::Result Attempt::write_final_row(Status status, const std::string& reason) {
  reason_ = reason;
  MemberRow row;
  row.status = status;
  row.reason = reason;
  row.figures_key = study_.figures.key();
  write_row(member_, row);
  remove_leftovers(files_);
  note_attempt(member_, fmt::format("ended: {}: {}", status_names[static_cast<int>(status)], reason));
  return Result::row_written;
}

Attempt::Result Attempt::again(const std::string& reason) {
  reason_ = reason;
  note_attempt(member_, reason);
  return Result::again;
}

/// What the run made is of nobody knows which case, but somebody's work: it is kept under another name.
Attempt::Result Attempt::of_other_inputs() {
  std::error_code ignored;
  if (ran_) fs::rename(files_.results(), files_.folder + "/of_a_changed_case.h5", ignored);
  remove_leftovers(files_);
  reason_ = inputs_changed;
  note_attempt(member_, "failed: " + reason_);
  return Result::failed;
}

Attempt::Result Attempt::run_ended(const ChildEnd& end) {
  if (inputs_have_changed(study_, member_)) return of_other_inputs();
  if (end.code == done) {
    note_attempt(member_, stage_ == Stage::run ? "the run came to its end" : "the frequencies were found");
    start(after(stage_));
    return Result::goes_on;
  }
  if (end.code == wrong_input && restarted_) {  // a checkpoint that cannot be used
    afresh_ = true;
    note_attempt(member_, "could not go on from its checkpoint: " + said_last());
    start(Stage::run);
    return Result::goes_on;
  }
  if (end.code == wrong_input && said_last().find(disk_too_small) == std::string::npos)
    return write_final_row(Status::refused, said_last());
  if (end.code == broken_down && is_there(files_.results())) {
    note_attempt(member_, "the run broke down");
    start(Stage::figures);
    return Result::goes_on;
  }
  if (end.code == broken_down) return write_final_row(Status::broke_down, said_last());
  const std::string said = said_last();
  wanted_memory_ = said.find("out of memory") != std::string::npos;
  return again(fmt::format("failed with exit code {}: {}", end.code, said));
}

Attempt::Result Attempt::figures_ended(const ChildEnd& end) {
  if (end.code == damaged && !ran_) {
    note_attempt(member_, "its results cannot be read, it runs again: " + said_last());
    afresh_ = true;
    start(Stage::run);
    return Result::goes_on;
  }
  const auto row = read_row(member_);
  if (end.code != done || !row) {
    reason_ = said_last();
    note_attempt(member_, "its figures could not be collected: " + reason_);
    return Result::failed;
  }
  reason_ = row->reason;
  if (row->status == Status::completed && !study_.keep_results) remove_results(files_);
  remove_leftovers(files_);
  note_attempt(member_, fmt::format("ended: {}{}{}", status_names[static_cast<int>(row->status)],
                                    reason_.empty() ? "" : ": ", reason_));
  return Result::row_written;
}

Attempt::Result Attempt::advance(const ChildEnd& end, bool stopping) {
  process_ = 0;
  wanted_memory_ = end.signal == SIGKILL;
  if (end.signal != 0) return again("killed by " + signal_text(end.signal));
  if (end.code == interrupted) return again(stopping ? "stopped with the sweep" : "interrupted by a signal");
  return stage_ == Stage::figures ? figures_ended(end) : run_ended(end);
}

}  // namespace railwave::sweep
