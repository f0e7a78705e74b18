#pragma once

#include "case/track_entries.hpp"

namespace railwave::case_file {

/// Half the thickness of a rail's web where it is thinnest, m.
double half_web(const std::string& section);

/// The joint at a track's gap: fishplates NAME_fishplate_left and _right (left: towards -y), tied to or in contact with
/// both rails, and bolts. Bolt k is a beam NAME_bolt_k with pretension between points NAME_bolt_k_left and _right
/// beyond the plates' outer sides; thinner beams of the points' names spread its head over the nodes `bolt_k` there.
void add_joint(TrackEntries& entries, const std::string& material);

}  // namespace railwave::case_file
