#include "output/results_writer.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include "case/error.hpp"
#include "output/disk.hpp"
#include "output/output_place.hpp"

namespace railwave {
namespace {

constexpr std::size_t largest_history_block = 4096;
constexpr std::chrono::seconds flush_interval{3};

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
      xdmf_(xdmf_path(path_), std::filesystem::path(path_).filename().string(), description_.fields),
      last_flush_(std::chrono::steady_clock::now()) {
  check_results_place(path_);
  if (so_far)
    extend_file(*so_far);
  else
    create_file();
  const hdf5::Group root = file_.root();
  root.set_attribute("completed", 0L);
  root.set_attribute("reason", "the run has not ended, or was killed");
  std::vector<std::string> contact_names;
  for (const ContactNames& contact : description_.contacts) contact_names.push_back(contact.name);
  history_ = std::make_unique<HistorySection>(
      root, contact_names, description_.history_sets, description_.beams, description_.history_positions,
      description_.loads, description_.history_askers, description_.history_motions, description_.element_histories);
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

void ResultsWriter::extend_file(const ResultsSoFar& so_far) {
  file_ = hdf5::File::extend(path_);
  const hdf5::Group root = file_.root();
  run_ = root.text_attribute("run");
  const auto leave = [&](const char* name, long entries) {
    if (!root.has(name)) return;
    const hdf5::Group group = root.group(name);
    const auto there = group.least_entries();
    if (there && *there < static_cast<hsize_t>(entries))
      throw std::runtime_error(fmt::format("{} has {} entries in /{}, the checkpoint counts {}: it is not whole", path_,
                                           *there, name, entries));
    group.cut(static_cast<hsize_t>(entries));
  };
  leave("history", so_far.history_rows);
  for (const char* name : {"fields", "beams", "contact"}) leave(name, so_far.field_outputs);
  outputs_ = static_cast<std::size_t>(so_far.field_outputs);
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

void ResultsWriter::create_sections(const FieldSource& source) {
  const hdf5::Group fields_group = file_.root().group("fields"), contacts_group = file_.root().group("contact");
  for (const OutputSet& set : description_.sets) {
    if (set.is_beam())
      field_sections_.emplace_back(file_.root().group("beams"), set, description_.fields);
    else
      field_sections_.emplace_back(fields_group, set, description_.fields);
  }
  for (std::size_t i = 0; i < description_.contacts.size(); ++i) {
    const ContactSection& section =
        contact_sections_.emplace_back(contacts_group, source, static_cast<int>(i), description_.contact_margin);
    const ContactNames& names = description_.contacts[i];
    const hdf5::Group group = contacts_group.group(names.name);
    group.group("slave").set_attribute("surface", names.slave);
    const hdf5::Group master = group.group("master");
    master.set_attribute("surface", names.master.text());
    if (names.master.size() > 1) {
      master.set_attribute("surfaces", names.master.list());
      std::vector<int> surface_of_facet;
      for (std::size_t k = 0; k < names.master_facets.size(); ++k)
        surface_of_facet.insert(surface_of_facet.end(), names.master_facets[k], static_cast<int>(k));
      master.write("surface_of_facet", surface_of_facet, {surface_of_facet.size()});
    }
    for (const bool slave : {true, false})
      contact_sides_.push_back({names.name, slave, section.node_count(slave), section.facet_count(slave)});
  }
  has_sections_ = true;
  if (outputs_ > 0) report_earlier_times();
}

void ResultsWriter::report_earlier_times() {
  if (description_.sets.empty() && contact_sides_.empty()) return;
  const std::string group =
      description_.sets.empty() ? "/contact/" + contact_sides_.front().contact : description_.sets.front().group();
  const auto times = file_.root().dataset(group + "/time").read<double>();
  for (std::size_t k = 0; k < outputs_; ++k) xdmf_.add(times.at(k), k, description_.sets, contact_sides_);
}

void ResultsWriter::fields(const FieldSource& source, double time, long step) {
  if (!has_sections_) create_sections(source);
  for (FieldSection& section : field_sections_) section.add_values(source, step);
  for (ContactSection& section : contact_sections_) section.add_values(source, step);
  flush(time);
  if (!xdmf_.is_there()) {
    xdmf_.begin_anew();
    report_earlier_times();
  }
  if (!description_.sets.empty() || !contact_sides_.empty())
    xdmf_.add(time, outputs_, description_.sets, contact_sides_);
  ++outputs_;
}

void ResultsWriter::flush(std::optional<double> time) {
  if (const std::string done = file_.keep_name(); !done.empty()) report_at_once(done);
  history_->write();
  if (time) {
    for (FieldSection& section : field_sections_) section.add_time(*time);
    for (ContactSection& section : contact_sections_) section.add_time(*time);
  }
  file_.flush();
  if (!in_place_) {
    file_.take_name();
    remove_own(xdmf_path(path_),
               kinds::results_xdmf());  // an older run's, which would name arrays that are no longer there
    in_place_ = true;
  }
  last_flush_ = std::chrono::steady_clock::now();
}

void ResultsWriter::bring_to_disk() {
  flush();
  disk::bring_to_disk(path_);
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
