#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "output/fields/field_snapshot.hpp"
#include "output/results_writer.hpp"
#include "output/task_thread.hpp"

namespace railwave {

/// On how many threads a background writer compresses large arrays, its own among them.
struct CompressionThreads {
  int beside_run = 1;  ///< while the run goes on
  int run_waits = 1;   ///< while it waits for the writer, as at its end
};

/// A ResultsWriter that works in a thread of its own: what it is given it copies into plain data, and returns before
/// that is on the disk. The file becomes the same. After the constructor that thread alone touches HDF5 for this file,
/// under hdf5::in_use(); so must whoever else does while this object lives.
///
/// Bounded: one output of fields is being written, one waits; the caller waits with the next. What the thread's writer
/// throws is thrown by the next call of any member. The destructor writes what was given, as far as the disk lets it,
/// and throws nothing.
class BackgroundWriter {
 public:
  /// Throws at once what the ResultsWriter's constructor throws.
  /// @param on_failure called by the thread as soon as the disk refuses results
  BackgroundWriter(std::string path, RunDescription description, std::optional<ResultsSoFar> so_far = {},
                   std::function<void()> on_failure = {}, CompressionThreads threads = {});

  void settled(double unbalance, int evaluations);
  void history(const HistorySample& sample);

  /// Fetches from `source` before it returns.
  /// @param choice of the sets and contacts that are written
  void fields(const FieldSource& source, double time, long step, const OutputChoice& choice);
  void fields(const FieldSource& source, double time, long step);

  /// Writes the state after what was given before. What goes wrong with it stops nothing; it is reported at once, and
  /// see checkpoint_trouble().
  void checkpoint(RunState state, const CheckpointFile& file);

  /// Waits for all that was given; what went wrong with checkpoints, empty: nothing.
  std::string checkpoint_trouble();

  /// Returns when all is on the disk.
  void end(const RunSummary& summary);

 private:
  /// Files are made and closed while no other thread uses HDF5.
  struct EndAlone {
    void operator()(ResultsWriter* writer) const;
  };
  using Writer = std::unique_ptr<ResultsWriter, EndAlone>;
  static Writer begin_alone(std::string path, RunDescription description, std::optional<ResultsSoFar> so_far);

  std::map<OutputChoice, std::shared_ptr<const FieldSelection>> selections_;  ///< each made with its first output
  Writer writer_;                                                             ///< the thread's
  std::string trouble_;                                                       ///< the thread's, until that has finished
  TaskThread thread_;                                                         // last: ends before the writer goes
};

}  // namespace railwave
