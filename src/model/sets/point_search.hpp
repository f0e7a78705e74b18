#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/assembly.hpp"

namespace railwave {

/// m: what rounding may take a place out of a box on whose side it lies.
inline constexpr double place_slack = 1e-9;

/// How far outside the box a place is, m; 0 inside.
double distance_outside(const scene::Box& box, const Vec3& x);

/// A place as a case file has it.
std::string text_of(const Vec3& x);

/// Lowest and highest coordinates, m.
using Bounds = std::array<Vec3, 2>;

inline constexpr Bounds no_bounds{{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}}};

inline void widen(Bounds& bounds, const Vec3& x) {
  for (int i = 0; i < 3; ++i) {
    bounds[0][i] = std::min(bounds[0][i], x[i]);
    bounds[1][i] = std::max(bounds[1][i], x[i]);
  }
}

inline bool holds(const Bounds& bounds, const Vec3& x) {
  for (int i = 0; i < 3; ++i)
    if (x[i] < bounds[0][i] || x[i] > bounds[1][i]) return false;
  return true;
}

/// Nodes in a grid of cells, to be asked for those within bounds.
class NodeGrid {
 public:
  /// @param places of all nodes, m; they outlive the grid
  /// @param bounds that hold those of `nodes`
  NodeGrid(const std::vector<Vec3>& places, const std::vector<int>& nodes, const Bounds& bounds)
      : places_(places), low_(bounds[0]) {
    Vec3 extent;
    for (int i = 0; i < 3; ++i) extent[i] = bounds[1][i] - bounds[0][i];
    std::sort(extent.begin(), extent.end());
    // As far as nodes are apart, be they on a line, on a surface or in a body.
    const double count = static_cast<double>(nodes.size());
    cell_ = std::max({1e-9, extent[2] / 1000, extent[2] / count, std::sqrt(extent[2] * extent[1] / count),
                      std::cbrt(extent[2] * extent[1] * extent[0] / count)});
    top_ = cell_of(bounds[1]);
    for (int n : nodes) cells_[key(cell_of(places[n]))].push_back(n);
  }

  template <class Take>
  void within(const Bounds& bounds, const Take& take) const {
    auto first = cell_of(bounds[0]), last = cell_of(bounds[1]);
    for (int i = 0; i < 3; ++i) {
      first[i] = std::max(first[i], 0L);
      last[i] = std::min(last[i], top_[i]);
    }
    for (long i = first[0]; i <= last[0]; ++i)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long k = first[2]; k <= last[2]; ++k)
          if (const auto found = cells_.find(key({i, j, k})); found != cells_.end())
            for (int n : found->second)
              if (holds(bounds, places_[n])) take(n);
  }

 private:
  std::array<long, 3> cell_of(const Vec3& x) const {
    std::array<long, 3> cell{};
    for (int i = 0; i < 3; ++i)
      cell[i] = static_cast<long>(std::clamp(std::floor((x[i] - low_[i]) / cell_), -1.0, 1001.0));
    return cell;
  }
  static long key(const std::array<long, 3>& cell) { return ((cell[0] + 1) * 1024 + cell[1] + 1) * 1024 + cell[2] + 1; }

  const std::vector<Vec3>& places_;
  Vec3 low_;
  double cell_ = 1;            ///< m
  std::array<long, 3> top_{};  ///< the last cell along each axis
  std::unordered_map<long, std::vector<int>> cells_;
};

/// A k-d tree of points: the nearest one to a place.
class NearestPoint {
 public:
  explicit NearestPoint(std::vector<Vec3> points);

  /// Position of the nearest point within `reach`, the first of equals; -1: none.
  int find(const Vec3& place, double reach) const;

 private:
  void sort(int begin, int end, int axis);
  void search(int begin, int end, int axis, const Vec3& place, double& least, int& nearest) const;

  std::vector<Vec3> points_;
  std::vector<int> order_;
};

}  // namespace railwave
