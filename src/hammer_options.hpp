#pragma once

#include <CLI/CLI.hpp>

#include <functional>

#include "post/decay_command.hpp"
#include "post/response_command.hpp"

namespace railwave {

/// Add `railwave frf RESULTS...` and `railwave decay RESULTS...`, which fill their requests and call `run`.
void add_response_command(CLI::App& app, ResponseRequest& request, const std::function<void()>& run);
void add_decay_command(CLI::App& app, DecayRequest& request, const std::function<void()>& run);

}  // namespace railwave
