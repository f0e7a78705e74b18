#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include "post/signal_command.hpp"

namespace railwave {

/// Adds `railwave signal KIND RESULTS ...`, which fills the request and calls `run`.
void add_signal_command(CLI::App& app, SignalRequest& request, const std::function<void()>& run);

}  // namespace railwave
