#include "mesh/grading.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/mesh_memory.hpp"

namespace railwave {

namespace {

double graded_length(int cells, double first, double growth, double largest) {
  double total = 0, size = first;
  for (int i = 0; i < cells; ++i) total += size = std::min(size * growth, std::max(first, largest));
  return total;
}

double sum(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  return std::accumulate(values.begin() + begin, values.begin() + end, 0.0);
}

}  // namespace

std::vector<double> graded_cells(double length, double first, double growth, double largest, int multiple) {
  if (length < 1e-3 * first) return {};
  const double limit = std::max(first, largest);
  double size = std::min(first * growth, limit), reached = size;
  int cells = 1;
  for (; reached < length * (1 - 1e-9); reached += size = std::min(size * growth, limit))
    cells = cell_count(cells + 1.0);
  const int rounded = (cells + multiple - 1) / multiple * multiple;
  if (rounded * first <= length) cells = rounded;
  if (cells * first >= length) return std::vector<double>(cells, length / cells);
  double low = 1, high = growth;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (graded_length(cells, first, middle, largest) < length ? low : high) = middle;
  }
  std::vector<double> sizes;
  size = first;
  for (int i = 0; i < cells; ++i) sizes.push_back(size = std::min(size * high, std::max(first, largest)));
  const double scale = length / sum(sizes, 0, sizes.size());
  for (double& value : sizes) value *= scale;
  return sizes;
}

namespace {

/// Groups of sizes[begin, end) from `begin` on; the rest stays single.
std::vector<int> groups_onwards(const std::vector<double>& sizes, std::size_t begin, std::size_t end, double limit) {
  std::vector<int> groups;
  while (begin + 3 <= end && sum(sizes, begin, begin + 3) <= limit * (1 + 1e-9)) {
    groups.push_back(3);
    begin += 3;
  }
  groups.insert(groups.end(), end - begin, 1);
  return groups;
}

}  // namespace

std::vector<int> merge_groups(const std::vector<double>& sizes, int middle, double limit) {
  std::vector<double> before(sizes.begin(), sizes.begin() + middle);
  std::reverse(before.begin(), before.end());
  std::vector<int> groups = groups_onwards(before, 0, before.size(), limit);
  std::reverse(groups.begin(), groups.end());
  const auto after = groups_onwards(sizes, middle, sizes.size(), limit);
  groups.insert(groups.end(), after.begin(), after.end());
  return groups;
}

std::vector<double> merged_sizes(const std::vector<double>& sizes, const std::vector<int>& groups) {
  std::vector<double> result;
  std::size_t begin = 0;
  for (int group : groups) {
    result.push_back(sum(sizes, begin, begin + group));
    begin += group;
  }
  return result;
}

namespace {

struct ZoneCells {
  double first;  // coordinate of the zone's first layer
  int cells;
  int origin;  // layer from which cells are merged
};

ZoneCells zone_cells(const StationPlan& plan) {
  const double size = plan.zone_size, slack = 1e-6;
  if (plan.zone_start <= 0 && plan.zone_end >= 0) {
    const int before = cell_count(std::ceil(-plan.zone_start / size - slack));
    const int after = cell_count(std::ceil(plan.zone_end / size - slack));
    return {-before * size, before + after, before};
  }
  const int cells = cell_count(std::ceil((plan.zone_end - plan.zone_start) / size - slack));
  return {plan.zone_start, std::max(1, cells), std::max(1, cells) / 2};
}

/// Levels above 0: sizes and layer numbers of each level from those of the one before.
void add_levels(Stations& stations, std::vector<double> sizes, int origin, const StationPlan& plan) {
  const std::size_t layers = stations.position.size();
  std::vector<int> kept(layers);
  std::iota(kept.begin(), kept.end(), 0);
  stations.levels.assign(1, kept);
  stations.origin = origin;
  int middle = origin;
  for (int level = 1; level < plan.levels; ++level) {
    const auto groups = merge_groups(sizes, middle, plan.merge_limit);
    std::vector<int> next;
    int cell = 0, next_middle = 0;
    for (int group : groups) {
      if (cell == middle) next_middle = static_cast<int>(next.size());
      next.push_back(kept[cell]);
      cell += group;
    }
    if (cell == middle) next_middle = static_cast<int>(next.size());
    if (!stations.periodic) next.push_back(kept[cell]);
    sizes = merged_sizes(sizes, groups);
    kept = next;
    middle = next_middle;
    stations.levels.push_back(kept);
  }
}

/// Cells at one side of the zone, from it outwards.
struct SideCells {
  std::vector<double> sizes;
  int on_path = 0;  ///< so many of them first
};

/// Cells over `length`, over the first `path` of it up to path_size; the number of those beyond is a multiple of
/// `multiple`.
SideCells side_cells(const StationPlan& plan, double length, double path, int multiple = 1) {
  if (path > length - 0.5 * plan.path_size) path = length;  // no sliver beyond
  SideCells cells;
  if (path > plan.zone_size) cells.sizes = graded_cells(path, plan.zone_size, plan.growth, plan.path_size);
  cells.on_path = static_cast<int>(cells.sizes.size());
  const double from = cells.on_path == 0 ? 0 : path, first = cells.on_path == 0 ? plan.zone_size : cells.sizes.back();
  const auto beyond = graded_cells(length - from, first, plan.growth, plan.coarse_size, multiple);
  cells.sizes.insert(cells.sizes.end(), beyond.begin(), beyond.end());
  return cells;
}

Stations assemble(const StationPlan& plan, const ZoneCells& zone, const SideCells& before_zone, double start,
                  const SideCells& after_zone) {
  std::vector<double> before = before_zone.sizes;
  const std::vector<double>& after = after_zone.sizes;
  std::reverse(before.begin(), before.end());
  std::vector<double> sizes = before;
  sizes.insert(sizes.end(), zone.cells, plan.zone_size);
  sizes.insert(sizes.end(), after.begin(), after.end());
  Stations stations;
  stations.position.push_back(start);
  for (double size : sizes) stations.position.push_back(stations.position.back() + size);
  for (int i = 0; i <= zone.cells; ++i)  // exact, free of the sum's rounding
    stations.position[before.size() + i] = zone.first + i * plan.zone_size;
  stations.zone_first = static_cast<int>(before.size());
  stations.zone_last = stations.zone_first + zone.cells;
  stations.path_first = stations.zone_first - before_zone.on_path;
  stations.path_last = stations.zone_last + after_zone.on_path;
  add_levels(stations, sizes, stations.zone_first + zone.origin, plan);
  return stations;
}

}  // namespace

Stations open_stations(const StationPlan& plan, double start, double end) {
  const ZoneCells zone = zone_cells(plan);
  const double last = zone.first + zone.cells * plan.zone_size;
  const auto before = side_cells(plan, zone.first - start, zone.first - plan.path_start);
  const auto after = side_cells(plan, end - last, plan.path_end - last);
  Stations stations = assemble(plan, zone, before, start, after);
  if (!after.sizes.empty()) stations.position.back() = end;
  return stations;
}

Stations periodic_stations(const StationPlan& plan, double period) {
  StationPlan fitted = plan;
  ZoneCells zone = zone_cells(plan);
  double rest = period - zone.cells * plan.zone_size;
  SideCells before, after;
  if (rest < 6 * plan.zone_size) {  // the whole circle is zone, in whole groups of two levels
    zone.cells = cell_count(std::ceil(period / plan.zone_size / 9 - 1e-6)) * 9;
    fitted.zone_size = period / zone.cells;
    zone.first = 0;
    zone.origin = 0;
  } else {
    // Both sides meet opposite the zone; whole groups of three from the origin leave no odd cell there.
    const int side_before = zone.origin, side_after = zone.cells - zone.origin;
    const auto grade = [&](int zone_side, double path) {
      auto cells = side_cells(plan, rest / 2, path);
      const auto count = [](const SideCells& of) { return static_cast<int>(of.sizes.size()); };
      for (int extra = 1; (zone_side + count(cells)) % 3 != 0 && extra < 3; ++extra) {
        const int wanted = count(cells) + 1;
        const auto more = side_cells(plan, rest / 2, path, wanted - cells.on_path);
        if (count(more) != wanted) break;
        cells = more;
      }
      return cells;
    };
    before = grade(side_before, zone.first - plan.path_start);
    after = grade(side_after, plan.path_end - zone.first - zone.cells * plan.zone_size);
  }
  Stations stations = assemble(fitted, zone, before, zone.first - (before.sizes.empty() ? 0 : rest / 2), after);
  stations.position.pop_back();
  stations.periodic = true;
  stations.period = period;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < stations.position.size(); ++i)
    sizes.push_back(stations.next_position(static_cast<int>(i)) - stations.position[i]);
  add_levels(stations, sizes, stations.origin, fitted);
  return stations;
}

}  // namespace railwave
