#pragma once

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/checkpoint_file.hpp"
#include "output/fields/contact_section.hpp"
#include "output/fields/field_section.hpp"
#include "output/fields/xdmf.hpp"
#include "output/histories/history_section.hpp"

namespace railwave {

/// What a results file says of the run as a whole.
struct RunDescription {
  std::string program_version;
  std::string title;
  std::string case_path;
  std::string case_text;  ///< the case file as it was read
  double step_size = 0;   ///< s
  double end_time = 0;    ///< s, asked for
  long node_count = 0;
  long element_count = 0;
  std::vector<ContactDescription> contacts;
  std::vector<std::string> history_sets;  ///< those whose motion is written
  std::vector<std::vector<const FieldRow*>>
      history_motions;                  ///< of each of these: which quantities of nodes; or none: all
  std::vector<Vec3> history_positions;  ///< m, undeformed, of each of these; or none
  std::vector<std::string>
      history_askers;  ///< "hammer NAME" or "probe NAME" of each of these, or empty; or none at all
  std::vector<HistorySet> element_histories;       ///< those of which a quantity of elements is written
  std::vector<std::pair<std::string, int>> beams;  ///< names, numbers of elements
  std::vector<LoadNames> loads;
  std::vector<std::string> prescribed_motions;
  std::vector<std::string> fields;  ///< names of case/field_table.hpp
  std::vector<OutputSet> sets;
  ContactOutput contact_output;
  std::vector<OutputChoice> windows;     ///< what each of the scene's output windows writes
  NumberFormat format = NumberFormat();  ///< of the fields
  std::string key;                       ///< checkpoint_key(); empty: not known
};

/// How much of a results file is there already where a run goes on.
struct ResultsSoFar {
  long history_rows = 0, field_outputs = 0;
};

/// Writes results.h5 and its companion results.xdmf (docs/results-file.md says what is in them). Knows plain data only,
/// no model.
///
/// Nothing computed gets lost: the file is made as PATH.new and takes the place of an older PATH only when the run has
/// brought its first data; it is flushed after each output of fields, of those that follow each other fast after
/// some each second, and every few seconds, each time wholly or not at all, so a killed run leaves a readable file.
/// Where somebody removes or moves it meanwhile it gets its name again. Throws std::runtime_error when the disk
/// refuses; what was flushed before is there then.
class ResultsWriter {
 public:
  /// Throws InputError where check_results_place() does.
  /// @param so_far the file is there and is added to, after all that lies beyond has been cut off; throws
  /// std::runtime_error where it holds less or has other sections
  ResultsWriter(std::string path, RunDescription description, std::optional<ResultsSoFar> so_far = {});
  ResultsWriter(const ResultsWriter&) = delete;
  ResultsWriter& operator=(const ResultsWriter&) = delete;

  /// What is written from now on is compressed so, see hdf5::File::compress_on(). The sections that are made with the
  /// first output have it.
  void compress_on(hdf5::ThreadCount threads) {
    threads_ = threads;
    file_.compress_on(std::move(threads));
  }

  /// How far from equilibrium the run begins: sum of |unbalanced nodal force| over that of applied and contact forces,
  /// and the evaluations of the forces that took; 0 for a state that was there already.
  void settled(double unbalance, int evaluations);
  void history(const HistorySample& sample);
  /// Makes the sections of the fields, as the first fields() does.
  void make_sections();
  bool has_sections() const { return has_sections_; }
  /// Compresses what it can of an output without HDF5, which other threads may use meanwhile; with make_sections()
  /// before.
  CompressedRows pack(const FieldSource& source, const OutputChoice& choice) const;
  /// @param choice of the sets and contacts that are written
  /// @param packed of this output
  void fields(const FieldSource& source, double time, long step, const OutputChoice& choice,
              const CompressedRows& packed = {});
  void fields(const FieldSource& source, double time, long step) {
    fields(source, time, step, OutputChoice::all(description_.sets.size(), description_.contacts.size()));
  }
  void end(const RunSummary& summary);

  /// Brings all results so far to the disk. A checkpoint that counts them comes after that.
  void bring_to_disk();
  const std::string& run() const { return run_; }

  /// Never changes, so any thread may read it.
  const RunDescription& description() const { return description_; }

 private:
  void create_file();
  void extend_file(const ResultsSoFar& so_far);
  /// So many entries of a group; throws where there are fewer.
  void leave(const hdf5::Group& group, const std::string& name, hsize_t entries) const;
  /// @return false: somebody has removed the XDMF file
  bool report_earlier_times();
  bool add_to_xdmf(double time, const OutputChoice& choice);
  void describe_anew();

  /// Writes the waiting history and brings everything to the disk. A kill leaves all of it or nothing.
  void flush();
  bool flush_is_due();

  /// An output whose values are written, but not its time.
  struct Pending {
    double time;
    OutputChoice choice;
  };

  std::string path_;
  const RunDescription description_;
  hdf5::File file_;
  std::unique_ptr<HistorySection> history_;
  std::vector<FieldSection> field_sections_;
  std::vector<ContactSection> contact_sections_;
  std::vector<std::vector<XdmfContactSide>> contact_sides_;  ///< of each contact those that the XDMF file shows
  std::vector<Pending> pending_;
  XdmfFile xdmf_;
  std::size_t outputs_ = 0;                                 ///< in the XDMF file
  std::vector<std::size_t> set_outputs_, contact_outputs_;  ///< likewise of each
  bool has_sections_ = false;
  hdf5::ThreadCount threads_;
  std::string run_;        ///< a name of this run's own
  bool in_place_ = false;  ///< whether the file has taken its own name
  std::chrono::steady_clock::time_point last_flush_;
  std::chrono::steady_clock::time_point counted_;  ///< when `flushes_left_` was
  double flushes_left_;
};

/// Throws InputError unless a results file can be made there: no such folder, not writable, or another run writes it
/// now.
void check_results_place(const std::string& path);

/// Path of the XDMF companion: results.h5 -> results.xdmf.
std::string xdmf_path(const std::string& results_path);

/// Prints a warning on stderr at once, instead of in the run's summary. Any thread may call it.
inline void report_at_once(const std::string& what) {
  std::fputs(("railwave: warning: " + what + "\n").c_str(), stderr);
}

}  // namespace railwave
