#pragma once

#include "kernels/contact/contact_track.hpp"
#include "model/model.hpp"
#include "solve/plan.hpp"

namespace railwave {

/// Keeps a pair's window true, at two distances. The window lists the slave nodes that could touch the master in the
/// next hundreds or thousands of steps; it is laid out on the host, anew when the surfaces have moved far enough. Out
/// of it the nodes that can touch in the next few dozen steps are picked on the device, nothing returning to the host.
/// All others are surely apart, so the result does not depend on how often either is done.
/// @param step s to the next instant
void keep_window(Model& model, ContactPair& pair, double step, StepKind kind);

/// What a node that begins to touch is judged by.
/// @param elapsed s since the instant before
FirstTouch first_touch(const Model& model, double elapsed);

/// A line for each pair of which that was not true: bodies so fast out of nothing that nodes began to touch unforeseen;
/// and for each of which nodes are in the other body without having come in through its surface.
std::vector<std::string> late_contacts(const Model& model);

}  // namespace railwave
