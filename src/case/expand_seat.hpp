#pragma once

#include "case/track_entries.hpp"

namespace railwave::case_file {

/// A place where a rail lies on a sleeper.
struct RailSeat {
  double x = 0;                         ///< m, of its middle, in the track's own axes
  std::string sleeper;                  ///< part
  std::string rail;                     ///< part, and its mesh
  double rail_start = 0, rail_end = 0;  ///< m
  std::string pad_material;             ///< of a solid pad
  int number = 0;
};

/// Adds the fastening of a seat: connector `NAME_fastening_K`; with a solid pad part `NAME_pad_K`, tied to foot and
/// sleeper, and that connector if the pad leaves anything to it.
/// @param kind of the sleeper, with everything said
void add_fastening(TrackEntries& entries, const scene::Sleeper& kind, const RailSeat& seat);

}  // namespace railwave::case_file
