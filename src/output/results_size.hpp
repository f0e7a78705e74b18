#pragma once

#include <string>

#include "output/results_writer.hpp"

namespace railwave {

struct Model;

/// What the results file of a run will hold. Fields and contacts are compressed on the way to the disk, histories
/// aren't.
struct ResultsSize {
  double field_outputs = 0, samples = 0;      ///< how many of each
  double field_bytes = 0, history_bytes = 0;  ///< of all of them, uncompressed
};

ResultsSize results_size(const RunDescription& description, const Model& model);

/// Throws InputError when a file of that size can't fit into `available` bytes however well its fields are compressed.
void check_results_room(const ResultsSize& size, const scene::Scene& scene, double available);

/// Bytes that the file system of the file's folder has free; infinity where it doesn't tell.
double free_bytes_at(const std::string& path);

}  // namespace railwave
