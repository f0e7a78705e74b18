#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace railwave {

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
