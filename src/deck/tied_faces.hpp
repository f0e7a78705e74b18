#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave::deck {

/// Of a slave's faces those that lie on the master: all of whose corners are within 5 % of the shorter diagonal of a
/// master's face, as LS-DYNA ties them (*CONTACT_TIED, remark on tolerances of solids [LSTC-2021]).
/// @param left_out how many nodes lie so near, but are corners of no such face
std::vector<Face> faces_on(const Mesh& mesh, const std::vector<Face>& slave, const std::vector<Face>& master,
                           std::size_t& left_out);

}  // namespace railwave::deck
