#pragma once

#include <vector>

namespace railwave {

/// Cell sizes that fill `length` exactly, next to a cell of size `first`: growing geometrically with a ratio of at most
/// `growth` up to `largest`, as few as that allows, their number a multiple of `multiple` (where the cells allow it).
/// Empty when length is (nearly) 0. A length shorter than one cell gives one cell.
std::vector<double> graded_cells(double length, double first, double growth, double largest, int multiple = 1);

/// Which neighbouring cells a 3:1 transition merges, as the sizes of the groups (1 or 3) in order. Groups of three are
/// made from the boundary `middle` (a cell boundary's number) outwards as long as their total size is at most `limit`.
std::vector<int> merge_groups(const std::vector<double>& sizes, int middle, double limit);

/// Sizes of the merged cells.
std::vector<double> merged_sizes(const std::vector<double>& sizes, const std::vector<int>& groups);

/// Layers of an extrusion: `position[i]` are the layers' coordinates (arc or length, m), `levels[k]` the numbers of
/// those that the k-th level of coarsening keeps. Periodic: the last cell of each level closes on its first layer
/// and `period` is the whole length.
struct Stations {
  std::vector<double> position;
  std::vector<std::vector<int>> levels;
  bool periodic = false;
  double period = 0;
  int origin = 0;      ///< station of the zone from which the levels were merged outwards
  int zone_first = 0;  ///< stations at which the zone begins and ends
  int zone_last = 0;
  int path_first = 0;  ///< and the path; that of the zone where there is none
  int path_last = 0;

  /// Coordinate of the end of a cell that begins at station `i`, one level-0 cell on.
  double next_position(int i) const {
    return i + 1 < static_cast<int>(position.size()) ? position[i + 1] : position[0] + period;
  }
};

struct StationPlan {
  double zone_start, zone_end;  ///< cells of exactly zone_size from about start to end
  double zone_size;
  double growth;
  double coarse_size;                   ///< largest cell of level 0
  double merge_limit;                   ///< largest merged cell
  int levels;                           ///< how many levels, at least 1
  double path_start = 0, path_end = 0;  ///< range about the zone with cells up to path_size; none unless it is wider
  double path_size = 0;
};

/// Layers from `start` to `end`; a layer lies at 0 when the zone holds 0.
Stations open_stations(const StationPlan& plan, double start, double end);
/// Layers round a closed circle of the given length.
Stations periodic_stations(const StationPlan& plan, double period);

}  // namespace railwave
