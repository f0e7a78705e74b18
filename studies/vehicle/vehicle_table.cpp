#include "vehicle_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace railwave::vehicle {
namespace {

/// A file that is there whole or not at all.
class WholeFile {
 public:
  explicit WholeFile(std::string path) : path_(std::move(path)), file_(std::fopen((path_ + ".new").c_str(), "w")) {
    if (file_ == nullptr) fail();
  }
  ~WholeFile() {
    if (file_ != nullptr) std::fclose(file_);
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void line(const std::string& text) { sound_ = std::fprintf(file_, "%s\n", text.c_str()) > 0 && sound_; }

  void finish() {
    sound_ = std::fclose(file_) == 0 && sound_;
    file_ = nullptr;
    if (!sound_) fail();
    std::filesystem::rename(path_ + ".new", path_);
  }

 private:
  [[noreturn]] void fail() const { throw std::runtime_error(path_ + " cannot be written; is its folder there?"); }

  std::string path_;
  std::FILE* file_;
  bool sound_ = true;
};

std::string text(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.17g", value);
  return digits;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ",") + word;
  return line;
}

void add_axes(std::vector<std::string>& columns, const std::string& name, const std::string& unit) {
  for (const char* axis : {"_x_", "_y_", "_z_"}) columns.push_back(name + axis + unit);
}

}  // namespace

std::vector<double> table_row(const CoupledSample& sample) {
  std::vector<double> row{sample.motion.time};
  for (const Vector* one : {&sample.motion.displacement, &sample.motion.velocity, &sample.force, &sample.bogie.frame})
    row.insert(row.end(), one->begin(), one->end());
  row.insert(row.end(), {sample.bogie.pitch, sample.wheelset_work, sample.bogie_work});
  row.insert(row.end(), sample.histories.begin(), sample.histories.end());
  return row;
}

VehicleTable::VehicleTable(const Simulation& simulation, const std::vector<std::string>& histories) {
  columns_ = {"time_s"};
  add_axes(columns_, "displacement", "m");
  add_axes(columns_, "velocity", "m_per_s");
  add_axes(columns_, "force", "N");
  add_axes(columns_, "frame", "m");
  columns_.insert(columns_.end(), {"pitch_rad", "wheelset_work_J", "bogie_work_J"});
  for (const std::string& name : histories) {
    const std::size_t count = simulation.values(name).size();
    for (std::size_t i = 0; i < count; ++i)
      columns_.push_back(count == 3 ? name + "." + "xyz"[i] : count == 1 ? name : name + "." + std::to_string(i));
  }
}

void VehicleTable::add(const CoupledSample& sample) { samples_.push_back(sample); }

EnergyClosure VehicleTable::closure() const {
  EnergyClosure closure;
  for (const CoupledSample& sample : samples_) {
    closure.largest = std::max({closure.largest, std::fabs(sample.wheelset_work), std::fabs(sample.bogie_work)});
    closure.difference = std::max(closure.difference, std::fabs(sample.wheelset_work + sample.bogie_work));
  }
  return closure;
}

void VehicleTable::write(const std::string& path) const {
  WholeFile file(path);
  file.line(joined(columns_));
  for (const CoupledSample& sample : samples_) {
    std::vector<std::string> words;
    for (double value : table_row(sample)) words.push_back(text(value));
    file.line(joined(words));
  }
  file.finish();
}

void VehicleTable::write_curves(const std::string& folder, const Interface& interface) const {
  for (int i = 0; i < 3; ++i) {
    if (interface.loads[i].empty()) continue;
    WholeFile file((std::filesystem::path(folder) / (interface.loads[i] + ".csv")).string());
    file.line("time_s,force_N");
    for (const CoupledSample& sample : samples_) file.line(text(sample.motion.time) + "," + text(sample.force[i]));
    file.finish();
  }
}

}  // namespace railwave::vehicle
