#pragma once

#include <memory>
#include <string>

#include "output/field_snapshot.hpp"
#include "output/results_writer.hpp"
#include "output/task_thread.hpp"

namespace railwave {

/// A ResultsWriter that works in a thread of its own: what it is given it copies into plain data, and returns before that is
/// on the disk. The file becomes the same. After the constructor that thread alone touches HDF5, which need not be
/// built for several; nobody else may while this object lives.
///
/// Bounded: one output of fields is being written, one waits; the caller waits with the next. What the thread's writer throws is
/// thrown by the next call of any member. The destructor writes what was given, as far as the disk lets it, and throws nothing.
class BackgroundWriter {
 public:
  /// Throws at once what the ResultsWriter's constructor throws.
  BackgroundWriter(std::string path, RunDescription description);

  void history(const HistorySample& sample);

  /// Fetches from `source` before it returns.
  void fields(const FieldSource& source, double time, long step);

  /// Returns when all is on the disk.
  void end(const RunSummary& summary);

 private:
  std::shared_ptr<const FieldSelection> selection_;  ///< made with the first output of fields
  ResultsWriter writer_;                             ///< the thread's
  TaskThread thread_;                                // last: ends before the writer goes
};

}  // namespace railwave
