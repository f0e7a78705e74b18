#pragma once

#include <string>

namespace railwave {

/// The folder that is a case's own where it names no other: results/NAME, NAME being the case file's name without its
/// ending. It counts from the folder in which the program runs.
std::string default_results_folder(const std::string& case_path);

/// Where a run writes unless the case says output.file: results/NAME/NAME.h5.
std::string default_results_file(const std::string& case_path);

}  // namespace railwave
