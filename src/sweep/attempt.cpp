#include "sweep/attempt.hpp"

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/file_kind.hpp"
#include "post/results_reader.hpp"

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

/// In a process of its own: reads what the run wrote and writes the row.
int collect_row(const Study& study, const Member& member) {
  hdf5::limit_calls(patience);
  const MemberFiles files(member);
  MemberRow row;
  row.figures_key = study.figures.key();
  if (study.figures.need_run()) {
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
  std::vector<std::string> words{"run", study_.case_file};
  for (const std::string& one : member_.overrides) words.insert(words.end(), {"--set", one});
  words.insert(words.end(), {"--set", "output.file=\"" + files_.results() + '"'});
  words.insert(words.end(), {"--set", "checkpoint.file=\"" + files_.folder + "/results.checkpoint.h5\""});
  if (member_.settles) {
    // What was interrupted amid settling must not be where another settles on from: its numbers would be others.
    words.insert(words.end(), {"--set", "settle.keep_unsettled=false"});
    words.insert(words.end(), {"--set", "settle.cache_folder=\"" + study_.folder + "/settled\""});
  }
  const std::string checkpoint = files_.folder + "/results.checkpoint.h5";
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

Attempt::Result Attempt::run_ended(const ChildEnd& end) {
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
  if (end.code == wrong_input) return write_final_row(Status::refused, said_last());
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
