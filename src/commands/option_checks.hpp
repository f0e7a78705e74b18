#pragma once

#include <CLI/CLI.hpp>

namespace railwave {

/// Gives every option of every command that takes a number or a file the check of it: numbers are wholly read, finite
/// and within what the option can use; names of files are neither empty nor '-', which is no file. Called once all
/// options are there; an option that is not in the table of option_checks.cpp is left as it is, which a test finds out.
void add_option_checks(CLI::App& app);

}  // namespace railwave
