#pragma once

#include "case/complaints.hpp"
#include "case/scene.hpp"

/// Turns the short forms of a case file (tracks, hammers, probes, curves from files) into the entries that they stand
/// for.
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

/// Adds to the scene the materials, meshes, parts, connectors and constraints that its tracks stand for. Their names
/// are those that the help of [tracks] lists. Complains about names that are taken, and tracks without sleepers.
void expand_tracks(scene::Scene& scene, Complaints& complaints);

/// Gives the meshes of fishplates and rail pads the parameters of the rail's mesh that each names; complains where that
/// is no rail.
void fit_to_rails(scene::Scene& scene, Complaints& complaints);

/// Fills the points of curves given as files: columns of time in s and value, as case/number_table.hpp reads them.
/// Complains with the file's line about everything else, and about times that do not increase. What was read is added
/// to the scene's static text, so that a changed file settles anew.
void read_curves(scene::Scene& scene, Complaints& complaints);

/// Adds to the scene the node sets, curves, loads and history sets that its hammers and probes stand for. Their names
/// are those that the help of [hammers] and [probes] lists. Complains about names that are taken.
void expand_hammers(scene::Scene& scene, Complaints& complaints);

}  // namespace railwave::case_file
