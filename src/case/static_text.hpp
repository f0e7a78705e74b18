#pragma once

#include <string>

#include "case/document.hpp"

namespace railwave::case_file {

/// What of a case its static state can depend on, one line for each value, however the file was laid out: all but the
/// title, [time], [output], how the time loop steps, and the velocities of initial and prescribed motions and the
/// latter's displacements. Mesh files stand by their names.
std::string static_text(const Node& root);

}  // namespace railwave::case_file
