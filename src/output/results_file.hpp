#pragma once

#include <functional>
#include <memory>
#include <string>

#include "model/assembled_scene.hpp"
#include "model/time_step/step_sizes.hpp"
#include "output/background_writer.hpp"
#include "solve/observer.hpp"

namespace railwave {

/// In the message that the disk is too small for what a run will write: between how much that is, and the file.
inline constexpr const char* disk_too_small = " before compression, but ";

/// What the results file of a run will hold. Fields and contacts are compressed on the way to the disk, histories
/// aren't.
struct ResultsSize {
  double field_outputs = 0, samples = 0;      ///< how many of each
  double field_bytes = 0, history_bytes = 0;  ///< of all of them, uncompressed
};

/// Writes the results of the time loop into scene.output.file and its XDMF companion while the loop goes on: the loop
/// waits for copies from the device only. When writing fails the loop is asked to stop, and the next call throws the
/// error.
class ResultsFile : public RunObserver, public Checkpoints {
 public:
  /// Touches no file yet, but throws InputError for output sets that are not in the assembly: to be made before the
  /// run's long preparations. Whether files can be made is HeldPlaces' matter.
  ResultsFile(const scene::Scene& scene, const Assembly& assembly, const std::string& program_version);

  /// Before the run begins: other runs of this process are not to end because this one's results cannot be written. Its
  /// own loop sees that at its next output.
  void fail_alone() {
    stop_loops_ = [] {};
  }

  ResultsSize size(const AssembledScene& assembled, const StepSizes& sizes) const;

  /// Throws InputError when what the run will write can't fit onto the disk.
  void check_disk_space(const AssembledScene& assembled, const StepSizes& sizes) const;

  /// Before the run begins: where its states are kept. When the run is complete they are taken away, unless the one at
  /// its end is to stay.
  void keep_checkpoints(CheckpointFile file, bool also_at_end = false);

  /// Before the run begins: it goes on from a state that find_restart() found, and so does the file.
  void go_on_from(const RunState& state) { so_far_ = {state.history_rows, state.field_outputs}; }

  void begin(const Model& model) override;
  void settled(const Model& model, const SettleReport& report) override;
  void history(const Model& model, const HistorySample& sample) override;
  bool looks_at_model() const override { return false; }
  void fields(const Model& model, const HistorySample& sample, const DueFields& due) override;
  void end(const Model& model, const RunSummary& summary) override;
  void keep(RunState state) override;
  std::string trouble() override;

 private:
  template <class Do>
  void writing(const Do& one);
  OutputChoice choice_of(const DueFields& due) const;

  std::function<void()> stop_loops_;  ///< all of this process, when writing fails
  std::optional<CheckpointFile> checkpoint_;
  bool keeps_end_ = false;
  std::optional<ResultsSoFar> so_far_;
  std::string path_;
  RunDescription description_;
  std::vector<int> history_beams_;  ///< of the scene's beams those of which section forces are written
  std::unique_ptr<BackgroundWriter> writer_;
};

ResultsSize results_size(const RunDescription& description, const AssembledScene& assembled, const StepSizes& sizes);

/// A line for `railwave check`.
std::string describe(const ResultsSize& size);

/// Throws InputError when a file of that size can't fit into `available` bytes however well its fields are compressed.
void check_results_disk_space(const ResultsSize& size, const scene::Scene& scene, double available);

/// Bytes that the file system of the file's folder has free; infinity where that is not known.
double free_bytes_at(const std::string& path);

}  // namespace railwave
