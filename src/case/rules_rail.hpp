#pragma once

#include "case/rules.hpp"

namespace railwave::case_file {

/// Rules that bind a rail mesh's keys, in each section that has them.
void check_rail(const scene::RailMesh& rail, EntryCheck& check);

}  // namespace railwave::case_file
