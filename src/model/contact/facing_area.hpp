#pragma once

#include <array>
#include <vector>

#include "model/assembly.hpp"

namespace railwave {

using PlanePoint = std::array<double, 2>;

/// A surface seen along an axis, to find which nodes' motions make up the motion at a place of it.
class ProjectedSurface {
 public:
  /// @param axes rows: the plane's two directions and the direction of view
  /// Only faces whose middles lie in the box count; null: all.
  ProjectedSurface(const Assembly& assembly, const std::vector<Face>& faces, const std::array<Vec3, 3>& axes,
                   const scene::Box* box);

  bool empty() const { return faces_.empty(); }
  PlanePoint low() const { return low_; }  ///< bounds, m
  PlanePoint high() const { return high_; }

  /// Adds to `weights` (by node of the model) shape functions at the point that reproduce linear fields, times
  /// `factor`; false: no face is there.
  bool add_weights(PlanePoint point, double factor, std::vector<std::pair<int, double>>& weights) const;

 private:
  struct Projected {
    std::array<int, 4> nodes;
    std::array<PlanePoint, 4> corner;
    PlanePoint low, high;
  };
  std::vector<Projected> faces_;
  PlanePoint low_{1e300, 1e300}, high_{-1e300, -1e300};
};

}  // namespace railwave
