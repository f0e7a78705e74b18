#pragma once

#include "model/model.hpp"

namespace railwave {

/// Keeps a pair's window true: lists the slave nodes that can touch the master in the steps to come, and for each master
/// node the slaves that can load it, and does so anew when the surfaces have moved far enough since the last time. Nodes
/// outside the window are surely apart, so the result does not depend on how often it is laid out.
void keep_window(Model& model, ContactPair& pair);

}  // namespace railwave
