#include "output/results_writer.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/disk.hpp"
#include "output/output_place.hpp"

namespace railwave {
namespace {

constexpr std::size_t largest_history_block = 4096;
constexpr std::chrono::seconds flush_interval{3};
// Of outputs that follow each other fast so many are flushed each, then so many a second.
constexpr double most_flushes = 20, flushes_a_second = 5;

std::string now_in_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// HDF5 locks a file that it writes; two runs with one results file would overwrite each other.
bool another_run_writes(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  const bool locked = flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(file);
  return locked;
}

/// So that a checkpoint is not taken for one of another run of the same case.
std::string own_name() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

bool any_beam(const std::vector<OutputSet>& sets) {
  return std::any_of(sets.begin(), sets.end(), [](const OutputSet& set) { return set.is_beam(); });
}

}  // namespace

void check_results_place(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw InputError(
        fmt::format("output.file: results go to {}, but there is no folder {}; make it, or name another file", path,
                    folder.string()));
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(fmt::format("output.file: {} is a folder; name a file, such as results.h5", path));
  if (access(folder.c_str(), W_OK) != 0)
    throw InputError(fmt::format("output.file: results go to {}, but the folder {} may not be written: {}", path,
                                 folder.string(), std::strerror(errno)));
  for (const std::string& name : {path, path + ".new"})
    if (another_run_writes(name))
      throw InputError(
          fmt::format("output.file: another run is writing {} now; wait for its end, or name another file", name));
}

std::string xdmf_path(const std::string& results_path) {
  return std::filesystem::path(results_path).replace_extension(".xdmf").string();
}

ResultsWriter::ResultsWriter(std::string path, RunDescription description, std::optional<ResultsSoFar> so_far)
    : path_(std::move(path)),
      description_(std::move(description)),
      xdmf_(xdmf_path(path_), std::filesystem::path(path_).filename().string(), description_.fields,
            kinds::results_xdmf(), description_.format.in_single),
      last_flush_(std::chrono::steady_clock::now()),
      counted_(last_flush_),
      flushes_left_(most_flushes) {
  check_results_place(path_);
  if (so_far)
    extend_file(*so_far);
  else
    create_file();
  const hdf5::Group root = file_.root();
  root.set_attribute("completed", 0L);
  root.set_attribute("reason", "the run has not ended, or was killed");
  std::vector<std::string> contact_names;
  for (const ContactDescription& contact : description_.contacts) contact_names.push_back(contact.name);
  history_ = std::make_unique<HistorySection>(root, contact_names, description_.history_sets, description_.beams,
                                              description_.history_positions, description_.loads,
                                              description_.history_askers, description_.history_motions,
                                              description_.element_histories, description_.prescribed_motions);
  root.create_group("fields");
  if (any_beam(description_.sets)) root.create_group("beams");
  root.create_group("contact");
  if (so_far) file_.flush();  // what was cut off is cut off before its places are taken
}

void ResultsWriter::create_file() {
  file_ = hdf5::File::create(path_, kinds::results());
  const hdf5::Group root = file_.root();
  root.set_attribute("format_version", 1L);
  root.set_attribute("program", "railwave " + description_.program_version);
  root.set_attribute("title", description_.title);
  root.set_attribute("case_file", description_.case_path);
  root.set_attribute("case_text", description_.case_text);
  root.set_attribute("start_time", now_in_utc());
  root.set_attribute("node_count", description_.node_count);
  root.set_attribute("element_count", description_.element_count);
  root.set_attribute("step_size", description_.step_size);
  root.set_attribute("end_time", description_.end_time);
  root.set_attribute("run", run_ = own_name());
  root.set_attribute("key", description_.key);
}

void ResultsWriter::leave(const hdf5::Group& group, const std::string& name, hsize_t entries) const {
  if (!group.has(name)) return;
  const hdf5::Group cut = group.group(name);
  if (const auto there = cut.least_entries(); there && *there < entries)
    throw std::runtime_error(fmt::format("{} has {} entries in {}, the checkpoint counts {}: it is not whole", path_,
                                         *there, name, entries));
  cut.cut(entries);
}

void ResultsWriter::extend_file(const ResultsSoFar& so_far) {
  file_ = hdf5::File::extend(path_);
  const hdf5::Group root = file_.root();
  run_ = root.text_attribute("run");
  leave(root, "history", static_cast<hsize_t>(so_far.history_rows));
  std::set<long> steps;  // of all outputs of fields
  const auto each_section = [&](const auto& one) {
    for (const char* kind : {"fields", "beams", "contact"})
      if (root.has(kind))
        for (const std::string& name : root.group(kind).names()) one(root.group(kind), name);
  };
  each_section([&](const hdf5::Group& group, const std::string& name) {
    const std::vector<long> own = group.group(name).dataset("step").read<long>();
    steps.insert(own.begin(), own.end());
  });
  const auto counted = static_cast<std::size_t>(so_far.field_outputs);
  if (!steps.empty() && steps.size() < counted)
    throw std::runtime_error(fmt::format("{} has {} outputs of fields, the checkpoint counts {}: it is not whole",
                                         path_, steps.size(), counted));
  each_section([&](const hdf5::Group& group, const std::string& name) {
    const std::vector<long> own = group.group(name).dataset("step").read<long>();
    const auto beyond = counted < steps.size()
                            ? std::lower_bound(own.begin(), own.end(), *std::next(steps.begin(), so_far.field_outputs))
                            : own.end();
    leave(group, name, static_cast<hsize_t>(beyond - own.begin()));
  });
  in_place_ = true;
  root.set_attribute("end_time", description_.end_time);
  root.set_attribute("restarts",
                     root.has_attribute("restarts") ? static_cast<long>(root.number_attribute("restarts")) + 1 : 1L);
}

void ResultsWriter::history(const HistorySample& sample) {
  history_->add(sample);
  if (history_->waiting() >= largest_history_block || std::chrono::steady_clock::now() - last_flush_ > flush_interval)
    flush();
}

void ResultsWriter::make_sections() {
  const hdf5::Group root = file_.root();
  for (const OutputSet& set : description_.sets)
    field_sections_.emplace_back(root.group(set.is_beam() ? "beams" : "fields"), set, description_.fields,
                                 description_.format);
  const ContactOutput& output = description_.contact_output;
  for (std::size_t i = 0; i < description_.contacts.size(); ++i) {
    const ContactDescription& contact = description_.contacts[i];
    contact_sections_.emplace_back(root.group("contact"), contact, static_cast<int>(i), output);
    auto& sides = contact_sides_.emplace_back();
    for (const bool slave : {true, false})
      if (const ContactSurface& surface = slave ? contact.slave_surface : contact.master_surface;
          output.has_side(slave) && !output.near_only())
        sides.push_back({contact.name, slave, surface.nodes.size(), surface.facets.size(), output.fields});
  }
  has_sections_ = true;
  describe_anew();
}

bool ResultsWriter::add_to_xdmf(double time, const OutputChoice& choice) {
  XdmfGrids grids;
  for (std::size_t s = 0; s < choice.sets.size(); ++s)
    if (choice.sets[s]) grids.sets.emplace_back(&description_.sets[s], set_outputs_[s]++);
  for (std::size_t c = 0; c < choice.contacts.size(); ++c) {
    if (!choice.contacts[c]) continue;
    for (const XdmfContactSide& side : contact_sides_[c]) grids.sides.emplace_back(&side, contact_outputs_[c]);
    ++contact_outputs_[c];
  }
  return (grids.sets.empty() && grids.sides.empty()) || xdmf_.add(time, outputs_++, grids);
}

bool ResultsWriter::report_earlier_times() {
  const hdf5::Group root = file_.root();
  const OutputChoice none = OutputChoice::none(description_.sets.size(), description_.contacts.size());
  std::map<long, Pending> outputs;  // by step
  const auto add = [&](const hdf5::Group& group, auto choose) {
    const auto steps = group.dataset("step").read<long>();
    const auto times = group.dataset("time").read<double>();
    for (std::size_t k = 0; k < times.size(); ++k) {
      Pending& output = outputs.emplace(steps.at(k), Pending{times[k], none}).first->second;
      choose(output.choice);
    }
  };
  for (std::size_t s = 0; s < description_.sets.size(); ++s)
    add(root.group(description_.sets[s].group()), [&](OutputChoice& choice) { choice.sets[s] = true; });
  for (std::size_t c = 0; c < description_.contacts.size(); ++c)
    add(root.group("contact").group(description_.contacts[c].name),
        [&](OutputChoice& choice) { choice.contacts[c] = true; });
  return std::all_of(outputs.begin(), outputs.end(),
                     [this](const auto& one) { return add_to_xdmf(one.second.time, one.second.choice); });
}

/// All outputs that the file has.
void ResultsWriter::describe_anew() {
  constexpr int most_tries = 3;  // whoever removed it does so again and again
  for (int tries = 0; tries < most_tries; ++tries) {
    xdmf_.begin_anew();
    outputs_ = 0;
    set_outputs_.assign(description_.sets.size(), 0);
    contact_outputs_.assign(description_.contacts.size(), 0);
    if (report_earlier_times()) return;
  }
  throw std::runtime_error(fmt::format("{} was removed each time it was written", xdmf_path(path_)));
}

CompressedRows ResultsWriter::pack(const FieldSource& source, const OutputChoice& choice) const {
  CompressedRows rows;
  for (std::size_t s = 0; s < field_sections_.size(); ++s)
    if (choice.sets[s]) field_sections_[s].add_rows(source, rows);
  for (std::size_t c = 0; c < contact_sections_.size(); ++c)
    if (choice.contacts[c]) contact_sections_[c].add_rows(source, rows);
  if (threads_) rows.pack(threads_());
  return rows;
}

void ResultsWriter::fields(const FieldSource& source, double time, long step, const OutputChoice& choice,
                           const CompressedRows& packed) {
  if (!has_sections_) make_sections();
  for (std::size_t s = 0; s < field_sections_.size(); ++s)
    if (choice.sets[s]) field_sections_[s].add_values(source, step, packed);
  for (std::size_t c = 0; c < contact_sections_.size(); ++c)
    if (choice.contacts[c]) contact_sections_[c].add_values(source, step, packed);
  pending_.push_back({time, choice});
  if (flush_is_due()) flush();
}

bool ResultsWriter::flush_is_due() {
  const auto now = std::chrono::steady_clock::now();
  flushes_left_ =
      std::fmin(most_flushes, flushes_left_ + flushes_a_second * std::chrono::duration<double>(now - counted_).count());
  counted_ = now;
  if (flushes_left_ < 1) return false;
  --flushes_left_;
  return true;
}

void ResultsWriter::flush() {
  if (const std::string done = file_.keep_name(); !done.empty()) report_at_once(done);
  history_->write();
  for (const Pending& output : pending_) {
    for (std::size_t s = 0; s < field_sections_.size(); ++s)
      if (output.choice.sets[s]) field_sections_[s].add_time(output.time);
    for (std::size_t c = 0; c < contact_sections_.size(); ++c)
      if (output.choice.contacts[c]) contact_sections_[c].add_time(output.time);
  }
  file_.flush();
  if (!in_place_) {
    file_.take_name();
    remove_own(xdmf_path(path_),
               kinds::results_xdmf());  // an older run's, which would name arrays that are no longer there
    in_place_ = true;
  }
  // Somebody may remove it between one look and the next.
  bool there = pending_.empty() || xdmf_.is_there();
  for (std::size_t k = 0; there && k < pending_.size(); ++k) there = add_to_xdmf(pending_[k].time, pending_[k].choice);
  if (!there) describe_anew();
  pending_.clear();
  last_flush_ = std::chrono::steady_clock::now();
}

void ResultsWriter::bring_to_disk() {
  flush();
  disk::bring_to_disk(path_);
}

void ResultsWriter::settled(double unbalance, int evaluations) {
  const hdf5::Group root = file_.root();
  root.set_attribute("settled_unbalance", unbalance);
  root.set_attribute("settling_evaluations", static_cast<long>(evaluations));
}

void ResultsWriter::end(const RunSummary& summary) {
  flush();
  const hdf5::Group root = file_.root();
  root.set_attribute("completed", summary.completed ? 1L : 0L);
  root.set_attribute("reason", summary.completed ? std::string("completed") : summary.reason);
  root.set_attribute("time_reached", summary.time);
  root.set_attribute("steps", summary.steps);
  root.set_attribute("step_size", summary.step_size);
  root.set_attribute("wall_seconds", summary.wall_seconds);
  root.set_attribute("output_seconds", summary.output_seconds);
  root.set_attribute("element_steps_per_second", summary.element_steps_per_second);
  root.set_attribute("left_out", summary.left_out);
  if (!summary.warnings.empty()) root.set_attribute("warnings", summary.warnings);
  history_.reset();
  field_sections_.clear();
  contact_sections_.clear();
  file_.close();
  disk::bring_to_disk(path_);  // before the checkpoints go
}

}  // namespace railwave
