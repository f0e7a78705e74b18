#include "output/background_writer.hpp"

#include <exception>

#include "output/free_memory.hpp"
#include "output/results_writer.hpp"

namespace railwave {
namespace {

// The queue's capacity: two outputs of fields and thousands of history samples beside them, which are small and must
// not wait for fields being written.
constexpr std::size_t size_of_history = 1, size_of_fields = 4096, capacity = 3 * size_of_fields - 1;

/// What the thread does with HDF5: another run's thread may want to, too.
template <class Use>
auto alone(Use use) {
  return [use = std::move(use)] {
    const std::lock_guard<std::recursive_mutex> holding(hdf5::in_use());
    use();
  };
}

}  // namespace

void BackgroundWriter::EndAlone::operator()(ResultsWriter* writer) const {
  const std::lock_guard<std::recursive_mutex> holding(hdf5::in_use());
  delete writer;
}

BackgroundWriter::Writer BackgroundWriter::begin_alone(std::string path, RunDescription description,
                                                       std::optional<ResultsSoFar> so_far) {
  const std::lock_guard<std::recursive_mutex> holding(hdf5::in_use());
  return Writer(new ResultsWriter(std::move(path), std::move(description), so_far));
}

BackgroundWriter::BackgroundWriter(std::string path, RunDescription description, std::optional<ResultsSoFar> so_far,
                                   std::function<void()> on_failure, CompressionThreads threads)
    : writer_(begin_alone(std::move(path), std::move(description), so_far)), thread_(capacity, std::move(on_failure)) {
  thread_.add(alone([this, threads] {
    hdf5::be_quiet();
    writer_->compress_on([this, threads] { return thread_.is_awaited() ? threads.run_waits : threads.beside_run; });
  }));
}

void BackgroundWriter::settled(double unbalance, int evaluations) {
  thread_.add(alone([this, unbalance, evaluations] { writer_->settled(unbalance, evaluations); }), size_of_history);
}

void BackgroundWriter::history(const HistorySample& sample) {
  thread_.add(alone([this, sample] { writer_->history(sample); }), size_of_history);
}

void BackgroundWriter::fields(const FieldSource& source, double time, long step) {
  const RunDescription& run = writer_->description();
  fields(source, time, step, OutputChoice::all(run.sets.size(), run.contacts.size()));
}

void BackgroundWriter::fields(const FieldSource& source, double time, long step, const OutputChoice& choice) {
  auto& selection = selections_[choice];
  if (!selection) {
    const RunDescription& run = writer_->description();
    selection = std::make_shared<const FieldSelection>(select_fields(run.sets, run.fields, choice));
  }
  // The snapshot and what is fetched for it: made only where that leaves HDF5, in its thread, what it looked for.
  if (!leaves_free_memory(2 * selection->bytes() + memory_margin))
    throw TooLittleMemory(2 * selection->bytes() + memory_margin);
  const auto snapshot = std::make_shared<const FieldSnapshot>(source, selection);
  thread_.add(
      [this, snapshot, time, step, choice] {
        if (!writer_->has_sections()) alone([this] { writer_->make_sections(); })();
        const CompressedRows packed = writer_->pack(*snapshot, choice);
        alone([&] { writer_->fields(*snapshot, time, step, choice, packed); })();
      },
      size_of_fields);
}

void BackgroundWriter::checkpoint(RunState state, const CheckpointFile& file) {
  const auto kept = std::make_shared<const RunState>(std::move(state));
  thread_.add(alone([this, kept, file] {
                writer_->bring_to_disk();
                try {
                  file.write(*kept, writer_->run());
                } catch (const std::exception& error) {
                  const bool first = trouble_.empty();
                  trouble_ =
                      std::string("a checkpoint could not be written, the one before it is the last: ") + error.what();
                  if (first) report_at_once(trouble_);
                }
              }),
              size_of_fields);
}

std::string BackgroundWriter::checkpoint_trouble() {
  thread_.finish();
  return trouble_;
}

void BackgroundWriter::end(const RunSummary& summary) {
  thread_.add(alone([this, summary] { writer_->end(summary); }));
  thread_.finish();
}

}  // namespace railwave
