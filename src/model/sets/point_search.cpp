#include "model/sets/point_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace railwave {

double distance_outside(const scene::Box& box, const Vec3& x) {
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    const double outside = std::max({box[0][i] - x[i], x[i] - box[1][i], 0.0});
    squared += outside * outside;
  }
  return std::sqrt(squared);
}

std::string text_of(const Vec3& x) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x[0], x[1], x[2]); }

// Each range of `order_` is a tree: its middle is the root, what lies before it along the axis stands to its left.
NearestPoint::NearestPoint(std::vector<Vec3> points) : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  sort(0, static_cast<int>(order_.size()), 0);
}

void NearestPoint::sort(int begin, int end, int axis) {
  if (end - begin < 2) return;
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
    return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
  });
  sort(begin, middle, (axis + 1) % 3);
  sort(middle + 1, end, (axis + 1) % 3);
}

int NearestPoint::find(const Vec3& place, double reach) const {
  double least = reach * reach;
  int nearest = -1;
  search(0, static_cast<int>(order_.size()), 0, place, least, nearest);
  return nearest;
}

void NearestPoint::search(int begin, int end, int axis, const Vec3& place, double& least, int& nearest) const {
  if (begin >= end) return;
  const int middle = begin + (end - begin) / 2, point = order_[middle];
  double squared = 0;
  for (int i = 0; i < 3; ++i) squared += (place[i] - points_[point][i]) * (place[i] - points_[point][i]);
  if (squared < least || (squared == least && (nearest < 0 || point < nearest))) {
    least = squared;
    nearest = point;
  }
  const double offset = place[axis] - points_[point][axis];
  const int next = (axis + 1) % 3;
  if (offset < 0)
    search(begin, middle, next, place, least, nearest);
  else
    search(middle + 1, end, next, place, least, nearest);
  if (offset * offset > least) return;
  if (offset < 0)
    search(middle + 1, end, next, place, least, nearest);
  else
    search(begin, middle, next, place, least, nearest);
}

}  // namespace railwave
