#pragma once

#include "solve/stages.hpp"

namespace railwave {

/// Lists the slave nodes that can touch the master in the steps to come, and for each master node the slaves that can load
/// it; sets the step at which this must be done again, from the fastest relative motion seen. Nodes outside the window
/// are surely apart, so the result never depends on how often it is laid out.
void lay_out_window(Model& model, ContactPair& pair, const Instant& instant);

}  // namespace railwave
