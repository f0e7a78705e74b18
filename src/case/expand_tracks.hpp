#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

namespace railwave::case_file {

/// Where sleepers are along a track, by x.
struct SleeperPlace {
  double x = 0;             ///< m, in the track's own axes
  const std::string* kind;  ///< of the track's two
};

/// The sleepers of a track that lie whole under its rail, in order.
std::vector<SleeperPlace> sleeper_places(const scene::Track& track);

/// A kind of sleeper with everything said: as in the section of that name, and otherwise as `concrete` and `timber`
/// are.
scene::Sleeper sleeper_of(const scene::Scene& scene, const std::string& name);

/// Adds to the scene the materials, meshes, parts, connectors and constraints that its tracks stand for, under the
/// names that the section's help tells. Complains about names that are taken, and tracks without sleepers.
void expand_tracks(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
