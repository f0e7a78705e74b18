#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include "post/decay_command.hpp"
#include "post/response_command.hpp"

namespace railwave {

/// Adds `railwave frf RESULTS...`, which fills the request and calls `run`.
void add_response_command(CLI::App& app, ResponseRequest& request, const std::function<void()>& run);

/// Adds `railwave decay RESULTS...`, which fills the request and calls `run`.
void add_decay_command(CLI::App& app, DecayRequest& request, const std::function<void()>& run);

}  // namespace railwave
