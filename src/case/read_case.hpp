#pragma once

#include <string>
#include <vector>

#include "case/scene.hpp"

namespace railwave {

/// Reads and checks a case file. `overrides` are texts like `time.end=1e-3` or `parts.wheel.hourglass=stiffness`, which
/// replace or add what the file says; their values are TOML, and a bare word is a text. Throws InputError with every
/// mistake that was found, one a line: `cases/x.toml:14: [parts.wheel] hourglas: unknown key; ...`.
/// `warnings`, when given, receives in the same form what is odd, but may be meant: a density of 7.8 kg/m3.
scene::Scene read_case(const std::string& path, const std::vector<std::string>& overrides = {},
                       std::vector<std::string>* warnings = nullptr);

}  // namespace railwave
