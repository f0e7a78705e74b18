#pragma once

#include "model/sets/point_search.hpp"
#include "post/facet.hpp"
#include "post/surface_mesh.hpp"

namespace railwave {

/// Finds the place of a surface nearest to a point, for points within about a facet's size of it.
class SurfaceSearch {
 public:
  /// Keeps references to both.
  SurfaceSearch(const ContactSide& side, const FacetsAroundNodes& around);

  /// The facet is -1 if no node of the surface is within `reach`, m.
  FacetPlace find(const Vector& point, double reach) const;

 private:
  const ContactSide& side_;
  const FacetsAroundNodes& around_;
  NearestPoint nodes_;
};

}  // namespace railwave
