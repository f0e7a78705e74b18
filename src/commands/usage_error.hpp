#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace railwave {

/// What is said of a command line that can't be understood: what, and the command or option that was probably meant.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

/// What `railwave help TOPIC` prints: help on a command (signal, signal psd), on a section or key of the case file, or
/// both. Throws InputError, with the nearest name, when nothing is called so.
std::string help_on(const CLI::App& app, const std::vector<std::string>& topic);

}  // namespace railwave
