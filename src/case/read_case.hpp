#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"

namespace railwave {

/// Reads and checks a case file. `overrides` are texts like `time.end=1e-3` or `parts.wheel.hourglass=stiffness`, which
/// replace or add what the file says; their values are TOML, and a bare word is a text; `parts.wheel.position[1]=0.01`
/// replaces one entry of a list. Throws InputError with every
/// mistake that was found, one a line: `cases/x.toml:14: [parts.wheel] hourglas: unknown key; ...`.
/// `warnings`, when given, receives in the same form what is odd, but may be meant: a density of 7.8 kg/m3.
/// @param origins of the overrides, for mistakes in them: "study.toml:12"; without, the command line
scene::Scene read_case(const std::string& path, const std::vector<std::string>& overrides = {},
                       std::vector<std::string>* warnings = nullptr, const std::vector<std::string>& origins = {});

/// The folder that is a case's own where it names no other: results/NAME, NAME being the case file's name without its
/// ending. It counts from the folder in which the program runs.
std::string default_results_folder(const std::string& case_path);

/// Where a run writes unless the case says output.file: results/NAME/NAME.h5.
std::string default_results_file(const std::string& case_path);

}  // namespace railwave
