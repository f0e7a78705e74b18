#include "post/surface_search.hpp"

namespace railwave {
namespace {

std::vector<Vec3> points_of(const ContactSide& side) {
  std::vector<Vec3> points(side.nodes.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) points[i][c] = side.position[3 * i + c];
  return points;
}

}  // namespace

SurfaceSearch::SurfaceSearch(const ContactSide& side, const FacetsAroundNodes& around)
    : side_(side), around_(around), nodes_(points_of(side)) {}

FacetPlace SurfaceSearch::find(const Vector& point, double reach) const {
  FacetPlace nearest;
  const int node = nodes_.find({point[0], point[1], point[2]}, reach);
  if (node < 0) return nearest;
  // On graded or skewed facets the nearest place need not be on a facet of the nearest node: their neighbours are asked
  // too.
  std::vector<int> facets(around_[node].begin(), around_[node].end());
  facets = facets_around(around_, nodes_of_facets(side_, facets));
  for (const int facet : facets) {
    FacetPlace place = nearest_on_facet(facet_corners(side_, facet), point);
    place.facet = facet;
    if (nearest.facet < 0 || place.distance < nearest.distance) nearest = place;
  }
  return nearest;
}

}  // namespace railwave
