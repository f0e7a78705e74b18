#include "output/background_writer.hpp"

namespace railwave {
namespace {

// The queue's room: two outputs of fields and thousands of history samples beside them, which are small and must not wait
// for fields being written.
constexpr std::size_t size_of_history = 1, size_of_fields = 4096, room = 3 * size_of_fields - 1;

}  // namespace

BackgroundWriter::BackgroundWriter(std::string path, RunDescription description)
    : writer_(std::move(path), std::move(description)), thread_(room) {
  thread_.add(hdf5::be_quiet);
}

void BackgroundWriter::history(const HistorySample& sample) {
  thread_.add([this, sample] { writer_.history(sample); }, size_of_history);
}

void BackgroundWriter::fields(const FieldSource& source, double time, long step) {
  if (!selection_) {
    const RunDescription& run = writer_.description();
    selection_ = std::make_shared<const FieldSelection>(select_fields(run.sets, run.fields, static_cast<int>(run.contacts.size()), source));
  }
  const auto snapshot = std::make_shared<const FieldSnapshot>(source, selection_);
  thread_.add([this, snapshot, time, step] { writer_.fields(*snapshot, time, step); }, size_of_fields);
}

void BackgroundWriter::end(const RunSummary& summary) {
  thread_.add([this, summary] { writer_.end(summary); });
  thread_.finish();
}

}  // namespace railwave
