#pragma once

#include <string>
#include <vector>

#include "case/document.hpp"

namespace railwave::case_file {

/// Puts `section.key=value` texts of the command line into the document, where they replace what the file says. A named
/// entry must exist in the file; keys are checked later, like the file's own.
void apply_overrides(const std::vector<std::string>& overrides, Node& root, Complaints& complaints);

}  // namespace railwave::case_file
