#pragma once

#include "model/assembly.hpp"

namespace railwave {

/// Adds the scene's [node_sets.NAME] to the assembly, as `part.NAME`; of a surface also those of its faces that lie whole in the
/// box, as a surface of that name. Throws InputError for a set without nodes, telling the nearest one, and for a name that the
/// part's mesh has already.
void add_node_sets(const scene::Scene& scene, Assembly& assembly);

}  // namespace railwave
