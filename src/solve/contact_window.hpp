#pragma once

#include "model/model.hpp"
#include "solve/stages.hpp"

namespace railwave {

/// Keeps a pair's window true, at two distances. The window lists the slave nodes that could touch the master in the next
/// hundreds or thousands of steps; it is laid out on the host, anew when the surfaces have moved far enough. Out of it the
/// nodes that can touch in the next few dozen steps are picked on the device, nothing returning to the host. All others
/// are surely apart, so the result does not depend on how often either is done.
void keep_window(Model& model, ContactPair& pair, const Instant& instant);

/// A line for each pair of which that was not true: bodies so fast out of nothing that nodes began to touch unforeseen.
std::vector<std::string> late_contacts(const Model& model);

}  // namespace railwave
