#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

#include "post/decay_command.hpp"
#include "post/export_command.hpp"
#include "post/response_command.hpp"
#include "post/signal_command.hpp"
#include "report/report_command.hpp"
#include "sweep/sweep_command.hpp"

namespace railwave {

/// Adds `railwave frf RESULTS...`, which fills the request and calls `run`.
void add_response_command(CLI::App& app, ResponseRequest& request, const std::function<void()>& run);

/// Adds `railwave decay RESULTS...`, which fills the request and calls `run`.
void add_decay_command(CLI::App& app, DecayRequest& request, const std::function<void()>& run);

/// Adds `railwave signal KIND RESULTS ...`, which fills the request and calls `run`.
void add_signal_command(CLI::App& app, SignalRequest& request, const std::function<void()>& run);

/// Adds `railwave report RESULTS...`, which fills the request and calls `run`.
void add_report_command(CLI::App& app, ReportRequest& request, const std::function<void()>& run);

/// Adds `railwave export RESULTS`, which fills the request and calls `run`.
void add_export_command(CLI::App& app, ExportRequest& request, const std::function<void()>& run);

/// Adds `railwave sweep STUDY`, which fills the request and calls `run`.
void add_sweep_command(CLI::App& app, sweep::SweepRequest& request, const std::function<void()>& run);

/// Gives every option of every command that takes a number or a file the check of it: numbers are wholly read, finite
/// and within what the option can use; names of files are neither empty nor '-', which is no file. Called once all
/// options are there; an option that is not in the table of option_checks.cpp is left as it is, which a test finds out.
void add_option_checks(CLI::App& app);

/// What is said of a command line that can't be understood: what, and the command or option that was probably meant.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

/// What `railwave help TOPIC` prints: help on a command (signal, signal psd), on a section or key of the case file, or
/// both. Throws InputError, with the nearest name, when nothing is called so.
std::string help_on(const CLI::App& app, const std::vector<std::string>& topic);

}  // namespace railwave
